// How long it takes from an edit until the picture is as good as settled. As the settled picture is
// known only in the end, small copies of the pictures since the edit are kept until then.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "renderer/backends/kernels.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// One edit whose picture has settled before anything else was changed.
struct LatencyResult {
  struct Moment {
    int frames = 0;             // rendered since the edit; 1: the first that shows it
    double milliseconds = 0.0;  // from the edit until that frame was done; 0 without a clock
  };
  std::string what;     // the edit, as the history calls it
  bool visible = true;  // false: it changes nothing that is seen, and the shares mean nothing
  // When the distance to the settled picture was down, for good, to 50, 5 and 1% of what it was
  // before the edit: within 50, 95 and 99% of the settled picture.
  std::array<Moment, 3> within;
  Moment settled;
};

inline constexpr std::array<int, 3> kLatencyPercents = {50, 95, 99};

// "50% in 1, 95% in 3, 99% in 7 frames", with milliseconds where they are known and wanted.
std::string latencyText(const LatencyResult& result, bool milliseconds);

class EditLatency {
 public:
  struct Frame {
    bool edited = false;  // something was changed that this frame is the first to show
    std::string what;     // what, if so
    bool settled = false;
    const View& view;
    std::shared_ptr<RadianceImage> picture;
    double begin = 0.0, end = 0.0;  // seconds by the caller's clock
  };
  // After each frame. An edit before the last one's picture has settled takes its place; where the
  // camera moves in between, pictures cannot be compared and the measurement is given up.
  void frame(const Frame& frame);

  bool running() const { return running_; }
  int framesSoFar() const { return frames_; }
  // The newest last; of those before only so many are kept.
  const std::deque<LatencyResult>& results() const { return results_; }
  size_t measured() const { return measured_; }  // since the session began

 private:
  struct Seen {
    int frame;
    double end;
    Image picture;
  };
  void finish();
  void thinOut();

  bool running_ = false;
  std::string what_;
  View view_;
  double begin_ = 0.0;
  int frames_ = 0, stride_ = 1;
  Image before_;
  std::vector<Seen> seen_;
  std::shared_ptr<RadianceImage> last_;  // the frame before
  View lastView_;
  std::deque<LatencyResult> results_;
  size_t measured_ = 0;
};

}  // namespace lamplighter
