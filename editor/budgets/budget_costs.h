// The cost of each budget in the last frames, and its benefit. The panel shows both beside the
// slider.
#pragma once

#include <optional>
#include <string>

#include "editor/timeline/timeline.h"

namespace lamplighter {

struct BudgetCost {
  std::string measured;  // "24 maps, 8.1 ms (340 µs each)"; "idle" if no work was done
  std::string buys;      // the benefit, as one sentence
};

// The cost of a budget of the method, from the statistics that name it. Time is the mean over the
// recorded frames that used the budget. Memory comes from `now`, the statistics of the last frame.
// Returns nothing if the parameter is not a budget.
std::optional<BudgetCost> costOf(const ParameterSpec& parameter, const MethodInfo& method,
                                 const Timeline& timeline, const GiStats& now);

}  // namespace lamplighter
