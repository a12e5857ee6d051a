#include "renderer/methods/common_statistics.h"

#include <algorithm>
#include <stdexcept>

namespace lamplighter {

double GiStats::secondsOf(const StageSpec& stage) const {
  const auto it = std::ranges::find(stageSeconds, stage, &StageTime::stage);
  return it == stageSeconds.end() ? 0.0 : it->seconds;
}

std::optional<double> GiStats::find(std::string_view name) const {
  const auto it = std::find_if(declared.begin(), declared.end(),
                               [&](const Statistic& s) { return s.spec->name == name; });
  return it == declared.end() ? std::nullopt : std::optional(it->value);
}

double GiStats::of(std::string_view name) const {
  if (const auto value = find(name)) return *value;
  throw std::out_of_range("there is no statistic " + std::string(name));
}

const StatisticTable<GiStats>& commonStatistics() {
  static const StatisticTable<GiStats> table{{&GiStats::raysTraced,
                                              {.name = "rays",
                                               .label = "Rays",
                                               .unit = "rays",
                                               .meaning = "Rays traced by the method.",
                                               .kind = StatisticKind::work,
                                               .inTimeline = true}},
                                             {&GiStats::samplesPerPixel,
                                              {.name = "samples_per_pixel",
                                               .label = "Samples per pixel",
                                               .unit = "samples",
                                               .meaning = "Samples of each pixel so far.",
                                               .status = "{} samples per pixel",
                                               .shownFrom = 2.0,
                                               .budget = "samples_per_pixel",
                                               .cost = "{} so far"}}};
  return table;
}

}  // namespace lamplighter
