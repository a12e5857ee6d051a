// All memory limits of a method as one value: the sum of its budgets in MiB. A user sets the sum,
// and each limit keeps its proportion.
#pragma once

#include <cstdint>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

// The sum of all limits [MiB]; 0 if the method has none.
int memoryLimit(const MethodInfo& method, const Settings& settings);
// The sums in whose range all limits keep their proportions [MiB]; 0 if the method has none.
struct MemoryRange {
  int least = 0, most = 0;
};
MemoryRange memoryRange(const MethodInfo& method);

// The settings with limits whose sum is about `total` MiB, in the proportions of their defaults.
Settings withMemoryLimit(const MethodInfo& method, Settings settings, int total);

// Memory that the method uses under these limits, from the statistics of the last frame [bytes].
uint64_t memoryUsed(const MethodInfo& method, const GiStats& now);

}  // namespace lamplighter
