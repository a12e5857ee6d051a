#include "editor/latency/edit_latency.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace lamplighter {
namespace {

// Copies are averaged down to at most this number of pixels per side. Changes at edges from frame
// to frame then do not count, and a thousand copies stay small.
constexpr int kSide = 80;
// The maximum number of copies; then every second copy is dropped. 256 copies of 80 x 45 pixels
// take 11 MB.
constexpr size_t kMostSeen = 256;
constexpr size_t kMostResults = 1000;
// Relative difference below which two pictures look the same.
constexpr double kInvisible = 1e-4;

std::shared_ptr<RadianceImage> smallCopy(RadianceImage& picture) {
  const int block = (std::max(picture.width(), picture.height()) + kSide - 1) / kSide;
  return picture.averaged(block);
}

double distance(const Image& a, const Image& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
    sum += glm::dot(d, d);
  }
  return std::sqrt(sum);
}

double length(const Image& a) { return distance(a, Image(a.width, a.height)); }

}  // namespace

std::string latencyText(const LatencyResult& result, bool milliseconds) {
  const auto moment = [&](const LatencyResult::Moment& m) {
    std::string text = std::to_string(m.frames);
    if (milliseconds) text += fmt::format(" ({:.0f} ms)", m.milliseconds);
    return text;
  };
  std::string text;
  if (!result.visible) {
    text = "not seen, ";
  } else {
    for (size_t i = 0; i < kLatencyPercents.size(); ++i)
      text += fmt::format("{}% in {}, ", kLatencyPercents[i], moment(result.within[i]));
  }
  return text + fmt::format("settled in {} frame{}", moment(result.settled),
                            result.settled.frames == 1 ? "" : "s");
}

void EditLatency::frame(const Frame& frame) {
  const bool sameView = frame.view == lastView_;
  const std::shared_ptr<RadianceImage> last = std::exchange(last_, frame.picture);
  lastView_ = frame.view;
  if (!frame.edited && !running_) return;
  if (frame.edited) {
    running_ = sameView && last && last->width() == frame.picture->width() &&
               last->height() == frame.picture->height();
    if (!running_) return;
    what_ = frame.what;
    begin_ = frame.begin;
    frames_ = 0;
    stride_ = 1;
    // If the previous edit was still measured, its copy of the last frame is used.
    before_ = smallCopy(*last);
    seen_.clear();
  } else if (!sameView) {
    running_ = false;
    seen_.clear();
    return;
  }
  ++frames_;
  if (frame.settled || frames_ % stride_ == 0) {
    if (seen_.size() >= kMostSeen) thinOut();
    seen_.push_back({frames_, frame.end, smallCopy(*frame.picture)});
  }
  if (frame.settled) finish();
}

void EditLatency::thinOut() {
  stride_ *= 2;
  std::erase_if(seen_, [&](const Seen& s) { return s.frame % stride_ != 0; });
}

void EditLatency::finish() {
  const Image& settled = seen_.back().picture->pixels();
  const double start = distance(before_->pixels(), settled);
  const auto moment = [&](const Seen& s) {
    return LatencyResult::Moment{s.frame, 1e3 * (s.end - begin_)};
  };
  LatencyResult result;
  result.what = what_;
  result.visible = start > kInvisible * length(settled);
  result.settled = moment(seen_.back());
  for (size_t i = 0; i < kLatencyPercents.size(); ++i) {
    const double most = start * (1.0 - kLatencyPercents[i] / 100.0);
    // Searches backwards from the end while the pictures are close enough: only a permanent
    // approach counts.
    size_t first = seen_.size() - 1;
    while (first > 0 && distance(seen_[first - 1].picture->pixels(), settled) <= most) --first;
    result.within[i] = moment(seen_[first]);
  }
  results_.push_back(std::move(result));
  if (results_.size() > kMostResults) results_.pop_front();
  ++measured_;
  running_ = false;
  seen_.clear();
}

}  // namespace lamplighter
