#!/usr/bin/env bash
# How soon pictures at rest are near the path tracer after a scene was opened, with and without repair,
# as rows of a Markdown table.
# usage: tests/tools/repair.sh LAMPLIGHTER [PART...]   (./dev repair; parts of scenes' names)
set -eu
cd "$(dirname "$0")/../.."
program=$1
shift
size=320x240 bounces=5 seconds=30 spp=512
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

row() {  # row NAME FILE
  local name=$1 file=$2 cells="" text
  shift 2
  "$program" render "$file" --method reference --size $size --bounces $bounces --spp $spp -o "$work/r.exr" \
    >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
  for repair in 0 256; do
    text=$("$program" converge "$file" --against "$work/r.exr" --size $size --bounces $bounces --block 4 \
      --seconds $seconds --set repair=$repair --json 2>"$work/log") || { cat "$work/log" >&2; exit 1; }
    number() {  # of the last value of that name
      local value
      value=$(sed -n "s/^  \"$1\": \\([0-9.e-]*\\|null\\),*\$/\\1/p" <<<"$text" | tail -1)
      [ "$value" != null ] && LC_ALL=C printf "$2" "$(awk "BEGIN { print $value * ${3:-1} }")" || printf 'never'
    }
    cells+="$(number settled '%.1f s') | $(number to_10 '%.1f s') | $(number to_5 '%.1f s') | $(number end '%.1f%%' 100) | "
  done
  echo "| $name | ${cells% }"
}

echo "| scene | settled | 10% | 5% | after $seconds s | with repair: settled | 10% | 5% | after $seconds s |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
for file in assets/scenes/{cornell_style,pillar_room,door_ajar,corridor}.gltf \
  ../shared/scenes/{living-room,bathroom,classroom,bedroom,modern-hall,kenney-fps-level,zdm2-map}/*.gl*; do
  [ -f "$file" ] || continue
  name=$(basename "${file%.*}")
  [ $# -eq 0 ] && wanted=1 || wanted=0
  for part in "$@"; do case $name in *"$part"*) wanted=1 ;; esac; done
  [ $wanted -eq 0 ] || row "$name" "$file"
done
