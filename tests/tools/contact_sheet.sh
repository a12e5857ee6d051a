#!/usr/bin/env bash
# Renders every scene of ../shared/scenes with both methods, side by side: many_lights left,
# reference right, at the exposure that suits the reference. Writes docs/images/contact_sheet.jpg,
# docs/images/contact_sheet_kit.jpg (the pieces of the dungeon kit) and docs/results/contact_sheet.md.
# usage: tests/tools/contact_sheet.sh LAMPLIGHTER [SCENE...]   (needs oiiotool: ./dev contact-sheet)
set -eu
cd "$(dirname "$0")/../.."
program=$1
shift
shared=../shared/scenes
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
size=${SIZE:-400x225} kit_size=${KIT_SIZE:-200x150} spp=${SPP:-128} vpls=${VPLS:-1024} bounces=3
mkdir -p docs/images

render() {  # render SCENE SIZE NAME: both pictures, joined, into $work/NAME.png; prints the row
  local scene=$1 wh=$2 name=$3 row
  "$program" render "$scene" -o "$work/$name-b.exr" --method reference --spp "$spp" \
    --bounces $bounces --size "$wh" --backend cpu 2>/dev/null
  "$program" render "$scene" -o "$work/$name-a.exr" --method many_lights --vpls "$vpls" \
    --bounces $bounces --size "$wh" --backend cpu --set map_resolution=128 2>/dev/null
  "$program" tonemap "$work/$name-b.exr" -o "$work/$name-b.png" --exposure auto \
    | sed 's/.*EV \([-0-9.]*\).*/\1/' > "$work/$name.ev"
  "$program" tonemap "$work/$name-a.exr" -o "$work/$name-a.png" --exposure "$(cat "$work/$name.ev")" >/dev/null
  oiiotool "$work/$name-a.png" "$work/$name-b.png" --mosaic:pad=2 2x1 -o "$work/$name.png"
  row=$("$program" compare "$work/$name-a.exr" "$work/$name-b.exr" --json)
  printf '| %s | %s | %.3f | %.3f |\n' "$name" "$(cat "$work/$name.ev")" \
    "$(sed -n 's/.*"relRMSE": *\([0-9.e-]*\).*/\1/p' <<<"$row")" \
    "$(sed -n 's/.*"bias": *\([0-9.e-]*\).*/\1/p' <<<"$row")"
}

sheet() {  # sheet COLUMNS OUT NAME...
  local columns=$1 out=$2 files=() name
  shift 2
  for name in "$@"; do files+=("$work/$name.png"); done
  local rows=$(((${#files[@]} + columns - 1) / columns))
  oiiotool "${files[@]}" --mosaic:pad=6 "${columns}x$rows" --attrib:type=int compression:quality 85 -o "$out"
}

scenes=() pieces=() table="" pieces_table=""
while IFS=$'\t' read -r file _; do
  [ "$file" != file ] || continue
  name=$(basename "${file%.*}")
  case "$file" in
    dungeon-kit/*) pieces_table+=$(render "$shared/$file" "$kit_size" "$name")$'\n'; pieces+=("$name") ;;
    *) table+=$(render "$shared/$file" "$size" "$name")$'\n'; scenes+=("$name") ;;
  esac
  echo "contact sheet: $name" >&2
done < "$shared/scenes.tsv"
sheet 2 docs/images/contact_sheet.jpg "${scenes[@]}"
sheet 6 docs/images/contact_sheet_kit.jpg "${pieces[@]}"

# The pieces in one line: their number, and their largest relRMSE and bias.
worst=$(awk -F'|' 'NF > 4 { n++; b = $5 - 1; if (b < 0) b = -b; if ($4 > e) e = $4; if (b > m) m = b }
  END { printf "%d pieces: relRMSE at most %.3f, bias within %.3f of 1.", n, e, m }' <<<"$pieces_table")
cat > docs/results/contact_sheet.md <<TXT
# Every test scene with both methods

Written by \`./dev contact-sheet\`. Left: \`many_lights\` ($vpls light samples, maps of 128²). Right: \`reference\` ($spp paths per
pixel). Both have $bounces bounces and the automatic exposure of the reference. relRMSE and bias compare left with right and include the noise of
the reference.

![Scenes](../images/contact_sheet.jpg)

| scene | EV | relRMSE | bias (mean A / mean B) |
| --- | --- | --- | --- |
$table
## The pieces of the dungeon kit

$worst

![Pieces](../images/contact_sheet_kit.jpg)
TXT
