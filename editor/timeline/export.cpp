#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "editor/document/file_kinds.h"
#include "editor/document/write_file.h"
#include "editor/timeline/timeline.h"
#include "renderer/base/error.h"

namespace lamplighter {
namespace {

using Json = nlohmann::ordered_json;

double microseconds(double seconds) { return 1e6 * seconds; }

uint64_t countOf(const FrameTiming& frame, const StatisticSpec& counter) {
  return static_cast<uint64_t>(frame.stats.find(counter.name).value_or(0.0));
}

// A complete event ("X") of the Trace Event Format.
Json span(std::string_view name, double begin, double seconds) {
  return {{"name", name},
          {"ph", "X"},
          {"pid", 1},
          {"tid", 1},
          {"ts", microseconds(begin)},
          {"dur", microseconds(seconds)}};
}

}  // namespace

std::string chromeTrace(const Timeline& timeline) {
  Json events = Json::array();
  const auto counters = timeline.counters();
  const double origin = timeline.frames().empty() ? 0.0 : timeline.frames().front().begin;
  for (const FrameTiming& f : timeline.frames()) {
    Json frame = span("frame", f.begin - origin, f.seconds());
    frame["args"] = {{"frame", f.frame}};
    events.push_back(std::move(frame));
    double at = f.begin - origin;
    for (const auto& [stage, seconds] : f.stats.stageSeconds) {
      if (seconds <= 0.0) continue;
      events.push_back(span(stage.name, at, seconds));
      at += seconds;
    }
    for (const StatisticSpec* counter : counters)
      events.push_back({{"name", counter->name},
                        {"ph", "C"},
                        {"pid", 1},
                        {"ts", microseconds(f.begin - origin)},
                        {"args", {{"count", countOf(f, *counter)}}}});
  }
  return Json{{"displayTimeUnit", "ms"}, {"traceEvents", events}}.dump() + '\n';
}

std::string timelineCsv(const Timeline& timeline) {
  std::string text = "frame,begin_s,frame_ms";
  const auto column = [](std::string_view name) {
    std::string out(name);
    for (char& c : out)
      if (c == ' ' || c == '-') c = '_';
    return out;
  };
  const std::vector<StageSpec> stages = timeline.stages();
  for (const StageSpec& stage : stages) text += "," + column(stage.name) + "_ms";
  const auto counters = timeline.counters();
  for (const StatisticSpec* counter : counters) text += "," + counter->name;
  text += '\n';
  const double origin = timeline.frames().empty() ? 0.0 : timeline.frames().front().begin;
  for (const FrameTiming& f : timeline.frames()) {
    text += fmt::format("{},{:.6f},{:.4f}", f.frame, f.begin - origin, 1e3 * f.seconds());
    for (const StageSpec& stage : stages)
      text += fmt::format(",{:.4f}", 1e3 * f.stats.secondsOf(stage));
    for (const StatisticSpec* counter : counters) text += fmt::format(",{}", countOf(f, *counter));
    text += '\n';
  }
  return text;
}

void exportTimeline(const Timeline& timeline, const std::filesystem::path& path) {
  if (!hasExtension(path, kTimelineExtensions))
    throw InputError(path.string(), "is neither a Chrome trace nor a table",
                     "give a name that ends in .json or .csv");
  if (timeline.frames().empty())
    throw InputError("timeline", "no frame was timed yet", "render some first");
  const bool isTable = lowerCase(path.extension().string()) == ".csv";
  writeFile(path, isTable ? timelineCsv(timeline) : chromeTrace(timeline));
}

}  // namespace lamplighter
