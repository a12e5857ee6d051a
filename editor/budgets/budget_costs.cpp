#include "editor/budgets/budget_costs.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

namespace lamplighter {
namespace {

// "12", "1.2k", "3.4M": short, so that the line fits the panel.
std::string brief(double count) {
  if (count >= 1e6) return fmt::format("{:.3g}M", count / 1e6);
  if (count >= 1e4) return fmt::format("{:.3g}k", count / 1e3);
  return count >= 10.0 ? fmt::format("{:.0f}", count) : fmt::format("{:.3g}", count);
}

// "4 ns", "120 µs", "1.5 ms".
std::string briefTime(double seconds) {
  if (seconds >= 1e-3) return fmt::format("{:.2g} ms", 1e3 * seconds);
  if (seconds >= 1e-6) return fmt::format("{:.3g} \u00b5s", 1e6 * seconds);
  return fmt::format("{:.2g} ns", 1e9 * seconds);
}

// The mean cost of some work over the frames that did it.
std::string costOfWork(const StatisticSpec& work, const Timeline& timeline) {
  double counted = 0.0, seconds = 0.0;
  int frames = 0;
  for (const FrameTiming& f : timeline.frames()) {
    const double count = f.stats.find(work.name).value_or(0.0);
    if (count <= 0.0) continue;
    counted += count;
    ++frames;
    for (const StageSpec& stage : work.stages) seconds += f.stats.secondsOf(stage);
  }
  if (frames == 0) return "idle";
  return fmt::format("{} {}, {:.3g} ms ({} each)", brief(counted / frames), work.unit,
                     1e3 * seconds / frames, briefTime(seconds / counted));
}

std::string costOfFrames(const Timeline& timeline) {
  if (timeline.frames().empty()) return "idle";
  double longest = 0.0, sum = 0.0;
  for (const FrameTiming& f : timeline.frames()) {
    longest = std::max(longest, f.seconds());
    sum += f.seconds();
  }
  return fmt::format("{:.3g} ms per frame, {:.3g} ms at most",
                     1e3 * sum / static_cast<double>(timeline.frames().size()), 1e3 * longest);
}

// "12 maps, 3 MiB, 2 without room"
std::string costOfState(const std::string& budget, const GiStats& now) {
  std::string text;
  for (const auto& [spec, value] : now.declared)
    if (spec->budget == budget && value > 0.0)
      text += (text.empty() ? "" : ", ") + filled(spec->cost, *spec, value);
  return text.empty() ? "none" : text;
}

}  // namespace

std::optional<BudgetCost> costOf(const ParameterSpec& parameter, const MethodInfo& method,
                                 const Timeline& timeline, const GiStats& now) {
  if (parameter.group != ParameterGroup::budgets) return std::nullopt;
  const auto limited =
      std::find_if(method.statistics.begin(), method.statistics.end(),
                   [&](const StatisticSpec& s) { return s.budget == parameter.name; });
  std::string measured;
  if (limited == method.statistics.end())
    measured = costOfFrames(timeline);  // a limit for the frame as a whole
  else if (limited->kind == StatisticKind::work)
    measured = costOfWork(*limited, timeline);
  else
    measured = costOfState(parameter.name, now);
  return BudgetCost{std::move(measured), parameter.benefit};
}

}  // namespace lamplighter
