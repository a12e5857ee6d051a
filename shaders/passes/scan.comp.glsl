// Exclusive prefix sums of each row within its work groups; y is the row.
#include "common/scan.glsl"

layout(local_size_x = kScanGroup) in;
layout(std430, binding = kScanValues) readonly buffer Values { SCAN_TYPE values[]; };
layout(std430, binding = kScanSums) writeonly buffer Sums { SCAN_TYPE sums[]; };
layout(std430, binding = kScanGroupSums) writeonly buffer Groups { SCAN_TYPE groups[]; };
layout(location = 0) uniform uint uColumns;

void main() {
  uint column = gl_GlobalInvocationID.x, row = gl_WorkGroupID.y;
  SCAN_TYPE total;
  SCAN_TYPE value = column < uColumns ? values[row * uColumns + column] : SCAN_TYPE(0);
  SCAN_TYPE sum = scanGroup(value, total);
  uint first = row * (uColumns + 1u);
  if (column < uColumns) sums[first + column] = sum;
  if (gl_LocalInvocationID.x != 0u) return;
  if (gl_NumWorkGroups.x == 1u) {
    sums[first + uColumns] = total;
  } else {
    groups[row * gl_NumWorkGroups.x + gl_WorkGroupID.x] = total;
  }
}
