// Divides the sums of each row by its total: shares from 0 to 1. Where all values are 0, they are
// uniform. y is the row.
#include "shared/bindings.h"

layout(local_size_x = kScanGroup) in;
layout(std430, binding = kScanSums) readonly buffer Sums { float sums[]; };
layout(std430, binding = kScanShares) writeonly buffer Shares { float shares[]; };
layout(std430, binding = kScanTotals) writeonly buffer Totals { float totals[]; };
layout(location = 0) uniform uint uColumns;

void main() {
  uint column = gl_GlobalInvocationID.x, row = gl_WorkGroupID.y;
  if (column > uColumns) return;
  uint first = row * (uColumns + 1u);
  float total = sums[first + uColumns];
  float share = total > 0.0 ? sums[first + column] / total : float(column) / float(uColumns);
  shares[first + column] = column == uColumns && uColumns > 0u ? 1.0 : min(share, 1.0);
  if (column == 0u) totals[row] = total;
}
