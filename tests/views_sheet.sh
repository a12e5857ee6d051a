#!/usr/bin/env bash
# Every view of the default scene in one picture: views_sheet.sh LAMPLIGHTER -> docs/images/views.png
set -eu
lamplighter=$1
source_dir=$(cd "$(dirname "$0")/.." && pwd)
scene=$source_dir/assets/scenes/default.gltf
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

still="lit light_only albedo normals flat patches patch_levels occlusion partial_lights light_maps"
for view in $still; do
  "$lamplighter" render "$scene" -o "$work/$view.png" --view "$view" --legend --size 480x300 \
    --set technique=light_maps --exposure 1 --backend cpu
done
"$lamplighter" render "$scene" -o "$work/vpls.png" --marks --size 480x300 --exposure 1 --backend cpu

# Light is old only while something moves.
cat > "$work/moving.jsonl" <<JSON
{"lamplighter":1,"scene":"$scene","sceneHash":"","window":[1050,389],"fps":60,"method":"many_lights","settings":{"antialias":4,"updates":20,"technique":"light_maps"},"exposure":1}
{"f":6,"action":"view.map_age"}
{"f":6,"action":"select.name \"warm ceiling light\""}
{"f":7,"action":"object.move 0.5 3.38 0.4"}
{"f":11,"action":"app.screenshot $work/map_age.window.png"}
JSON
"$lamplighter" replay "$work/moving.jsonl" --headless -o "$work" >/dev/null
oiiotool "$work/map_age.window.png" --cut 480x300+236+61 -o "$work/map_age.png"

font=/usr/share/fonts/opentype/inter/Inter-Regular.otf
for view in $still map_age vpls; do
  oiiotool "$work/$view.png" --ch R,G,B --text:x=11:y=23:size=17:color=0,0,0:font=$font "$view" \
    --text:x=10:y=22:size=17:color=1,1,1:font=$font "$view" -o "$work/$view.png"
done
# The last six have room for legends below.
cd "$work"
oiiotool lit.png light_only.png albedo.png normals.png flat.png patches.png --mosaic:pad=4 3x2 \
  -o above.png
oiiotool patch_levels.png occlusion.png partial_lights.png light_maps.png map_age.png vpls.png \
  --mosaic:pad=4 3x2 -o below.png
oiiotool above.png --create 1448x1388 3 --paste +0+0 -o sheet.png
oiiotool below.png sheet.png --paste +0+608 -o "$source_dir/docs/images/views.png"
