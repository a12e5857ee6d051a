#!/usr/bin/env bash
# Tests the steps of a new user on a minimal Debian 12 with git: builds the committed tree in one root
# file system by the commands of the README, then installs and starts the package in another one without
# a compiler. bare_debian.sh [FOLDER]; the given FOLDER is kept, with logs and pictures. Needs root,
# debootstrap, a network, 6 GiB of disk and about half an hour.
set -eu
cd "$(dirname "$0")/.."
fail() { echo "bare_debian: $*" >&2; exit 1; }
[ "$(id -u)" = 0 ] || fail "chroot needs root: run it with sudo"
command -v debootstrap >/dev/null || fail "there is no debootstrap: apt install debootstrap"

mirror=${LAMPLIGHTER_DEBIAN_MIRROR:-http://deb.debian.org/debian}
work=${1:-$(mktemp -d)}
mkdir -p "$work"
work=$(cd "$work" && pwd)
leave() {
  for root in "$work/build" "$work/use"; do
    for place in proc dev/pts dev/shm; do
      ! mountpoint -q "$root/$place" || umount "$root/$place"
    done
  done
}
trap leave EXIT
[ $# -gt 0 ] || trap 'leave; rm -rf --one-file-system "$work"' EXIT

# Creates a root file system with the smallest variant of debootstrap.
bare() {
  [ -d "$work/minimal" ] || { debootstrap --variant=minbase bookworm "$work/new" "$mirror" >"$work/debootstrap.log" &&
    mv "$work/new" "$work/minimal"; }
  rm -rf --one-file-system "${work:?}/$1"
  cp -a "$work/minimal" "$work/$1"
  mount -t proc proc "$work/$1/proc"
  mkdir -p "$work/$1/dev/pts" "$work/$1/dev/shm"
  mount -t devpts devpts "$work/$1/dev/pts"
  mount -t tmpfs tmpfs "$work/$1/dev/shm"
  cp /etc/resolv.conf "$work/$1/etc/resolv.conf"
}
# inside ROOT COMMAND: runs COMMAND in ROOT, without the environment of this machine.
inside() {
  chroot "$work/$1" env -i HOME=/root TERM=dumb PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" bash -euc "$2"
}
install() {
  inside "$1" "apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq $2 >/dev/null"
}

echo "bare_debian: a Debian 12 with git"
bare build
install build "--no-install-recommends git"
mkdir "$work/build/source"
git archive --format=tar HEAD | tar -x -C "$work/build/source"
inside build "cd /source && git init -q && git add -A && git -c user.name=- -c user.email=- commit -q -m tree &&
  git clone -q /source /root/lamplighter"

echo "bare_debian: ./dev run"
inside build "cd /root/lamplighter && ./dev run"
[ -s "$work/build/root/lamplighter/out/default.png" ] || fail "./dev run wrote no picture"
echo "bare_debian: ./dev package"
inside build "cd /root/lamplighter && ./dev package"

echo "bare_debian: the package on another Debian 12"
bare use
cp "$work"/build/root/lamplighter/out/*.deb "$work/use/root/"
# Packages that a desktop has: a display, and man.
install use "--no-install-recommends xvfb xauth imagemagick man-db"
install use "/root/*.deb"
inside use "lamplighter --version; lamplighter --help >/root/help.txt; grep -q SCENE /root/help.txt
  man -P cat lamplighter >/root/man.txt; grep -q 'lighting editor' /root/man.txt
  cd /root && lamplighter render /usr/share/lamplighter/assets/scenes/default.gltf -o render.png --size 640x360
  test -s render.png"
# Runs the window for twenty seconds: it must keep running and show more than one colour.
inside use "cd /root && cat >start.sh <<'EOF'
lamplighter & sleep 20
kill -0 \$! || exit 1
import -window root window.png
kill \$!
EOF
xvfb-run -a -s '-screen 0 1280x720x24' bash start.sh
test \"\$(identify -format %k window.png)\" -gt 1000"
cp "$work/build/root/lamplighter/out/default.png" "$work/default.png"
cp "$work/use/root/render.png" "$work/use/root/window.png" "$work/use/root/help.txt" "$work/use/root/man.txt" "$work/"
[ $# -eq 0 ] || echo "bare_debian: pictures are in $work"
echo "bare_debian: built, installed and started"
