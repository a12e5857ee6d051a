#!/usr/bin/env bash
# Plots what lamplighter_convergence --data wrote: error against light samples, a panel for each
# number of bounces, a line for each scene.
# usage: tests/convergence/plot.sh FOLDER OUT.png   (needs gnuplot)
set -eu
folder=$1 out=$2
{
  echo "set terminal pngcairo size 1500,560 font 'Inter,11'; set output '$out'"
  echo "set multiplot layout 1,3; set logscale xy; set grid; set key outside bottom maxrows 6"
  echo "set xlabel 'light samples'; set ylabel 'relRMSE, %'; set yrange [0.3:300]; set xrange [50:20000]"
  for bounces in 0 1 5; do
    echo "set title '$bounces bounces'"
    lines=()
    for file in "$folder"/*."$bounces".tsv; do
      name=$(basename "$file" ".$bounces.tsv")
      lines+=("'$file' with linespoints pointtype 7 pointsize 0.6 title '${name//_/ }'")
    done
    (IFS=,; echo "plot ${lines[*]}")
  done
} | gnuplot
