#!/usr/bin/env bash
# Checks the layers of docs/design/architecture.md by the includes: shaders/shared <- renderer <- editor
# <- ui; ImGui and GLFW in ui only; OpenGL only in the gl folders of renderer and in ui.
set -u
cd "$(dirname "$0")/.." || exit 2
bad=0
forbid() {  # forbid PATTERN WHERE... : no #include there may match PATTERN
  local pattern=$1; shift
  local rows
  rows=$(grep -rnE "#include *[<\"]($pattern)" "$@" --include='*.h' --include='*.cpp' 2>/dev/null)
  if [ -n "$rows" ]; then printf 'include against the layers:\n%s\n' "$rows"; bad=1; fi
}
forbid 'GLFW/|imgui' renderer editor shaders
forbid 'ui/|editor/' renderer shaders
forbid 'ui/|epoxy/|renderer/(.*/)?gl/|EGL/' editor
rows=$(grep -rnE '#include *[<"](epoxy/|EGL/|renderer/(.*/)?gl/)' renderer --include='*.h' \
         --include='*.cpp' 2>/dev/null | grep -vE '^renderer/(.*/)?gl/')
if [ -n "$rows" ]; then printf 'OpenGL outside the gl parts:\n%s\n' "$rows"; bad=1; fi
rows=$(grep -rnE '(std::rand\b|random_device|system_clock|time\(NULL\)|time\(nullptr\))' renderer editor 2>/dev/null)
if [ -n "$rows" ]; then printf 'clock or unseeded randomness below ui:\n%s\n' "$rows"; bad=1; fi
# Only counted calls wait for the GPU; queries are read when they are available.
rows=$(grep -rnwE 'gl(Finish|ReadPixels|ReadnPixels|GetTexImage|GetnTexImage|GetTextureImage|GetTextureSubImage|GetBufferSubData|GetNamedBufferSubData|MapBuffer|MapBufferRange|MapNamedBuffer|MapNamedBufferRange|ClientWaitSync|GetQueryObject[a-z0-9]+|GetQueryBufferObject[a-z0-9]+)' \
         renderer editor ui --include='*.h' --include='*.cpp' 2>/dev/null |
  grep -vE '^(renderer/gl/(waits|query|stage_clock)\.cpp|ui/platform/read_pixels\.cpp):')
if [ -n "$rows" ]; then printf 'waits for the GPU outside renderer/gl/waits.cpp:\n%s\n' "$rows"; bad=1; fi
# The includes between the folders of a layer must not have a cycle, either.
for layer in renderer editor ui; do
  loop=$(grep -rHE "^ *# *include *\"$layer/" "$layer" --include='*.h' --include='*.cpp' |
    sed -E 's|^(.*)/[^/]*: *# *include *"(.*)/[^/"]*".*|\1 \2|' | awk '$1 != $2' | sort -u | tsort 2>&1 >/dev/null)
  if [ -n "$loop" ]; then printf 'folders of %s that include each other in a circle:\n%s\n' "$layer" "$loop"; bad=1; fi
done
rows=$(find renderer editor ui shaders tests -name '*.h' -o -name '*.cpp' -o -name '*.glsl' | sed 's|/[^/]*$||' | sort | uniq -c |
  awk '$1 > 34')
if [ -n "$rows" ]; then printf 'folders of more than 34 files:\n%s\n' "$rows"; bad=1; fi
rows=$(find renderer editor ui shaders tests \( -name '*.h' -o -name '*.cpp' -o -name '*.glsl' \) -exec wc -l {} + |
  awk '$2 != "total" && $1 > 500')
if [ -n "$rows" ]; then printf 'files of more than 500 lines:\n%s\n' "$rows"; bad=1; fi
exit $bad
