// What each budget cost in the last frames, and what it buys: for the panel, beside the slider.
#pragma once

#include <optional>
#include <string>

#include "editor/document/document.h"
#include "editor/timeline/timeline.h"

namespace lamplighter {

struct BudgetCost {
  std::string measured;  // "24 maps, 8.1 ms (340 µs each)"; "idle" where nothing was done
  std::string buys;      // a sentence
};

// Of the frames that are kept in which the budget was drawn upon; `now`: the last frame's. None for
// a parameter that is no budget.
std::optional<BudgetCost> costOf(const std::string& parameter, const Timeline& timeline,
                                 const GiStats& now, const Settings& settings);

}  // namespace lamplighter
