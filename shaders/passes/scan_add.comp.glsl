// Adds the sums before each work group to the sums within it (scan.comp.glsl); y is the row.
#include "shared/bindings.h"

layout(local_size_x = kScanGroup) in;
layout(std430, binding = kScanSums) buffer Sums { SCAN_TYPE sums[]; };
layout(std430, binding = kScanOffsets) readonly buffer Offsets { SCAN_TYPE offsets[]; };
layout(location = 0) uniform uint uColumns;
layout(location = 1) uniform uint uGroups;

void main() {
  uint column = gl_GlobalInvocationID.x, row = gl_WorkGroupID.y;
  if (column > uColumns) return;
  uint at = row * (uColumns + 1u) + column, offset = row * (uGroups + 1u);
  if (column == uColumns) {
    sums[at] = offsets[offset + uGroups];
  } else {
    sums[at] += offsets[offset + column / uint(kScanGroup)];
  }
}
