// All memory limits of a method as one: its budgets in MiB. A user sets their sum, and each keeps
// its part of it.
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

// What the method keeps in memory within these limits, by the statistics of the last frame [bytes].
uint64_t memoryUsed(const MethodInfo& method, const GiStats& now);

}  // namespace lamplighter
