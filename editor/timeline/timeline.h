// The time that each recent frame spent in each stage, for the panel and for files.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

// The rest of a frame, after the stages of the method.
inline constexpr StageSpec kOtherStage{
    "other", "Other", "The rest of the frame: updating the scene, drawing, measuring."};

struct FrameTiming {
  uint32_t frame = 0;             // number of the frame in the session
  double begin = 0.0, end = 0.0;  // seconds of the caller's clock
  GiStats stats;                  // its stages are those of the method, then kOtherStage
  double seconds() const { return end - begin; }
};

class Timeline {
 public:
  // Call after each frame. A frame without duration (no clock) is ignored.
  void add(uint32_t frame, double begin, double end, const GiStats& stats);
  void clear() { frames_.clear(); }

  // Oldest first: the last ten seconds, at most 2000 frames.
  const std::deque<FrameTiming>& frames() const { return frames_; }
  // The stages of all kept frames, in declared order, kOtherStage last. A frame without one of them
  // spent no time in it.
  std::vector<StageSpec> stages() const;
  // The counters of all kept frames, in declared order. A frame without one of them did none of its
  // work.
  std::vector<const StatisticSpec*> counters() const;
  // Mean seconds of a stage over the kept frames in which it took time.
  double meanOf(const StageSpec& stage) const;

 private:
  std::deque<FrameTiming> frames_;
};

// The frames as Chrome trace events, for chrome://tracing and Perfetto. Stages follow one another
// from the start of the frame. A stage that runs twice is one event.
std::string chromeTrace(const Timeline& timeline);
// One row per frame: number, begin [s], whole [ms], each stage [ms], each counter.
std::string timelineCsv(const Timeline& timeline);
// Writes one of these formats, chosen by the file extension. Throws InputError.
void exportTimeline(const Timeline& timeline, const std::filesystem::path& path);

}  // namespace lamplighter
