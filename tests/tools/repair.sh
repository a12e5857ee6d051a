#!/usr/bin/env bash
# How soon the default picture at rest is near the path tracer after a scene was opened, and what its
# settled picture is without repair, as rows of a Markdown table.
# usage: tests/tools/repair.sh LAMPLIGHTER [PART...]   (./dev repair; parts of scenes' names)
set -eu
cd "$(dirname "$0")/../.."
program=$1
shift
size=512x384 bounces=5 seconds=30
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

quietly() { "$@" 2>"$work/log" || { cat "$work/log" >&2; exit 1; }; }

converge() {  # converge FILE ARGUMENT...: as JSON, into $text
  text=$(quietly "$program" converge "$1" --against "$work/r.exr" --size $size --bounces $bounces --block 4 \
    --seconds $seconds --json "${@:2}")
}

number() {  # number NAME FORMAT [FACTOR]: the last value of that name in $text
  local value
  value=$(sed -n "s/^  \"$1\": \\([0-9.e-]*\\|null\\),*\$/\\1/p" <<<"$text" | tail -1)
  [ "$value" != null ] && LC_ALL=C printf "$2" "$(awk "BEGIN { print $value * ${3:-1} }")" || printf 'never'
}

row() {  # row NAME FILE PATHS: those of a pixel of the reference
  quietly "$program" render "$2" --method reference --size $size --bounces $bounces --spp "$3" -o "$work/r.exr" \
    >/dev/null
  converge "$2"
  local cells
  cells="$(number first_frame '%.2f s') | $(number to_10 '%.1f s') | $(number to_5 '%.1f s') | "
  cells+="$(number settled '%.1f s') | $(number end '%.1f%%' 100)"
  converge "$2" --set repair=0 --set refine=0
  echo "| $1 | $cells | $(number settled '%.1f s') | $(number end '%.1f%%' 100) |"
}

echo "| scene | first frame | 10% | 5% | settled | after $seconds s | without repair: settled | its error |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- |"
for file in assets/scenes/{cornell_style,pillar_room,door_ajar,corridor}.gltf \
  ../shared/scenes/{living-room,bathroom,classroom,bedroom,modern-hall,kenney-fps-level,zdm2-map}/*.gl*; do
  [ -f "$file" ] || continue
  name=$(basename "${file%.*}")
  [ $# -eq 0 ] && wanted=1 || wanted=0
  for part in "$@"; do case $name in *"$part"*) wanted=1 ;; esac; done
  case $file in assets/*) paths=512 ;; *) paths=256 ;; esac
  [ $wanted -eq 0 ] || row "$name" "$file" $paths
done
