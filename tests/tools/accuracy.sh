#!/usr/bin/env bash
# The errors of both methods against the independent pictures of the Cornell box, as rows of Markdown
# tables: the reference over sample counts, many_lights over counts of light samples, and many_lights
# refined to increasing counts.
# usage: tests/tools/accuracy.sh LAMPLIGHTER [SPP...]   (./dev accuracy; 4096 paths take half an hour)
set -eu
cd "$(dirname "$0")/../.."
program=$1
shift
[ $# -gt 0 ] || set -- 64 1024
refs=../shared/references
[ -d "$refs" ] || { echo "accuracy: there is no $refs" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

row() {  # row LABEL SCENE BOUNCES ARGUMENTS... : renders and compares
  local label=$1 scene=$2 bounces=$3 json
  shift 3
  "$program" render "$refs/scenes/$scene.gltf" -o "$work/a.exr" --size 512x384 --bounces "$bounces" \
    --backend cpu --stats "$work/stats.json" "$@" 2>/dev/null
  json=$("$program" compare "$work/a.exr" "$refs/refs/${scene}_b$bounces.exr" --mask "$refs/refs/${scene}_mask.exr" --json)
  number() { sed -n "s/.*\"$1\": *\\([0-9.e-]*\\).*/\\1/p" <<<"$json"; }
  LC_ALL=C printf '| %s | %s | %d | %.2f%% | %+.3f%% |\n' "$label" "$scene" "$bounces" \
    "$(awk "BEGIN { print 100 * $(number relRMSE) }")" "$(awk "BEGIN { print 100 * ($(number bias) - 1) }")"
}

echo "| method | scene | bounces | relRMSE | bias |"
echo "| --- | --- | --- | --- | --- |"
for vpls in 300 1024 4096; do
  for bounces in 0 1 5; do
    row "many_lights, $vpls light samples" cornell $bounces --set indirect=samples --vpls "$vpls"
    row "many_lights, $vpls light samples, meshes" cornell $bounces --set indirect=meshes --vpls "$vpls"
  done
done
for vpls in 1024 4096 16384 65536; do
  for bounces in 0 1 5; do
    row "many_lights, refined to $vpls light samples" cornell $bounces --set indirect=samples --set "refine=$vpls"
  done
done
for spp in "$@"; do
  for bounces in 0 1 5; do
    row "reference, $spp paths per pixel" cornell $bounces --method reference --spp "$spp"
  done
done
row "reference, $1 paths per pixel" cornell_lightmoved 1 --method reference --spp "$1"
