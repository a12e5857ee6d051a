#include "renderer/path_repair/path_repair.h"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/path_repair/known_surfaces.h"

namespace lamplighter {
namespace {

// Seeds of the halves, other than those of pictures of the method `reference`.
constexpr uint32_t kRepairSet = 0x4e9a1;
uint32_t seedOfHalf(uint32_t seed, uint32_t half) { return hash4(seed, half, 0, kRepairSet); }

// Of so many paths that end at known light one goes on, to find what that light lacks.
constexpr int kPathsAWhole = 4;
// Russian roulette of all paths begins at this bounce.
constexpr int kSureBounces = 2;

// So many rows of a step of the filter count as a row of paths. On average 60 to 90 take as long;
// some steps are slower.
constexpr int kFilterRows = 32;
// The memory of the filter is some 300 bytes a pixel: larger pictures are not repaired.
constexpr size_t kMostPixels = size_t{4} << 20;

// Whether the picture after so many paths is filtered: always half as many more than the last.
bool isShown(int paths, int last, int all) {
  return paths % 2 == 0 && (paths >= all || 2 * paths >= 3 * last);
}

}  // namespace

bool PathRepair::isDone(const Options& options) const {
  return seen_.first.empty() || (paths_ >= options.paths && !filter_);
}

void PathRepair::begin(const FrameInputs& in, const Options& options,
                       const std::shared_ptr<RadianceImage>& live, bool endsAtSurfaces) {
  restart();
  live_ = live;
  endsAtSurfaces_ = endsAtSurfaces;
  view_ = in.view;
  path_ = options.path;
  if (static_cast<size_t>(live->width()) * static_cast<size_t>(live->height()) > kMostPixels)
    return;
  in.backend.renderGBuffer(in.view, vec2(0.0f));
  guides_ = RepairGuides(in.backend.hostGBuffer(), in.view, in.lightOnly);
  lights_ = LightSet::forPaths(in.scene);
  seen_ = PathSums(in.view.width, in.view.height);
  if (endsAtSurfaces) missing_ = seen_;
}

int PathRepair::goOn(const FrameInputs& in, const Options& options,
                     const std::shared_ptr<RadianceImage>& live, const MirroredLight* surfaces,
                     int most) {
  const bool isOther = !in.changes.none() || live != live_ || in.view != view_ ||
                       options.path != path_ || paths_ > options.paths ||
                       (surfaces != nullptr) != endsAtSurfaces_;
  if (isOther) begin(in, options, live, surfaces != nullptr);
  int done = 0;
  while (done < most && !isDone(options))
    done += filter_ ? filter(most - done) : tracePaths(in, options, surfaces, most - done);
  return done;
}

int PathRepair::tracePaths(const FrameInputs& in, const Options& options,
                           const MirroredLight* surfaces, int most) {
  const View& view = in.view;
  const int end = std::min(row_ + most, view.height);
  PathTracerOptions path = options.path;
  const bool isFirst = paths_ % 2 == 0;
  path.seed = seedOfHalf(path.seed, isFirst ? 0 : 1);
  path.sureBounces = kSureBounces;
  const auto sample = static_cast<uint32_t>(paths_ / 2);
  const bool isWhole = surfaces != nullptr && sample % kPathsAWhole == 0;
  const RayCaster& caster = in.services.rays();
  const std::optional<KnownSurfaces> known =
      surfaces != nullptr ? std::optional<KnownSurfaces>(*surfaces) : std::nullopt;
  std::atomic<uint64_t> rays = 0;
  tbb::parallel_for(row_, end, [&](int y) {
    uint64_t traced = 0;
    for (int x = 0; x < view.width; ++x) {
      const auto i = static_cast<size_t>(y * view.width + x);
      const EndedPath p =
          known ? traceEndedPath(in.scene, caster, lights_, view, x, y, sample, path, *known,
                                 isWhole, &traced)
                : EndedPath{tracePath(in.scene, caster, lights_, view, x, y, sample, path, &traced),
                            vec3(0.0f)};
      seen_.add(isFirst, i, p.radiance);
      if (isWhole) missing_.add(isFirst, i, p.missing);
    }
    rays += traced;
  });
  rays_ += rays;
  const int rows = end - std::exchange(row_, end);
  if (row_ < view.height) return rows;
  row_ = 0;
  ++paths_;
  seen_.endPath();
  if (isWhole) missing_.endPath();
  if (isShown(paths_, shown_, options.paths))
    filter_ = std::make_unique<ResidualFilter>(guides_, live_->pixels(), seen_);
  return rows;
}

// Returns the work in rows of paths.
int PathRepair::filter(int most) {
  const int rows = filter_->step(kFilterRows * most);
  const int work = (rows + kFilterRows - 1) / kFilterRows;
  if (!filter_->isDone()) return work;
  Image residual = filter_->takeResidual();
  filter_.reset();
  if (endsAtSurfaces_ && !residual_) {
    residual_ = std::move(residual);
    filter_ = std::make_unique<ResidualFilter>(guides_, live_->pixels(), missing_,
                                               ResidualFilter::Estimate::residual);
    return work;
  }
  if (residual_)
    for (size_t i = 0; i < residual.pixels.size(); ++i) residual.pixels[i] += residual_->pixels[i];
  residual_.reset();
  show(residual);
  return work;
}

void PathRepair::show(const Image& residual) {
  Image out = live_->pixels();
  for (size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = glm::max(out.pixels[i] + residual.pixels[i], vec3(0.0f));
  repaired_ = std::make_shared<HostImage>(std::move(out));
  shown_ = paths_;
}

}  // namespace lamplighter
