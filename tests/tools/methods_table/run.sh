#!/usr/bin/env bash
# Plays one recording on every level with every method and with the defaults: a Markdown table for each
# level. CSV files of the rows and of the error over time, and a plot, stay in a folder; levels that
# are not played keep the rows that the folder has, so that a long table can be made in parts.
# usage: tests/tools/methods_table/run.sh PROGRAM FOLDER [PART...]   (./dev methods-table; parts of levels' names)
set -eu
cd "$(dirname "$0")/../../.."
program=$1 out=$2
shift 2
# The default picture chooses what carries bounced light; many_lights by itself carries it by samples.
methods=(many_lights "many_lights,indirect=samples" multi_mesh surface_shadow_maps imperfect_shadow_maps
  light_field reference)
names=("default" many_lights multi_mesh surface_shadow_maps imperfect_shadow_maps light_field reference)
# Presets differ from the defaults in amounts, which three levels tell.
presets=(preset.draft preset.final) preset_levels=" pillar_room living-room modern-hall "
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"
header="level,method,step,frame_ms,worst_frame_ms,error_moving,seconds_to_10,seconds_to_5,seconds_settled,error_end,frames,peak_mib"
rows=$out/methods.csv curves=$out/methods_curves.csv truths=$out/methods_truths.csv
[ "$(head -n 1 "$rows" 2>/dev/null)" = "$header" ] || echo "$header" >"$rows"
[ -f "$truths" ] || echo "level,paths,noise" >"$truths"
[ -f "$curves" ] || echo "level,method,step,seconds,error" >"$curves"

for file in assets/scenes/{cornell_style,pillar_room,door_ajar}.gltf \
  ../shared/scenes/{living-room,bathroom,classroom,bedroom,modern-hall,kenney-fps-level,zdm2-map,candela-city}/*.gl*; do
  [ -f "$file" ] || continue
  level=$(basename "${file%.*}")
  [ $# -eq 0 ] && wanted=1 || wanted=0
  for part in "$@"; do case $level in *"$part"*) wanted=1 ;; esac; done
  [ $wanted -eq 1 ] || continue
  sed -i "/^$level,/d" "$rows" "$curves" "$truths"
  "$program" "$file" truth "$work/truth" >"$work/noise" 2>"$work/log" || { cat "$work/log" >&2; exit 1; }
  echo "$level,$(cat "$work/noise")" >>"$truths"
  played=("${methods[@]}") called=("${names[@]}")
  if [[ $preset_levels == *" $level "* ]]; then
    played+=("${presets[@]}") called+=("${presets[@]}")
  fi
  for i in "${!played[@]}"; do
    # One process each, so that the peak of memory is that of the method.
    "$program" "$file" "${played[$i]}" "$work/truth" "$work/own" >"$work/rows" 2>"$work/log" ||
      { cat "$work/log" >&2; exit 1; }
    sed "s/\"[^\"]*\"/${called[$i]}/" "$work/rows" >>"$rows"
    sed "s/\"[^\"]*\"/${called[$i]}/" "$work/own" >>"$curves"
    rm "$work/own"
  done
done
# A table for each level: of opening the first frame and its error, and how long it takes from there; of
# motions the mean of frames and the error of the first frame after the last motion.
awk -F, '
  FNR == NR { truth[$1] = sprintf("%s paths per pixel, noise %.1f%%", $2, 100 * $3); next }
  FNR == 1 { next }
  $1 != level {
    level = $1
    printf "\n**%s** (reference: %s)\n\n", level, truth[level]
    print "| method | open | to 10%, to 5%, settled | at rest | drag a light | move an object | brighter | fly | MiB |"
    print "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
  }
  $3 == "open" { printf "| %s | %d ms, %.1f%% | %s, %s, %s | %.1f%% |", $2, $4, 100 * $6, $7, $8, $9, 100 * $10 }
  $3 != "open" { printf " %d ms, %.1f%% |", $4, 100 * $6 }
  $3 == "fly" { printf " %s |\n", $12 }' "$truths" "$rows"

# A panel for each level: the error over the time since it was opened.
mapfile -t levels < <(tail -n +2 "$curves" | cut -d, -f1 | uniq)
{
  echo "set terminal pngcairo size 1500,$((((${#levels[@]} + 2) / 3) * 380 + 40)) font 'Inter,10'"
  echo "set output '$out/methods.png'; set datafile separator ','"
  echo "set multiplot layout $(((${#levels[@]} + 2) / 3)),3; set logscale xy; set grid"
  echo "set xlabel 's after opening'; set ylabel 'error, %'; set yrange [0.5:200]; set key bottom left samplen 2"
  for level in "${levels[@]}"; do
    plots=""
    for name in "${names[@]}"; do
      awk -F, -v l="$level" -v m="$name" '$1 == l && $2 == m && $3 == "open" { print $4 "," 100 * $5 }' \
        "$curves" >"$work/$level.$name"
      [ ! -s "$work/$level.$name" ] ||
        plots+="'$work/$level.$name' with lines linewidth $([ "$name" = default ] && echo 3 || echo 1.5) title '${name//_/ }',"
    done
    echo "set title '${level//_/ }'; plot ${plots%,}"
  done
} | gnuplot
