#include "renderer/path_repair/path_repair.h"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

// Seeds of the halves, other than those of pictures of the method `reference`.
constexpr uint32_t kRepairSet = 0x4e9a1;
uint32_t seedOfHalf(uint32_t seed, uint32_t half) { return hash4(seed, half, 0, kRepairSet); }

// A step of the filter takes about as long as the paths of this share of the rows.
constexpr int kStepShare = 16;
// The memory of the filter is some 250 bytes a pixel: larger pictures are not repaired.
constexpr size_t kMostPixels = size_t{4} << 20;

// Whether the picture after so many paths is filtered: always half as many more than the last.
bool isShown(int paths, int last, int all) {
  return paths % 2 == 0 && (paths >= all || 2 * paths >= 3 * last);
}

}  // namespace

bool PathRepair::isDone(const Options& options) const {
  return first_.empty() || (paths_ >= options.paths && !filter_);
}

void PathRepair::begin(const FrameInputs& in, const Options& options,
                       const std::shared_ptr<RadianceImage>& live) {
  restart();
  live_ = live;
  view_ = in.view;
  path_ = options.path;
  if (static_cast<size_t>(live->width()) * static_cast<size_t>(live->height()) > kMostPixels)
    return;
  in.backend.renderGBuffer(in.view, vec2(0.0f));
  guides_ = RepairGuides(in.backend.hostGBuffer(), in.view, in.lightOnly);
  lights_ = LightSet(in.scene);
  first_ = second_ = Image(in.view.width, in.view.height);
}

int PathRepair::goOn(const FrameInputs& in, const Options& options,
                     const std::shared_ptr<RadianceImage>& live, int most) {
  const bool isOther = !in.changes.none() || live != live_ || in.view != view_ ||
                       options.path != path_ || paths_ > options.paths;
  if (isOther) begin(in, options, live);
  int done = 0;
  while (done < most && !isDone(options))
    done += filter_ ? filter() : tracePaths(in, options, most - done);
  return done;
}

int PathRepair::tracePaths(const FrameInputs& in, const Options& options, int most) {
  const View& view = in.view;
  const int end = std::min(row_ + most, view.height);
  PathTracerOptions path = options.path;
  const bool isFirst = paths_ % 2 == 0;
  path.seed = seedOfHalf(path.seed, isFirst ? 0 : 1);
  Image& sums = isFirst ? first_ : second_;
  const auto sample = static_cast<uint32_t>(paths_ / 2);
  const RayCaster& caster = in.services.rays();
  std::atomic<uint64_t> rays = 0;
  tbb::parallel_for(row_, end, [&](int y) {
    uint64_t traced = 0;
    for (int x = 0; x < view.width; ++x)
      sums.at(x, y) += tracePath(in.scene, caster, lights_, view, x, y, sample, path, &traced);
    rays += traced;
  });
  rays_ += rays;
  const int rows = end - std::exchange(row_, end);
  if (row_ < view.height) return rows;
  row_ = 0;
  ++paths_;
  if (isShown(paths_, shown_, options.paths))
    filter_ = std::make_unique<ResidualFilter>(guides_, live_->pixels(), first_, second_, paths_);
  return rows;
}

int PathRepair::filter() {
  filter_->step();
  if (filter_->isDone()) {
    const Image& live = live_->pixels();
    Image out = filter_->takeResidual();
    for (size_t i = 0; i < out.pixels.size(); ++i)
      out.pixels[i] = glm::max(live.pixels[i] + out.pixels[i], vec3(0.0f));
    repaired_ = std::make_shared<HostImage>(std::move(out));
    shown_ = paths_;
    filter_.reset();
  }
  return std::max(guides_.height / kStepShare, 1);
}

}  // namespace lamplighter
