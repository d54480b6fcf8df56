#!/usr/bin/env bash
# Installs the build and uses the installed program from a folder of its own. Usage: installed.sh BUILD_DIR
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$1" --prefix "$folder/prefix" >/dev/null
mkdir "$folder/own"
cd "$folder/own"
cat >own.yaml <<'SHOT'
lensplane: 1
shot: own
frames: 1
camera: {resolution: [32, 32], fov: 3 deg}
lenses: [{name: a, mass: 1.989e31 kg, position: [0 m, 0 m, -4.36e8 m]}]
layers: [{name: earth, type: sphere, centre: [0 m, 0 m, -1.09e9 m], radius: 6371 km, image: "lensplane:textures/earth_night.jpg"}]
trace: {method: shinotsuka-makino}
SHOT
unset OCIO
"$folder/prefix/bin/lensplane" render own.yaml
"$folder/prefix/bin/lensplane" render "$folder/prefix/share/lensplane/scenes/seed-fig5.yaml" --proxy 8 --output fig5
for file in renders/own/own.0001.exr renders/own/own.review.0001.png renders/own/own.earth.map.0001.exr fig5/seed-fig5.review.1001.png; do
  [ -s "$file" ] || { echo "missing: $file"; exit 1; }
done
