// What each of the last frames was spent on, for the panel and for files.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

struct FrameTiming {
  uint32_t frame = 0;                // its number in the session
  double begin = 0.0, end = 0.0;     // seconds by the caller's clock
  std::vector<double> stageSeconds;  // by Timeline::stages(); shorter: the rest took none
  GiStats stats;                     // without its times, which are above
  double seconds() const { return end - begin; }
};

class Timeline {
 public:
  // After each frame. One that took no time (no clock) is not kept.
  void add(uint32_t frame, double begin, double end, const GiStats& stats);
  void clear() { frames_.clear(); }

  // The oldest first: those of the last ten seconds, and no more than 2000.
  const std::deque<FrameTiming>& frames() const { return frames_; }
  // In the order in which a frame goes through them; the last one, "other", is what lies between.
  static const std::vector<std::string>& stages();
  // Mean seconds of a stage over the frames that are kept in which it took any.
  double meanOf(size_t stage) const;

 private:
  std::deque<FrameTiming> frames_;
};

struct Counter {
  const char* name;  // as in files: "maps_rendered"
  const char* label;
  uint64_t (*of)(const GiStats& stats);
};
// What is counted in each frame.
const std::vector<Counter>& counters();

// The frames as Chrome trace events, for chrome://tracing and Perfetto. Stages lie one after the
// other from the frame's start: a stage that is entered twice is one event.
std::string chromeTrace(const Timeline& timeline);
// A row a frame: number, begin [s], whole [ms], each stage [ms], each counter.
std::string timelineCsv(const Timeline& timeline);
// As one or the other, by the ending. Throws InputError.
void exportTimeline(const Timeline& timeline, const std::filesystem::path& path);

}  // namespace lamplighter
