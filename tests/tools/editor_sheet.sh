#!/usr/bin/env bash
# The editor's states at three sizes, as contact sheets: editor_sheet.sh LAMPLIGHTER [FOLDER]
# -> docs/images/editor_sheet_*.jpg; with FOLDER the single pictures are also kept there.
# The windows run in Xvfb with few light samples, so that a sheet takes only a minute or two.
# ONLY=small, large or dense makes only that sheet.
set -eu
lamplighter=$1
source_dir=$(cd "$(dirname "$0")/../.." && pwd)
# The file dialog shows the scene's folder, so this must not be a folder of the checkout.
work=${TMPDIR:-/tmp}/lamplighter-sheet
mkdir "$work"
trap 'rm -rf "$work"' EXIT
cp -r "$source_dir/assets/scenes" "$work/scenes"
scene=$work/scenes/default.gltf
keep=${2:-$work/pictures}
mkdir -p "$keep"

# These functions write a recording line by line. Each uses the next frame or several frames.
frame=0 file='' shots=''
line() { printf '{"f":%d,%s}\n' "$frame" "$1" >> "$file"; }
act() {  # ACTION
  frame=$((frame + 1))
  line "\"action\":\"${1//\"/\\\"}\""
}
point() {  # WIDGET [X Y]: shares of the widget, or pixels of the viewport
  frame=$((frame + 1))
  line "\"pointer\":[${2:-0.5},${3:-0.5}],\"on\":\"$1\""
}
click() {  # WIDGET [X Y]
  point "$@"
  frame=$((frame + 2))
  line '"button":0,"down":true'
  frame=$((frame + 1))
  line '"button":0,"down":false'
  frame=$((frame + 5))
}
key() {  # NAME
  frame=$((frame + 1))
  line "\"key\":\"$1\",\"down\":true"
  frame=$((frame + 1))
  line "\"key\":\"$1\",\"down\":false"
}
text() {
  frame=$((frame + 1))
  line "\"text\":\"$1\""
}
wheel() {  # STEPS
  frame=$((frame + 1))
  line "\"wheel\":[0,$1]"
  frame=$((frame + 1))
}
shot() {  # NAME: once the picture is settled
  frame=$((frame + 2))
  line "\"check\":\"$1\",\"image\":false"
  shots="$shots $1"
}

# All states, for a viewport of approximately W x H pixels.
states() {
  local w=$1 h=$2 x y
  x=$((w * 45 / 100)) y=$((h * 80 / 100))
  shot start
  act 'select.name "alcove light"'
  act tool.rotate
  shot light_selected
  act tool.select
  act 'light.add spot'
  act 'light.add tube'
  act 'light.add sun'
  act 'select.name "warm ceiling light" "alcove light"'
  act 'lights.group ceiling'
  act panel.lights
  shot light_table
  act lights.select
  shot all_lights_selected
  act select.none
  act panel.lights
  act "explain.at $x $y"
  act 'explain.light 0'
  shot why_dark
  act view.histogram
  act view.probe
  point viewport "$x" "$((y - h / 10))"
  shot why_dark_histogram_probe
  act explain.close
  act view.probe
  act measure.start
  act "measure.at $((w / 4)) $y"
  act "measure.at $((w * 7 / 10)) $((h * 6 / 10))"
  shot measure_and_histogram
  act view.histogram
  act measure.clear
  act tool.select
  act 'split.on live many_lights,bounces=0'
  shot split
  click 'render/section Light samples'
  click 'render/section Compare'
  act split.heat
  shot heat_map
  act split.off
  click 'render/section Compare'
  click 'render/section Budgets'
  shot budgets
  click 'render/section Budgets'
  click 'render/section Timeline'
  wheel -3
  act 'select.name "warm ceiling light"'
  act 'object.move 0.5 3.38 0.4'
  act 'object.move 0.8 3.38 0.4'
  act select.none
  shot timeline
  act edit.undo
  act edit.undo
  wheel 40
  click 'render/section Timeline'
  click 'render/section Light samples'
  act view.false_colour
  shot false_colour
  act view.lit
  act view.vpls
  shot light_samples
  act view.vpls
  act app.palette
  frame=$((frame + 3))
  text 'light'
  frame=$((frame + 3))
  shot palette
  key escape
  frame=$((frame + 3))
  click menu/View
  point menu/Engine
  frame=$((frame + 25))
  shot menu
  key escape
  key escape
  frame=$((frame + 3))
  act file.open
  frame=$((frame + 3))
  shot file_dialog
  click dialog/cancel
  frame=$((frame + 3))
  act app.quit
  frame=$((frame + 3))
  shot save_question
}

# One size: NAME WIDTH HEIGHT SCALE
record() {
  local name=$1 width=$2 height=$3 scale=$4
  mkdir -p "$keep/$name"
  file=$work/$name.jsonl frame=5 shots=''
  printf '{"lamplighter":1,"scene":"%s","sceneHash":"","window":[%d,%d],"fps":60,"method":"many_lights",' \
    "$scene" "$width" "$height" > "$file"
  printf '"settings":{"antialias":1,"block":4,"vpls":%d,"updates":40,"map_resolution":64},"exposure":1}\n' \
    $((width > 1280 ? 16 : 40)) >> "$file"
  states $((width - scale * 570)) $((height - scale * 90))
  LAMPLIGHTER_UI_SCALE=$scale LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s '-screen 0 2560x1440x24' \
    "$lamplighter" replay "$file" -o "$keep/$name" >/dev/null
  for shot in $shots; do
    mv "$keep/$name/$name.$shot.window.png" "$keep/$name/$shot.png"
    rm "$keep/$name/$name.$shot.png"
  done
}

# The pictures of a size side by side, each with its name: NAME
sheet() {
  local font=/usr/share/fonts/opentype/inter/Inter-Regular.otf i=0 list=''
  for shot in $shots; do
    i=$((i + 1))
    oiiotool "$keep/$1/$shot.png" --ch R,G,B --resize 960x540 --fullpixels -o "$work/small.png"
    oiiotool "$work/small.png" --pattern constant:color=0.09,0.094,0.106 960x570 3 --paste +0+30 \
      --text:x=8:y=22:size=18:color=0.9,0.9,0.9:font=$font "$i  ${shot//_/ }" \
      -o "$work/$1.$shot.png"
    list="$list $work/$1.$shot.png"
  done
  # shellcheck disable=SC2086  # the list is words without spaces
  oiiotool $list --mosaic:pad=6 3x$(((i + 2) / 3)) --compression jpeg:68 \
    -o "$source_dir/docs/images/editor_sheet_$1.jpg"
}

for size in "small 1280 720 1" "large 2560 1440 1" "dense 2560 1440 2"; do
  [ -z "${ONLY:-}" ] || [ "${size%% *}" = "$ONLY" ] || continue
  # shellcheck disable=SC2086  # four words
  record $size
  sheet "${size%% *}"
done
