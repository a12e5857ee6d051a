#!/usr/bin/env bash
# Figures 5-8, 5-9 and 5-10 of paper 1 as pictures of our own scenes, into docs/images/.
# usage: tests/tools/paper_figures.sh LAMPLIGHTER   (needs oiiotool and jq: ./dev figures)
set -eu
cd "$(dirname "$0")/../.."
program=$1
scenes=assets/scenes
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p docs/images

picture() {  # picture NAME SCENE ARGUMENTS... : renders $work/NAME.png
  local name=$1 scene=$2
  shift 2
  "$program" render "$scene" -o "$work/$name.exr" --backend cpu --method many_lights "$@" 2>/dev/null
  "$program" tonemap "$work/$name.exr" -o "$work/$name.png" --exposure "${exposure:-0}" >/dev/null
}
mosaic() {  # mosaic COLUMNSxROWS OUT NAME...
  local shape=$1 out=$2 files=() name
  shift 2
  for name in "$@"; do files+=("$work/$name.png"); done
  oiiotool "${files[@]}" --mosaic:pad=4 "$shape" --attrib:type=int compression:quality 90 -o "docs/images/$out"
}
edit() {  # edit SCENE OUT FILTER : a scene changed by a jq filter
  jq "$3" "$scenes/$1.gltf" > "$work/$2.gltf"
}
# 25 direct and 275 indirect light samples and five bounces, as in the paper.
many=(--vpls 300 --bounces 5 --set indirect=samples --set direct_share=0.0834 --set map_resolution=128
  --set settled_map_scale=1 --set antialias=8)

# 5-8: direct light only. Rows: shadow maps of 64², 128², 256² and 512²; columns: 25, 50, 100 light
# samples.
names=()
for resolution in 64 128 256 512; do
  for vpls in 25 50 100; do
    picture "8-$resolution-$vpls" $scenes/table_room.gltf --size 320x200 --bounces 0 --vpls $vpls \
      --set map_resolution=$resolution --set settled_map_scale=1 --set block=1
    names+=("8-$resolution-$vpls")
  done
done
mosaic 3x4 figure_5_8.jpg "${names[@]}"

# 5-9: a white object beside the pillar, in view of the green wall, and behind the pillar.
white='(.materials[] | select(.name == "mover").pbrMetallicRoughness.baseColorFactor) = [0.75, 0.75, 0.75, 1]'
at() { echo "$white | (.nodes[] | select(.name == \"mover\").translation) = [$1]"; }
# A small lamp aims at the green wall, so that its reflected light is visible.
lamp='(.nodes[] | select(.name == "ceiling light")) |= (.translation = [-2.9, 2.6, -1.2] | .scale = [0.3, 0.3, 0.3] | .rotation = [-0.1464466, 0.6903456, 0.1464466, 0.6903456])'
eye='(.nodes[] | select(.name == "camera")) |= (.translation = [-1.2, 1.3, 1.2] | .rotation = [0, 0.1305262, 0, 0.9914449])'
edit pillar_room 9-open "$(at '-1.3, 0.9, -0.9') | $eye | $lamp"
edit pillar_room 9-hidden "$(at '-1.2, 0.9, -2.1') | $eye | $lamp"
exposure=2.5
for name in 9-open 9-hidden; do picture $name "$work/$name.gltf" --size 480x300 "${many[@]}"; done
mosaic 2x1 figure_5_9.jpg 9-open 9-hidden

# 5-10: the indirect light that a block occludes: with and without the block.
exposure=0
nothing='.scenes[0].nodes -= [.nodes | to_entries[] | select(.value.name == "plinth").key]'
place='(.nodes[] | select(.name == "mover").translation) = [1.1, 0.55, -0.4]'
edit area_light_room 10-with "$place"
edit area_light_room 10-without "$place | $nothing"
for name in 10-with 10-without; do picture $name "$work/$name.gltf" --size 480x300 "${many[@]}"; done
mosaic 2x1 figure_5_10.jpg 10-with 10-without
