#include "editor/latency/latency_report.h"

#include <algorithm>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace lamplighter {
namespace {

nlohmann::ordered_json momentJson(const LatencyResult::Moment& moment) {
  return {{"frames", moment.frames}, {"milliseconds", moment.milliseconds}};
}

}  // namespace

std::string latencySummary(const EditLatency& latency) {
  std::vector<int> frames;  // to 95%
  for (const LatencyResult& r : latency.results())
    if (r.visible) frames.push_back(r.within[1].frames);
  if (frames.empty()) return "";
  std::sort(frames.begin(), frames.end());
  return fmt::format("{} edit{} seen: 95% in {} frame{} (median), {} at most", frames.size(),
                     frames.size() == 1 ? "" : "s", frames[frames.size() / 2],
                     frames[frames.size() / 2] == 1 ? "" : "s", frames.back());
}

nlohmann::ordered_json latencyJson(const EditLatency& latency) {
  nlohmann::ordered_json edits = nlohmann::ordered_json::array();
  for (const LatencyResult& r : latency.results()) {
    nlohmann::ordered_json edit{{"edit", r.what}, {"visible", r.visible}};
    for (size_t i = 0; r.visible && i < kLatencyPercents.size(); ++i)
      edit[fmt::format("within_{}", kLatencyPercents[i])] = momentJson(r.within[i]);
    edit["settled"] = momentJson(r.settled);
    edits.push_back(std::move(edit));
  }
  return edits;
}

}  // namespace lamplighter
