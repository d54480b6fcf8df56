#!/usr/bin/env bash
# Sets up, builds, and renders the paper's Fig. 5 and a short sequence, Fig. 8; then says where maps and pictures are.
set -euo pipefail
cd "$(dirname "$0")/.."

pipeline/setup.sh
cmake --preset release -DLENSPLANE_TESTS=OFF >/dev/null
cmake --build --preset release --parallel "$(nproc)" -- --quiet

lensplane=build/release/bin/lensplane
for figure in seed-fig5 seed-fig8; do
  echo
  echo "$figure"
  "$lensplane" check "scenes/$figure.yaml"
  "$lensplane" render "scenes/$figure.yaml"
done

renders=$PWD/renders/seed-paper
cat <<TEXT

The pictures to look at:   $renders/*.review.*.png
The linear pictures:       $renders/seed-fig?.????.exr     (half EXR, ACEScg)
The deflection maps:       $renders/*.map.*.exr            (STMaps for any compositor)
TEXT
