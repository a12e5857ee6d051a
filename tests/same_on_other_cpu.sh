#!/usr/bin/env bash
# Compares the results of this processor with those of an emulated one (qemu), which has AVX2, no
# AVX-512, and different approximate reciprocals. They must be equal bit for bit.
#   tests/same_on_other_cpu.sh LAMPLIGHTER RAY_HITS
set -u
lamplighter=$1 ray_hits=$2
cd "$(dirname "$0")/.." || exit 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
other=(qemu-x86_64 -cpu max)
bad=0

# Pictures must be equal bit for bit. In these views no ray hits an edge exactly.
picture() {  # picture NAME ARGUMENT...: arguments of `lamplighter render`
  local name=$1; shift
  "$lamplighter" render "$@" -o "$work/here.exr" --size 96x54 --backend cpu || { bad=1; return; }
  "${other[@]}" "$lamplighter" render "$@" -o "$work/there.exr" --size 96x54 --backend cpu || { bad=1; return; }
  if cmp -s "$work/here.exr" "$work/there.exr"; then
    echo "picture $name: equal"
  else
    echo "picture $name: DIFFERS: $("$lamplighter" compare "$work/there.exr" "$work/here.exr" | tr -s '\n ' ' ')"
    bad=1
  fi
}

# Rays that hit the same triangle must give the same bits. One ray in a thousand at an edge or a corner,
# and one in ten thousand elsewhere, may hit another triangle. Distances alone may differ only where one
# processor misses what the other one hits: one in a thousand.
rays() {  # rays SCENE COUNT
  "$ray_hits" "$1" "$2" > "$work/here" || { bad=1; return; }
  "${other[@]}" "$ray_hits" "$1" "$2" > "$work/there" || { bad=1; return; }
  paste -d' ' "$work/here" "$work/there" | awk -v name="$(basename "$1")" '
    { n[$1]++; half = NF / 2 }
    $1 == "d" { ties["d"] += $2 != $4; next }              # a distance only
    NF % 2 == 1 { ties[$1]++; next }                       # hit on one processor only
    half == 2 { next }
    $2 != $(half + 2) || $3 != $(half + 3) { ties[$1]++; next }
    $4 != $(half + 4) || $5 != $(half + 5) || $6 != $(half + 6) { bits++ }
    END {
      printf "rays of %s: another triangle: %d of %d at random, %d of %d at edges, %d of %d at corners; distances of %d of %d; other bits: %d\n",
        name, ties["a"], n["a"], ties["e"], n["e"], ties["c"], n["c"], ties["d"], n["d"], bits
      exit bits > 0 || ties["a"] * 10000 > n["a"] || (ties["e"] + ties["c"]) * 1000 > n["e"] + n["c"] ||
        ties["d"] * 1000 > n["d"]
    }' || bad=1
}

# Documents and pictures of recordings must be equal bit for bit.
recording() {  # recording NAME
  local from=tests/recordings/$1.jsonl
  "$lamplighter" replay "$from" --headless --frame-clock "${few_rays[@]}" -o "$work/here_$1" > "$work/here" || { bad=1; return; }
  "${other[@]}" "$lamplighter" replay "$from" --headless --frame-clock "${few_rays[@]}" -o "$work/there_$1" > "$work/there" || { bad=1; return; }
  rm -f "$work"/*/*.window.png  # drawn by OpenGL
  if diff <(grep document "$work/here") <(grep document "$work/there") && diff -r "$work/here_$1" "$work/there_$1"; then
    echo "recording $1: equal, $(grep -c document "$work/here") checkpoints"
  else
    echo "recording $1: DIFFERS"
    bad=1
  fi
}

# For light on surfaces and along links: the emulator traces about 100,000 rays per second.
few_rays=(--set gather_rays=16 --set coarse_edge=1 --set texel=1 --set link_error=5)

rays assets/scenes/default.gltf 60000
rays assets/scenes/pillar_room.gltf 60000
picture default assets/scenes/default.gltf --vpls 32 "${few_rays[@]}"
picture pillar_room assets/scenes/pillar_room.gltf --vpls 32 "${few_rays[@]}"
picture table_room,naive assets/scenes/table_room.gltf --vpls 32 --set technique=naive "${few_rays[@]}"
picture cornell_style,prt assets/scenes/cornell_style.gltf --vpls 32 --set prt=true
picture default,reference assets/scenes/default.gltf --method reference --spp 4
picture area_light_room,reference assets/scenes/area_light_room.gltf --method reference --spp 4
if [ -d ../shared/scenes ]; then
  rays ../shared/scenes/zdm2-map/zdm2.glb 60000
  picture kenney,reference ../shared/scenes/kenney-fps-level/kenney-fps-level.gltf --method reference --spp 2
else
  echo "levels are skipped: there is no ../shared/scenes"
fi
recording add_light_menu
recording exposure_and_tone
exit $bad
