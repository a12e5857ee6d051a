// Prefix sums within a work group of kScanGroup invocations in x. SCAN_TYPE: float, uint or int.
#ifndef LAMPLIGHTER_SCAN_GLSL
#define LAMPLIGHTER_SCAN_GLSL
#include "shared/bindings.h"

shared SCAN_TYPE scanPartial[kScanGroup];

// The sum of `value` over the invocations before this one; total: over all of them. All invocations
// of the group must call it.
SCAN_TYPE scanGroup(SCAN_TYPE value, out SCAN_TYPE total) {
  int i = int(gl_LocalInvocationIndex);
  scanPartial[i] = value;
  barrier();
  for (int step = 1; step < kScanGroup; step *= 2) {
    SCAN_TYPE before = i >= step ? scanPartial[i - step] : SCAN_TYPE(0);
    barrier();
    scanPartial[i] += before;
    barrier();
  }
  SCAN_TYPE sum = i > 0 ? scanPartial[i - 1] : SCAN_TYPE(0);
  total = scanPartial[kScanGroup - 1];
  barrier();  // so that the next call can write
  return sum;
}

#endif
