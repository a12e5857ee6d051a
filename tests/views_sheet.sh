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
  "$lamplighter" render "$scene" -o "$work/$view.png" --view "$view" --size 480x300 \
    --set technique=light_maps --exposure 1 --backend cpu
done

# Marks are drawn by the editor, and light is old only while something moves.
cat > "$work/moving.jsonl" <<JSON
{"lamplighter":1,"scene":"$scene","sceneHash":"","window":[1050,389],"fps":60,"method":"many_lights","settings":{"antialias":4,"updates":20,"technique":"light_maps"},"exposure":1}
{"f":2,"action":"view.vpls"}
{"f":3,"check":"settled"}
{"f":4,"action":"app.screenshot $work/vpls.window.png"}
{"f":5,"action":"view.vpls"}
{"f":6,"action":"view.map_age"}
{"f":6,"action":"select.name \"warm ceiling light\""}
{"f":7,"action":"object.move 0.5 3.38 0.4"}
{"f":11,"action":"app.screenshot $work/map_age.window.png"}
JSON
"$lamplighter" replay "$work/moving.jsonl" --headless -o "$work" >/dev/null
for view in map_age vpls; do
  oiiotool "$work/$view.window.png" --cut 480x300+236+61 -o "$work/$view.png"
done

font=/usr/share/fonts/opentype/inter/Inter-Regular.otf
pictures=""
for view in $still map_age vpls; do
  oiiotool "$work/$view.png" --ch R,G,B --text:x=11:y=23:size=17:color=0,0,0:font=$font "$view" \
    --text:x=10:y=22:size=17:color=1,1,1:font=$font "$view" -o "$work/$view.png"
  pictures="$pictures $work/$view.png"
done
# shellcheck disable=SC2086  # the list is words
oiiotool $pictures --mosaic:pad=4 3x4 -o "$source_dir/docs/images/views.png"
