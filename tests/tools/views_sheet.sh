#!/usr/bin/env bash
# Every view of the default scene in one picture: views_sheet.sh LAMPLIGHTER -> docs/images/views.png
set -eu
lamplighter=$1
source_dir=$(cd "$(dirname "$0")/../.." && pwd)
scene=$source_dir/assets/scenes/default.gltf
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

still="lit light_only direct indirect albedo normals flat patches false_colour patch_levels occlusion \
  light_occlusion partial_lights lights_per_patch light_maps light_map_density shadow_map edge_mask \
  mesh_edges mesh_samples mesh_contrast prt_objects"
for view in $still; do
  more=
  if [ "$view" = prt_objects ]; then more="--set prt=true"; fi
  if [ "$view" = edge_mask ]; then more="--set share_memory=0"; fi
  "$lamplighter" render "$scene" -o "$work/$view.png" --view "$view" --legend --size 480x300 \
    --set technique=light_maps $more --exposure 1 --backend cpu
done
"$lamplighter" render "$scene" -o "$work/vpls.png" --marks --size 480x300 --exposure 1 --backend cpu

# Irradiance is out of date only while something moves.
cat > "$work/moving.jsonl" <<JSON
{"lamplighter":1,"scene":"$scene","sceneHash":"","window":[1050,389],"fps":60,"method":"many_lights","settings":{"antialias":4,"updates":20,"technique":"light_maps"},"exposure":1}
{"f":6,"action":"view.map_age"}
{"f":6,"action":"select.name \"warm ceiling light\""}
{"f":7,"action":"object.move 0.5 3.38 0.4"}
{"f":11,"action":"app.screenshot $work/map_age.window.png"}
{"f":12,"action":"view.pending_patches"}
{"f":13,"action":"app.screenshot $work/pending_patches.window.png"}
JSON
"$lamplighter" replay "$work/moving.jsonl" --headless -o "$work" >/dev/null
for view in map_age pending_patches; do
  oiiotool "$work/$view.window.png" --cut 480x300+236+61 -o "$work/$view.png"
done

font=/usr/share/fonts/opentype/inter/Inter-Regular.otf
for view in $still map_age pending_patches vpls; do
  oiiotool "$work/$view.png" --ch R,G,B --text:x=11:y=23:size=17:color=0,0,0:font=$font "$view" \
    --text:x=10:y=22:size=17:color=1,1,1:font=$font "$view" -o "$work/$view.png"
done
# All pictures after the first eight have space for a legend at the bottom.
cd "$work"
oiiotool lit.png light_only.png direct.png indirect.png albedo.png normals.png flat.png patches.png \
  --mosaic:pad=4 4x2 -o above.png
oiiotool false_colour.png patch_levels.png occlusion.png light_occlusion.png partial_lights.png \
  lights_per_patch.png light_maps.png light_map_density.png map_age.png pending_patches.png \
  shadow_map.png edge_mask.png mesh_edges.png mesh_samples.png mesh_contrast.png prt_objects.png \
  vpls.png --mosaic:pad=4 4x5 -o below.png
height=$(oiiotool --info below.png | sed 's/.* \([0-9]*\) x *\([0-9]*\).*/\2/')
oiiotool above.png --create 1932x$((608 + height)) 3 --paste +0+0 -o sheet.png
oiiotool below.png sheet.png --paste +0+608 -o "$source_dir/docs/images/views.png"
