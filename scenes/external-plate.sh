#!/usr/bin/env bash
# Renders the plate of external-plate.yaml by POV-Ray, as another department would have: linear half EXR, ten per cent
# larger on every side than the shot's frame. One thread for each frame, so that every run gives the same pixels.
set -euo pipefail
cd "$(dirname "$0")"

plates=../renders/external-plate/plates
mkdir -p "$plates"
plates=$(cd "$plates" && pwd)
first=1001 last=1012
for frame in $(seq "$first" "$last"); do
  clock=$(awk "BEGIN { print ($frame - $first) / ($last - $first) }")
  povray +Ipovray/lanterns.pov +O"$plates/lanterns.$frame.exr" +FE +W768 +H432 +K"$clock" +A0.05 +AM1 +R3 -J \
    +WT1 -D -P -V >"$plates/povray.log" 2>&1 || { tail -5 "$plates/povray.log" >&2; exit 1; }
  echo "$plates/lanterns.$frame.exr"
done
