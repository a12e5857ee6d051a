#!/usr/bin/env bash
# How soon the live picture is near the path tracer in rooms that bounced light alone lights, after
# the lamp or an object moved, as a table. Five bounces, means of 8 x 8 pixels.
#   rooms.sh LAMPLIGHTER [PATHS PER PIXEL]
set -euo pipefail
lamplighter=$1 paths=${2:-256}
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

moved() {  # moved ROOM NODE METRES ALONG_X > GLTF
  jq --arg node "$2" --argjson by "$3" '(.nodes[] | select(.name == $node) | .translation[0]) += $by' \
    "assets/scenes/$1.gltf"
}

echo "| room | moved | 10% | 5% | settled | its error | noise of the reference |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
while IFS=: read -r room node by; do
  moved "$room" "$node" "$by" > "$work/to.gltf"
  common=(--size 512x384 --bounces 5)
  for seed in 1 2; do
    "$lamplighter" render "$work/to.gltf" "${common[@]}" --method reference --spp "$((paths / 2))" \
      --seed "$seed" -o "$work/$seed.exr" > "$work/log" 2>&1
  done
  oiiotool "$work/1.exr" "$work/2.exr" --add --mulc 0.5 -o "$work/reference.exr"
  # The difference of the halves is twice the noise of their mean.
  noise=$("$lamplighter" compare "$work/1.exr" "$work/2.exr" --block 8 --json | jq '50 * .relRMSE')
  "$lamplighter" converge "assets/scenes/$room.gltf" "$work/to.gltf" "${common[@]}" \
    --against "$work/reference.exr" --block 8 --json > "$work/curve.json" 2> "$work/log"
  jq -r --arg room "$room" --arg node "$node" --argjson noise "$noise" '
    def time: if . == null then "never" else "\(. * 100 | round / 100) s" end;
    "| \($room) | \($node) | \(.to_10 | time) | \(.to_5 | time) | \(.settled | time) | \(.end * 1000 | round / 10)% | \($noise * 10 | round / 10)% |"' \
    "$work/curve.json"
done <<'ROOMS'
corridor:lamp:-0.6
corridor:crate:0.5
door_ajar:lamp:-0.6
door_ajar:chest:0.6
cornell_style:lamp:0.4
pillar_room:ceiling light:1.5
ROOMS
