#!/usr/bin/env bash
# Checks that every relative link, image and source path in backticks of the pages exists.
# docs_test.sh [FOLDER of the pages; default: this repository]
set -u
self=$(realpath "$0")
cd "${1:-$(dirname "$0")/..}" || exit 2
pages=$(find . -name '*.md' -not -path './build/*' -not -path './out/*')
[ -n "$pages" ] || { echo "docs_test: no pages"; exit 2; }
# PAGE<tab>kind<tab>TARGET for each link and each path, without those in code blocks and comments.
# shellcheck disable=SC2086  # a list
targets=$(awk '
  FNR == 1 { code = comment = 0 }
  /^```/ { code = !code; next }
  /^<!--/ && !/-->/ { comment = 1 }
  comment { if (/-->/) comment = 0; next }
  code { next }
  {
    rest = $0
    while (match(rest, /\]\([^)]*\)/)) {
      print FILENAME "\tlink\t" substr(rest, RSTART + 2, RLENGTH - 3)
      rest = substr(rest, RSTART + RLENGTH)
    }
    rest = $0
    while (match(rest, /`(renderer|editor|ui|shaders|tests|tools|docs|assets|cmake)\/[^` ]*`/)) {
      print FILENAME "\tpath\t" substr(rest, RSTART + 1, RLENGTH - 2)
      rest = substr(rest, RSTART + RLENGTH)
    }
  }' $pages)
bad=0
while IFS=$'\t' read -r page kind target; do
  case $target in '' | '#'* | *://*) continue ;; esac
  file=${target%%#*}
  [ "$kind" = path ] || file=$(dirname "$page")/$file
  # shellcheck disable=SC2086  # a pattern such as tests/*.sh
  ls -d $file >/dev/null 2>&1 || { echo "$page: $kind to $target, which does not exist"; bad=1; }
done <<<"$targets"
if [ $# -eq 0 ]; then  # tests this script: it must report a dead link and a dead path
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  for text in '[a](b.md)' '`renderer/not_there.h`'; do
    echo "$text" >"$work/page.md"
    "$self" "$work" >/dev/null && { echo "docs_test: $text was not reported"; bad=1; }
  done
fi
exit $bad
