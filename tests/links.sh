#!/usr/bin/env bash
# Checks that every relative link and picture in the documents leads to a file. Usage: links.sh SOURCE_DIR
set -euo pipefail
cd "$1"

failures=0
checked=0
for document in README.md docs/*.md; do
  while IFS= read -r target; do
    checked=$((checked + 1))
    [ -e "$(dirname "$document")/$target" ] || { echo "$document: there is no $target"; failures=$((failures + 1)); }
  done < <(grep -oP '\]\(\K(?!https?:)[^)#]+' "$document")
done
echo "$checked links checked"
[ "$checked" -gt 10 ] && [ "$failures" -eq 0 ]
