#!/usr/bin/env bash
# Renders the figures of docs/seed-paper.md anew, and writes its table and pictures. Needs a build: pipeline/demo.sh makes one.
set -euo pipefail
cd "$(dirname "$0")/.."

lensplane=${1:-build/release/bin/lensplane}
[ -x "$lensplane" ] || { echo "$lensplane: no such program; run pipeline/demo.sh first" >&2; exit 2; }
renders=renders/seed-paper
mkdir -p "$renders"

for figure in 4 5 6 7 8; do
  frames=(); [ "$figure" != 7 ] || frames=(-f 1001-1048x6)
  "$lensplane" render "scenes/seed-fig$figure.yaml" "${frames[@]}" --redo --stats "$renders/seed-fig$figure.json"
done

# FIGURE FRAME NAME A_OF_THE_PAPER SECONDS_OF_THE_PAPER: one row of the table.
row() {
  local a seconds light bytes
  read -r a seconds light bytes < <(jq -r --argjson frame "$2" '
    .frames[] | select(.frame == $frame) |
    [.amplification.earth, .seconds, .phases.trace.seconds + .phases.composite.seconds, .phases.write.bytes] | @tsv
  ' "$renders/seed-fig$1.json")
  printf '| %s | %s | %.3f | %s | %.2f | %.2f | %d |\n' "$3" "$4" "$a" "$5" "$seconds" "$light" $((bytes / 1024))
}
table() {
  echo "| figure | A, paper | A, ours | seconds, paper | seconds, ours | of which light | KiB, ours |"
  echo "|---|---|---|---|---|---|---|"
  row 5 1001 "5: in a line" 4.46 2.65
  row 6 1001 "6: not in a line" 2.50 2.39
  row 8 1001 "8: moving, 1" 1.92 ""
  row 8 1002 "8: moving, 2" 2.67 ""
  row 8 1003 "8: moving, 3" 3.89 ""
  row 8 1004 "8: moving, 4" 4.34 ""
  printf '| 8: all four | | | 10.11 | %.2f | | |\n' "$(jq .seconds "$renders/seed-fig8.json")"
}

document=docs/seed-paper.md
{
  sed '/<!-- table -->/q' "$document"
  table
  sed -n '/<!-- end of table -->/,$p' "$document"
} >"$renders/seed-paper.md"
cp "$renders/seed-paper.md" "$document"

for picture in fig4.review.1001 fig5.review.1001 fig6.review.1001 fig7.review.1019 fig8.review.1001 fig8.review.1002 fig8.review.1003 fig8.review.1004; do
  cp "$renders/seed-$picture.png" "docs/images/seed-${picture/.review./-}.png"
done
echo "$document and docs/images are up to date"
