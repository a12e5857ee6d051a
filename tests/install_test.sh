#!/usr/bin/env bash
# Checks that the program finds its shaders and assets after `cmake --install` and in the Debian package,
# in any folder. install_test.sh BUILD_FOLDER
set -eu
build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export HOME=$work/home XDG_CACHE_HOME=$work/cache XDG_CONFIG_HOME=$work/config XDG_STATE_HOME=$work/state
fail() { echo "install_test: $*" >&2; exit 1; }

# Checks that the program in $1/bin works and uses only the files of its own installation.
check() {
  local root=$1 scene=$1/share/lamplighter/assets/scenes/default.gltf
  [ -x "$root/bin/lamplighter" ] || fail "no program in $root"
  "$root/bin/lamplighter" --version | grep -q '^lamplighter ' || fail "--version says nothing"
  "$root/bin/lamplighter" render "$scene" -o "$work/a.png" --size 64x48 --vpls 16 --backend gl ||
    fail "it does not render"
  [ -s "$work/a.png" ] || fail "no picture"
  for file in share/applications/lamplighter.desktop share/man/man1/lamplighter.1* \
    share/icons/hicolor/scalable/apps/lamplighter.svg share/doc/lamplighter/README.md; do
    # shellcheck disable=SC2086  # a pattern
    ls $root/$file >/dev/null 2>&1 || fail "no $file"
  done
  # An error in the installed shaders must appear, which shows that the program reads no others.
  echo 'this is not a shader' >>"$root/share/lamplighter/shaders/shared/vpl.h"
  if "$root/bin/lamplighter" render "$scene" -o "$work/b.png" --size 64x48 --vpls 16 --backend gl 2>"$work/err"; then
    fail "it takes its shaders from elsewhere"
  fi
}

cmake --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/moved"
check "$work/moved"

if command -v desktop-file-validate >/dev/null; then
  desktop-file-validate "$work/moved/share/applications/lamplighter.desktop" || fail "the desktop entry is not valid"
fi
if command -v man >/dev/null; then
  warnings=$(man --warnings -l "$work/moved/share/man/man1/lamplighter.1" 2>&1 >/dev/null || true)
  [ -z "$warnings" ] || fail "the man page: $warnings"
fi

if ! command -v dpkg-shlibdeps >/dev/null; then
  echo "install_test: no dpkg-dev: the Debian package is not tested"
  exit 0
fi
(cd "$work" && cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work/package" >"$work/cpack.log" 2>&1) ||
  { cat "$work/cpack.log" >&2; fail "cpack"; }
package=$(ls "$work"/package/*.deb)
for needed in libembree3 libopenimageio libglfw3 fonts-inter; do
  dpkg-deb -f "$package" Depends | grep -q "$needed" || fail "the package does not depend on $needed"
done
# Installs with dpkg into a separate root and database. The dependencies are those of this machine.
mkdir -p "$work/root" "$work/db/info" "$work/db/updates" "$work/db/triggers"
touch "$work/db/status" "$work/db/available"
dpkg --force-not-root --force-depends --log="$work/dpkg.log" --admindir="$work/db" --instdir="$work/root" \
  --install "$package" >"$work/dpkg.out" 2>&1 || { cat "$work/dpkg.out" >&2; fail "dpkg --install"; }
check "$work/root/usr"
