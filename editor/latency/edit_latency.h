// Measures the time from an edit until the picture is close to the settled picture. The settled
// picture is known only at the end, so small copies of all pictures since the edit are kept until
// then; on the gl backend only then are they read back.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "renderer/backends/radiance_image.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// An edit whose picture settled before the next change.
struct LatencyResult {
  struct Moment {
    int frames = 0;             // frames rendered since the edit; 1: the first frame that shows it
    double milliseconds = 0.0;  // from the edit to the end of that frame; 0 without a clock
  };
  std::string what;     // the edit, as named in the history
  bool visible = true;  // false: the edit has no visible effect, and `within` has no meaning
  // When the distance to the settled picture fell permanently below 50, 5 and 1% of the distance
  // before the edit. The picture is then within 50, 95 and 99% of the settled picture.
  std::array<Moment, 3> within;
  Moment settled;
};

inline constexpr std::array<int, 3> kLatencyPercents = {50, 95, 99};

// "50% in 1, 95% in 3, 99% in 7 frames", with milliseconds if they are known and requested.
std::string latencyText(const LatencyResult& result, bool milliseconds);

class EditLatency {
 public:
  struct Frame {
    bool edited = false;  // this frame is the first to show an edit
    std::string what;     // the edit, if any
    bool settled = false;
    const View& view;
    std::shared_ptr<RadianceImage> picture;
    double begin = 0.0, end = 0.0;  // seconds of the caller's clock
  };
  // Call after each frame. A new edit before the picture has settled replaces the last one. If the
  // camera moves in between, the pictures cannot be compared and the measurement is cancelled.
  void frame(const Frame& frame);

  bool running() const { return running_; }
  // Newest last. The number of kept results is limited.
  const std::deque<LatencyResult>& results() const { return results_; }
  size_t measured() const { return measured_; }  // since the session began

 private:
  struct Seen {
    int frame;
    double end;
    std::shared_ptr<RadianceImage> picture;
  };
  void finish();
  void thinOut();

  bool running_ = false;
  std::string what_;
  View view_;
  double begin_ = 0.0;
  int frames_ = 0, stride_ = 1;
  std::shared_ptr<RadianceImage> before_;
  std::vector<Seen> seen_;
  std::shared_ptr<RadianceImage> last_;  // picture of the previous frame
  View lastView_;
  std::deque<LatencyResult> results_;
  size_t measured_ = 0;
};

}  // namespace lamplighter
