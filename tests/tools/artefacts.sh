#!/usr/bin/env bash
# The artefacts of the paper's section 6.1, before and after our corrections: prints a Markdown table,
# and writes the pictures of docs/results/artefacts.md to docs/images/.
# usage: tests/tools/artefacts.sh LAMPLIGHTER   (needs oiiotool and jq: ./dev artefacts)
set -eu
cd "$(dirname "$0")/../.."
program=$1
shared=../shared
[ -d "$shared/references" ] || { echo "artefacts: there is no $shared/references" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p docs/images

# before: without corrections; chosen: importance sampling of lights; then also the compensation of
# the clamping bias (bias_compensation); refined: also refinement.
arguments_of() {
  case $1 in
    before) echo --set importance=1 --set bias_compensation=off ;;
    chosen) echo --set bias_compensation=off ;;
    refined) echo --set refine=32768 ;;
  esac
}

render() {  # render NAME SCENE ARGUMENTS... : $work/NAME.exr
  local name=$1 scene=$2
  shift 2
  "$program" render "$scene" -o "$work/$name.exr" --backend cpu --set indirect=samples "$@" >/dev/null 2>&1
}

# rows LABEL SCENE REFERENCE MASK SEEDS COUNTS ARGUMENTS... : relRMSE and relMSE as root mean square
# and mean over the seeds, and brightness, a row for each count of light samples.
rows() {
  local label=$1 scene=$2 reference=$3 seeds=$5 counts=$6 vpls way seed mask=()
  [ -z "$4" ] || mask=(--mask "$4")
  shift 6
  for vpls in $counts; do
    local rmse="" mse="" bias=""
    for way in before chosen after; do
      for seed in $seeds; do
        # shellcheck disable=SC2046  # words
        render a "$scene" --vpls "$vpls" --set "seed=$seed" "$@" $(arguments_of $way)
        "$program" compare "$work/a.exr" "$reference" ${mask[@]+"${mask[@]}"} --json
      done > "$work/metrics"
      rmse+=" $(jq -rs '(map(.relRMSE * .relRMSE) | add / length | sqrt * 100)' "$work/metrics")"
      mse+=" $(jq -rs '(map(.relMSE) | add / length)' "$work/metrics")"
      bias+=" $(jq -rs '(map(.bias) | add / length)' "$work/metrics")"
    done
    # shellcheck disable=SC2086  # three numbers each
    LC_ALL=C printf "| $label | $vpls | %.1f%% | %.1f%% | %.1f%% | %.4f | %.4f | %.4f | %.3f | %.3f | %.3f |\n" \
      $rmse $mse $bias
    label=
  done
}

cat <<'HEAD'
| scene | VPLs | relRMSE before | chosen | and corners | relMSE before | chosen | and corners | brightness before | chosen | and corners |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
HEAD
few=(--bounces 4 --size 320x180)
for scene in narrow_gap close_light; do
  render "$scene.reference" "assets/scenes/$scene.gltf" "${few[@]}" --set refine=32768
  rows "$scene" "assets/scenes/$scene.gltf" "$work/$scene.reference.exr" "" "1 2 3" "100 300 1024" "${few[@]}"
done
refs=$shared/references
rows cornell "$refs/scenes/cornell.gltf" "$refs/refs/cornell_b5.exr" "$refs/refs/cornell_mask.exr" \
  "1 2 3" "300 1024 4096" --bounces 5 --size 512x384
# Without speculars, because highlights of single pixels would dominate the error.
room=(--size 240x135 --set speculars=false)
for scene in living-room classroom; do
  file=$shared/scenes/$scene/$scene.gltf
  render "$scene.reference" "$file" "${room[@]}" --method reference --spp 1024
  rows "$scene" "$file" "$work/$scene.reference.exr" "" "1 2 3" "300 1024" "${room[@]}"
done

files=()
pictures() {  # pictures SCENE VPLS CUT ARGUMENTS... : before, after and refined
  local scene=$1 vpls=$2 cut=$3 way
  shift 3
  for way in before after refined; do
    # shellcheck disable=SC2046  # words
    render "$scene.$way" "assets/scenes/$scene.gltf" --vpls "$vpls" "$@" $(arguments_of $way)
    "$program" tonemap "$work/$scene.$way.exr" -o "$work/whole.png" >/dev/null
    oiiotool "$work/whole.png" --cut "$cut" -o "$work/$scene.$way.png"
    files+=("$work/$scene.$way.png")
  done
}
pictures narrow_gap 300 320x180+0+0 "${few[@]}"
pictures close_light 100 320x180+0+0 "${few[@]}"
pictures pillar_room 300 320x180+330+210 --size 800x500
oiiotool "${files[@]}" --mosaic:pad=4 3x3 --attrib:type=int compression:quality 90 -o docs/images/artefacts.jpg
