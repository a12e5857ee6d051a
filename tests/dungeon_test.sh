#!/usr/bin/env bash
# Checks tests/tools/dungeon.py: the same bytes from two runs, a level of at least a million triangles
# and exactly 100 lamps that the program opens without warnings, and one line for bad input.
# usage: dungeon_test.sh LAMPLIGHTER
# Exit code 77 (skipped) without ../shared/scenes or without Python.
set -u
[ $# -eq 1 ] || { echo "usage: dungeon_test.sh LAMPLIGHTER" >&2; exit 2; }
program=$(realpath "$1")
cd "$(dirname "$0")/.." || exit 2
kit=../shared/scenes/dungeon-kit
[ -d "$kit" ] || { echo "dungeon_test: skipped, there is no $kit"; exit 77; }
for tool in python3 jq; do
  command -v $tool >/dev/null || { echo "dungeon_test: skipped, there is no $tool"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=0
fail() { echo "dungeon_test: $*"; bad=1; }

mkdir "$work/a" "$work/b"
for run in a b; do
  python3 tests/tools/dungeon.py "$kit" "$work/$run/dungeon.gltf" >"$work/$run/out" || fail "run $run failed"
done
for file in dungeon.gltf dungeon.bin; do
  cmp "$work/a/$file" "$work/b/$file" || fail "$file differs between two runs"
done
[ "$(du -sb "$work/a" | cut -f1)" -lt 10000000 ] || fail "the files have 10 MB or more"

"$program" info "$work/a/dungeon.gltf" --json >"$work/info.json" 2>"$work/warnings" || fail "info failed"
cat "$work/warnings"
triangles=$(jq .triangles "$work/info.json")
[ "$triangles" -ge 1000000 ] || fail "$triangles triangles"
grep -q " $triangles triangles .* 100 lamps" "$work/a/out" || fail "the script says: $(cat "$work/a/out")"
jq -e '(.lights | length) == 100 and (.cameras | length) >= 4 and (.warnings | length) == 0' \
  "$work/info.json" >/dev/null || fail "lights, cameras or warnings are not as they should be"

# refused ARGUMENTS...: exit code 2, and one line
refused() {
  python3 tests/tools/dungeon.py "$@" >"$work/out" 2>&1
  local code=$?
  if [ $code -ne 2 ] || [ "$(wc -l <"$work/out")" -ne 1 ]; then
    fail "dungeon.py $*: code $code, $(cat "$work/out")"
  fi
}
refused
refused "$work" "$work/c.gltf"
refused "$kit" "$work/c.glb"
refused "$kit" "$work/no/folder.gltf"
mkdir "$work/kit"
cp "$kit"/*.glb "$work/kit"
for text in "" "not a piece of the kit at all"; do
  printf '%s' "$text" >"$work/kit/wall.glb"
  refused "$work/kit" "$work/c.gltf"
done
head -c 30000 "$kit/wall.glb" >"$work/kit/wall.glb"
refused "$work/kit" "$work/c.gltf"
exit $bad
