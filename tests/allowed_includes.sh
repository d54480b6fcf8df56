#!/usr/bin/env bash
# Data flows one way: checks that every folder includes only what it may. Usage: allowed_includes.sh SOURCE_DIR
set -euo pipefail
cd "$1"

# folder: what it may include besides itself; every folder of the pipeline may include src and pipeline/image
declare -A allowed=(
  [src]=""
  [pipeline/image]=""
  [pipeline/oiio]=""
  [pipeline/shot]=""
  [pipeline/colour]=""
  [pipeline/composite]="pipeline/colour"
  [pipeline/povray]="pipeline/shot"
  [pipeline/sequence]="pipeline/shot pipeline/composite pipeline/povray pipeline/colour"
  [pipeline/review]="pipeline/shot pipeline/composite pipeline/povray pipeline/colour pipeline/sequence"
  [pipeline/study]="pipeline/shot pipeline/composite pipeline/povray pipeline/colour pipeline/sequence"
  [pipeline/handoff]="pipeline/shot pipeline/composite pipeline/colour pipeline/sequence"
  [pipeline/cli]="pipeline/handoff pipeline/shot pipeline/composite pipeline/povray pipeline/colour pipeline/sequence pipeline/review pipeline/study"
)

failures=0
checked=0
while IFS=: read -r file line include; do
  folder=$(dirname "$file")
  target=$(dirname "$include")
  if [ -z "${allowed[$folder]+known}" ]; then
    echo "$file: the folder $folder is not in this list"
    failures=$((failures + 1))
    continue
  fi
  may="$folder ${allowed[$folder]}"
  [ "$folder" = src ] || may="$may src pipeline/image"
  checked=$((checked + 1))
  case " $may " in
    *" $target "*) ;;
    *) echo "$file:$line: $folder may not include $include"; failures=$((failures + 1)) ;;
  esac
done < <(grep -rnoP --include='*.h' --include='*.cpp' '^#include "\K[^"]+' src pipeline)

echo "$checked includes checked"
[ "$checked" -gt 100 ] && [ "$failures" -eq 0 ]
