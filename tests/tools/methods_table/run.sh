#!/usr/bin/env bash
# Plays one recording on every level with every method and with the defaults: rows of a Markdown table
# for each step. CSV files of the rows and of the error over time, and a plot, stay in a folder.
# usage: tests/tools/methods_table/run.sh PROGRAM FOLDER [PART...]   (./dev methods-table; parts of levels' names)
set -eu
cd "$(dirname "$0")/../../.."
program=$1 out=$2
shift 2
# The default picture chooses what carries bounced light; many_lights by itself carries it by samples.
methods=(many_lights "many_lights,indirect=samples" multi_mesh surface_shadow_maps imperfect_shadow_maps
  light_field reference)
names=("default" many_lights multi_mesh surface_shadow_maps imperfect_shadow_maps light_field reference)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"
header="level,method,step,frame_ms,worst_frame_ms,error_moving,seconds_to_10,seconds_to_5,seconds_settled,error_end,frames,peak_mib"
echo "$header" >"$out/methods.csv"
curves=$out/methods_curves.csv
echo "level,method,step,seconds,error" >"$curves"

for file in assets/scenes/{cornell_style,pillar_room,door_ajar}.gltf \
  ../shared/scenes/{living-room,bathroom,classroom,bedroom,modern-hall,kenney-fps-level,zdm2-map,candela-city}/*.gl*; do
  [ -f "$file" ] || continue
  level=$(basename "${file%.*}")
  [ $# -eq 0 ] && wanted=1 || wanted=0
  for part in "$@"; do case $level in *"$part"*) wanted=1 ;; esac; done
  [ $wanted -eq 1 ] || continue
  "$program" "$file" truth "$work/truth" 2>"$work/log" || { cat "$work/log" >&2; exit 1; }
  for i in "${!methods[@]}"; do
    # One process each, so that the peak of memory is that of the method.
    "$program" "$file" "${methods[$i]}" "$work/truth" "$work/own" >"$work/rows" 2>"$work/log" ||
      { cat "$work/log" >&2; exit 1; }
    sed "s/\"[^\"]*\"/${names[$i]}/" "$work/rows" >>"$out/methods.csv"
    sed "s/\"[^\"]*\"/${names[$i]}/" "$work/own" >>"$curves"
    rm "$work/own"
  done
done
echo "| level | method | step | ms a frame | worst | error moving | 10% | 5% | settled | error at rest | peak MiB |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
awk -F, 'NR > 1 { printf "| %s | %s | %s | %s | %s | %.1f%% | %s | %s | %s | %.1f%% | %s |\n",
  $1, $2, $3, $4, $5, 100 * $6, $7, $8, $9, 100 * $10, $12 }' "$out/methods.csv"

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
