#!/usr/bin/env bash
# How long shared levels, seen from inside, take to settle, and to follow a lamp that is moved, as
# rows of Markdown tables, at default settings on the cpu backend. Fails if a level needs more than
# 2 GiB of memory.
# usage: tests/tools/levels.sh LAMPLIGHTER [SIZE of the settled pictures, default 480x270]
# (./dev levels; some minutes)
set -eu
cd "$(dirname "$0")/../.."
program=$(realpath "$1")
size=${2:-480x270}
most_memory=$((2 << 30))
scenes=$(realpath ../shared/scenes 2>/dev/null) || { echo "levels: there is no ../shared/scenes" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# with_camera SCENE POSITION ROTATION: a copy with a camera, whose node has this position and this
# quaternion, as $work/with_camera/level.gltf.
with_camera() {
  mkdir -p "$work/with_camera"
  echo "file.save_as $work/with_camera/level.gltf" >"$work/save.txt"
  "$program" script "$work/save.txt" "$1" >/dev/null 2>&1
  jq --argjson at "$2" --argjson turn "$3" '
    .cameras = [{type: "perspective", perspective: {yfov: 1.05, znear: 0.05}}]
    | .nodes += [{name: "inside", camera: 0, translation: $at, rotation: $turn}]
    | .scenes[.scene // 0].nodes += [.nodes | length - 1]' \
    "$work/with_camera/level.gltf" >"$work/level.json"
  mv "$work/level.json" "$work/with_camera/level.gltf"
}

settled() {  # settled SCENE ARGUMENTS...: seconds; of them visibility and finer maps; tests
  local scene=$1
  shift
  "$program" render "$scene" -o "$work/a.exr" --backend cpu --size "$size" --stats "$work/stats.json" \
    "$@" >/dev/null 2>&1
  jq -r --argjson most "$most_memory" 'select(.peak_memory_bytes > $most) | .scene' \
    "$work/stats.json" >>"$work/too_large"
  jq -r '[.seconds.total, .stages.visibility, .stages["finer maps"], .visibility_tests / 1e6,
    .light_map_bytes / 1048576, .peak_memory_bytes / 1048576] | map(. * 100 | round / 100) | join(" | ")' \
    "$work/stats.json"
}

# A rectangle light in front of the camera, in two directions.
lamp_moved() {
  printf 'light.add rectangle\nfile.save_as %s\n' "$work/from.glb" >"$work/from.txt"
  printf 'camera.turn 12 0\nlight.add rectangle\nfile.save_as %s\n' "$work/to.glb" >"$work/to.txt"
  local state
  for state in from to; do "$program" script "$work/$state.txt" "$1" >/dev/null 2>&1; done
  "$program" render "$work/to.glb" -o "$work/to.exr" --backend cpu --size 640x360 >/dev/null 2>&1
  "$program" converge "$work/from.glb" "$work/to.glb" --against "$work/to.exr" --backend cpu \
    --size 640x360 --json 2>/dev/null |
    jq -r '[.opening.first_frame, .opening.settled, .first_frame, .to_10, .settled]
      | map(if . == null then "never" else . * 100 | round / 100 end) | join(" | ")'
}

levels() {  # levels COMMAND: a row for each
  local level
  for level in modern-hall/modern-hall.glb living-room/living-room.gltf classroom/classroom.gltf \
    bathroom/bathroom.glb bedroom/bedroom.glb kenney-fps-level/kenney-fps-level.gltf; do
    printf '| %s | %s |\n' "${level%%/*}" "$("$1" "$scenes/$level")"
  done
  with_camera "$scenes/zdm2-map/zdm2.glb" '[5, 6, 8]' '[0, 0.4557, 0, 0.8901]'
  printf '| zdm2 | %s |\n' "$("$1" "$work/with_camera/level.gltf")"
  with_camera "$scenes/candela-city/candela_city.glb" '[-90, -2, 35]' '[0, -0.5878, 0, 0.809]'
  printf '| candela-city | %s |\n' "$("$1" "$work/with_camera/level.gltf")"
}

naive() { settled "$1" --set technique=naive; }

echo "| settled | s | visibility | finer maps | million tests | light maps MiB | peak MiB |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
levels settled
echo
echo "| naive | s | visibility | finer maps | million tests | light maps MiB | peak MiB |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
levels naive
echo
echo "| lamp moved | open: first frame s | settled | moved: first frame | 10% | settled |"
echo "| --- | --- | --- | --- | --- | --- |"
levels lamp_moved
[ ! -s "$work/too_large" ] || { echo "levels: more than 2 GiB: $(sort -u "$work/too_large" | xargs)" >&2; exit 1; }
