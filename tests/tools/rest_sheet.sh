#!/usr/bin/env bash
# The default picture 1, 5 and 30 seconds after a level was opened, beside the reference: a row for
# each level, at the exposure that suits the reference, into docs/images/rest_sheet.jpg.
# usage: tests/tools/rest_sheet.sh LAMPLIGHTER [PART...]   (./dev rest-sheet; parts of levels' names; needs oiiotool)
set -eu
cd "$(dirname "$0")/../.."
program=$1
shift
size=320x240 bounces=5 spp=${SPP:-256}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }; }

rows=()
for file in assets/scenes/door_ajar.gltf \
  ../shared/scenes/{living-room,bathroom,classroom,bedroom,modern-hall,kenney-fps-level,zdm2-map}/*.gl*; do
  [ -f "$file" ] || continue
  name=$(basename "${file%.*}")
  [ $# -eq 0 ] && wanted=1 || wanted=0
  for part in "$@"; do case $name in *"$part"*) wanted=1 ;; esac; done
  [ $wanted -eq 1 ] || continue
  quietly "$program" render "$file" -o "$work/reference.exr" --method reference --size $size --bounces $bounces \
    --spp "$spp"
  exposure=$("$program" tonemap "$work/reference.exr" -o "$work/reference.png" --exposure auto |
    sed 's/.*EV \([-0-9.]*\).*/\1/')
  tiles=()
  for seconds in 1 5 30; do
    quietly "$program" tiles "$file" -o "$work/$seconds.png" --side "many_lights,bounces=$bounces" --size $size \
      --seconds $seconds --exposure "$exposure"
    tiles+=("$work/$seconds.png")
  done
  # Without the margin of the tile and the figures under it.
  for tile in "${tiles[@]}"; do oiiotool "$tile" --cut $size+6+6 -o "$tile"; done
  oiiotool "${tiles[@]}" "$work/reference.png" --mosaic:pad=2 4x1 -o "$work/$name.png"
  rows+=("$work/$name.png")
  echo "rest sheet: $name" >&2
done
[ ${#rows[@]} -gt 0 ] || { echo "rest sheet: no level has such a name, or ../shared/scenes is absent" >&2; exit 2; }
oiiotool "${rows[@]}" --mosaic:pad=4 "1x${#rows[@]}" --attrib:type=int compression:quality 85 \
  -o "${OUT:-docs/images/rest_sheet.jpg}"
