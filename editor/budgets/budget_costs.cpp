#include "editor/budgets/budget_costs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "renderer/methods/many_lights/parameters.h"

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

// The use of a budget: `count` is the amount, and `stages` are the stages whose time it takes.
struct Budget {
  const char* parameter;
  const char* unit;  // "maps"
  double (*count)(const GiStats& stats, const Settings& settings);
  std::vector<const char*> stages;
  const char* buys;
};

const std::vector<Budget>& budgets() {
  static const std::vector<Budget> all{
      {"updates",
       "samples",
       [](const GiStats& s, const Settings&) { return static_cast<double>(s.vplsRefreshed); },
       {"light samples", "visibility", "shadow maps", "light maps"},
       "More: an edit is seen whole in fewer frames. Fewer: each frame is shorter."},
      {"max_shadow_maps",
       "maps",
       [](const GiStats& s, const Settings&) { return static_cast<double>(s.mapsRendered); },
       {"shadow maps"},
       "More: shadows follow an edit in fewer frames."},
      {"max_rays",
       "rays",
       [](const GiStats& s, const Settings& settings) {
         const double side = manyLightsParameters().read(settings).mapResolution;
         return side * side * s.mapsRendered;
       },
       {"shadow maps"},
       "More: shadows follow an edit in fewer frames. The size of the maps decides how many rays "
       "each takes."},
      {"max_visibility_tests",
       "tests",
       [](const GiStats& s, const Settings&) { return static_cast<double>(s.visibilityTests); },
       {"visibility"},
       "More: sooner known which light reaches where, so that fewer pixels look into maps."},
      {"max_light_map_texels",
       "texels",
       [](const GiStats& s, const Settings&) { return static_cast<double>(s.lightMapTexels); },
       {"light maps"},
       "More: light without shadows follows an edit in fewer frames."},
      {"max_paths",
       "paths",
       [](const GiStats& s, const Settings&) { return static_cast<double>(s.pathsWalked); },
       {"light samples"},
       "More: bounced light follows what moves in fewer frames."},
      {"samples_per_frame",
       "paths a pixel",

       [](const GiStats& s, const Settings& settings) {
         return s.raysTraced == 0 ? 0.0 : sampleParameters().read(settings).samplesPerFrame;
       },
       {"paths"},
       "More: less noise in fewer frames, which take longer each."},
  };
  return all;
}

size_t indexOf(const std::string& stage) {
  const auto& all = Timeline::stages();
  return static_cast<size_t>(std::find(all.begin(), all.end(), stage) - all.begin());
}

std::string measured(const Budget& budget, const Timeline& timeline, const Settings& settings) {
  double counted = 0.0, seconds = 0.0;
  int frames = 0;
  for (const FrameTiming& f : timeline.frames()) {
    const double count = budget.count(f.stats, settings);
    if (count <= 0.0) continue;
    counted += count;
    ++frames;
    for (const char* stage : budget.stages) seconds += f.stageSeconds[indexOf(stage)];
  }
  if (frames == 0) return "idle";
  return fmt::format("{} {}, {:.3g} ms ({} each)", brief(counted / frames), budget.unit,
                     1e3 * seconds / frames, briefTime(seconds / counted));
}

BudgetCost frameTimeCost(const Timeline& timeline) {
  double longest = 0.0, sum = 0.0;
  for (const FrameTiming& f : timeline.frames()) {
    longest = std::max(longest, f.seconds());
    sum += f.seconds();
  }
  const auto count = static_cast<double>(std::max<size_t>(timeline.frames().size(), 1));
  return {timeline.frames().empty() ? "idle"
                                    : fmt::format("{:.3g} ms a frame, {:.3g} ms at most",
                                                  1e3 * sum / count, 1e3 * longest),
          "Longer: an edit is seen whole in fewer frames. Shorter: the hand is followed more "
          "smoothly."};
}

double mebibytes(uint64_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

BudgetCost mapMemoryCost(const GiStats& now) {
  const auto held = now.memoryBytes.find("shadow maps");
  std::string text = fmt::format("{} maps, {:.3g} MiB", now.mapsHeld,
                                 held == now.memoryBytes.end() ? 0.0 : mebibytes(held->second));
  if (now.mapsWithoutRoom > 0) text += fmt::format(", {} without room", now.mapsWithoutRoom);
  return {text, "More: every light sample that the view looks up has a shadow map of its own."};
}

BudgetCost visibilityMemoryCost(const GiStats& now) {
  const char* const buys = "More: patches of large levels are divided further, for fewer look-ups.";
  if (now.visibilityNeeds > 0)
    return {fmt::format("left out: needs {:.3g} MiB", mebibytes(now.visibilityNeeds)), buys};
  const auto held = now.memoryBytes.find("visibility");
  if (held == now.memoryBytes.end()) return {"none", buys};
  return {fmt::format("{:.3g} MiB", mebibytes(held->second)), buys};
}

BudgetCost lightMapMemoryCost(const GiStats& now) {
  const char* const buys = "More: smaller texels on large levels, down to light_map_texel.";
  const auto held = now.memoryBytes.find("light maps");
  if (held == now.memoryBytes.end()) return {"none", buys};
  if (now.lightMapTexel == 0.0f) return {"left out: no room for any", buys};
  return {fmt::format("{:.3g} MiB, texels of {:.2g} m", mebibytes(held->second), now.lightMapTexel),
          buys};
}

BudgetCost transferMemoryCost(const GiStats& now) {
  const char* const buys = "More: larger complex meshes are lit by transfer.";
  const auto held = now.memoryBytes.find("transfer");
  if (held == now.memoryBytes.end()) return {"none", buys};
  std::string text = fmt::format("{:.3g} MiB", mebibytes(held->second));
  if (now.transferObjectsWithoutRoom > 0)
    text += fmt::format(", {} meshes without room", now.transferObjectsWithoutRoom);
  return {text, buys};
}

}  // namespace

std::optional<BudgetCost> costOf(const std::string& parameter, const Timeline& timeline,
                                 const GiStats& now, const Settings& settings) {
  if (parameter == "frame_time") return frameTimeCost(timeline);
  if (parameter == "map_memory") return mapMemoryCost(now);
  if (parameter == "visibility_memory") return visibilityMemoryCost(now);
  if (parameter == "light_map_memory") return lightMapMemoryCost(now);
  if (parameter == "prt_memory") return transferMemoryCost(now);
  if (parameter == "samples_per_pixel")
    return BudgetCost{fmt::format("{} so far", now.samplesPerPixel),
                      "More: less noise in the settled picture; four times as many halve it."};
  for (const Budget& budget : budgets())
    if (parameter == budget.parameter)
      return BudgetCost{measured(budget, timeline, settings), budget.buys};
  return std::nullopt;
}

}  // namespace lamplighter
