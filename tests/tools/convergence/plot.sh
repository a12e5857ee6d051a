#!/usr/bin/env bash
# Plots the data of lamplighter_convergence --data: error over light samples, with a panel for each
# number of bounces and a line for each scene. A scene has the same colour in all panels.
# usage: tests/tools/convergence/plot.sh FOLDER OUT.png   (needs gnuplot)
set -eu
folder=$1 out=$2
colours=(1f77b4 ff7f0e 2ca02c d62728 9467bd 8c564b e377c2 7f7f7f bcbd22 17becf 000000 aec7e8)
mapfile -t names < <(for file in "$folder"/*.tsv; do
  name=$(basename "$file" .tsv)
  echo "${name%.*}"
done | sort -u)
lines_of() { # bounces
  local i file
  for i in "${!names[@]}"; do
    file="$folder/${names[$i]}.$1.tsv"
    [ ! -f "$file" ] ||
      echo "'$file' with linespoints pointtype $((i % 2 ? 5 : 7)) pointsize 0.7 linewidth 1.6" \
        "linecolor rgb '#${colours[$((i % ${#colours[@]}))]}' title '${names[$i]//_/ }'"
  done | paste -sd,
}
{
  echo "set terminal pngcairo size 1700,620 font 'Inter,11'; set output '$out'"
  echo "set multiplot; set logscale xy; set grid; unset key"
  echo "set xlabel 'light samples'; set yrange [0.5:300]; set xrange [50:20000]"
  echo "set tmargin at screen 0.93; set bmargin at screen 0.1"
  left=0.05
  for bounces in 0 1 5; do
    right=$(awk "BEGIN { print $left + 0.23 }")
    echo "set lmargin at screen $left; set rmargin at screen $right; set title '$bounces bounces'"
    # The first panel has all scenes, so its key is used; it is to the right of the last panel.
    if [ "$bounces" = 0 ]; then
      echo "set ylabel 'relRMSE, %'"
      echo "set key at screen 0.83, screen 0.93 left top reverse Left samplen 2"
    else
      echo "unset ylabel; unset key"
    fi
    echo "plot $(lines_of "$bounces")"
    left=$(awk "BEGIN { print $left + 0.265 }")
  done
} | gnuplot
