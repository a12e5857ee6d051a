#include "renderer/path_repair/path_repair.h"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/methods/path_tracer/seen_light.h"
#include "renderer/path_repair/known_surfaces.h"

namespace lamplighter {
namespace {

// Seeds of the halves, different from those of pictures of the method `reference`.
constexpr uint32_t kRepairSet = 0x4e9a1;
uint32_t seedOfHalf(uint32_t seed, uint32_t half) { return hash4(seed, half, 0, kRepairSet); }

// The first paths of a pixel do not end at known light, so that they can be traced before it
// exists.
constexpr int kWholePaths = 16;
// Relative error above which a preview is traced.
constexpr float kLeastError = 0.05f;
// One in this number of paths that end at known light is continued, to find the error of that
// light.
constexpr int kPathsAWhole = 4;
// Russian roulette of all paths begins at this bounce.
constexpr int kSureBounces = 2;

// Number of rows of a filter step that count as one row of paths. On average 60 to 90 take as long;
// some steps are slower.
constexpr int kFilterRows = 48;
// The filter and the sums need about 700 bytes per pixel: larger pictures are not repaired.
constexpr size_t kMostPixels = size_t{4} << 20;

// Whether the picture is filtered at this number of paths: each time at half as many more than the
// last time. The few paths of a preview take little longer than the filter, so it shows 2, 4, 8, 12
// and 16.
bool isShown(int paths, int last, int all, bool isPreview) {
  const int next = isPreview ? std::min(2 * last, last + 4) : (3 * last + 1) / 2;
  return paths % 2 == 0 && (paths >= all || paths >= next);
}

// Whether a preview is shown after this number of the pixels of each block.
bool isShownCoarsely(int traced, int all) {
  return 2 * traced <= all && (traced == 1 || traced == 4 || traced == 8);
}

}  // namespace

bool PathRepair::isDone(const Options& options) const {
  const int all = options.isPreview ? std::min(options.paths, kWholePaths) : options.paths;
  return hasNoPixels() || (paths() >= all && !filter_);
}

void PathRepair::begin(const FrameInputs& in, const Options& options) {
  restart();
  view_ = in.view;
  path_ = options.path;
  const auto pixels = static_cast<size_t>(in.view.width) * static_cast<size_t>(in.view.height);
  if (pixels > kMostPixels) return;
  in.backend.renderGBuffer(in.view, vec2(0.0f));
  guides_ = RepairGuides(in.backend.hostGBuffer(), in.view, in.lightOnly);
  lights_ = LightSet::forPaths(in.scene);
  whole_ = PathSums(in.view.width, in.view.height);
  for (auto& half : hasLightAlone_) half.assign(pixels, 0);
  const int side = CoarsePreview::sideOf(in.view.width, in.view.height);
  if (side > 1 && options.isPreview) coarse_ = std::make_unique<CoarsePreview>(guides_, side);
}

int PathRepair::goOn(const FrameInputs& in, const Options& options,
                     const std::shared_ptr<RadianceImage>& live, const MirroredLight* surfaces,
                     int most) {
  const bool endsAtSurfaces = surfaces != nullptr;
  const bool hasMoreWhole = !endsAtSurfaces_ && whole_.paths + (row_ > 0 ? 1 : 0) > kWholePaths;
  const bool isSame = in.changes.none() && live_ && in.view == view_ && options.path == path_ &&
                      paths() <= options.paths && !(endsAtSurfaces && hasMoreWhole);
  if (!isSame) begin(in, options);
  if (live != live_ || options.isPreview != isPreview_ || endsAtSurfaces != endsAtSurfaces_)
    takePicture(live, options.isPreview, endsAtSurfaces);
  int done = 0;
  while (done < most && !isDone(options)) done += advance(in, options, surfaces, most - done);
  return done;
}

int PathRepair::advance(const FrameInputs& in, const Options& options,
                        const MirroredLight* surfaces, int most) {
  if (filter_) return filter(most);
  if (!coarse_) return tracePaths(in, options, surfaces, most);
  return coarse_->isFiltering() ? filterBlocks(most) : traceBlocks(in, options, most);
}

// A preview that is being computed is finished first. A settled picture is repaired at once, by the
// paths that do not depend on it.
void PathRepair::takePicture(const std::shared_ptr<RadianceImage>& live, bool isPreview,
                             bool endsAtSurfaces) {
  const bool isOther = isPreview != isPreview_ || endsAtSurfaces != endsAtSurfaces_;
  if (isPreview && !isOther && filter_) return;
  if (endsAtSurfaces_ && whole_.paths >= kWholePaths) row_ = 0;
  live_ = live;
  isPreview_ = isPreview;
  endsAtSurfaces_ = endsAtSurfaces;
  ended_ = missing_ = {};
  dropFilter();
  if (coarse_ && !isPreview) {
    coarse_->dropFilter();
    repaired_ = nullptr;
  }
  if (hasNoPixels()) return;
  if (endsAtSurfaces) ended_ = missing_ = PathSums(view_.width, view_.height);
  if (isPreview && whole_.paths < kWholePaths) return;
  shown_ = 0;
  if (row_ == 0 && whole_.paths > 0 && whole_.paths % 2 == 0) beginFilter();
}

// Where the sky or a lamp is visible, rays find its share of the pixel, and paths compute the rest.
// Not repeated where the first rays hit nothing else.
bool PathRepair::hasSeenLight(int x, int y, size_t half, uint32_t sample) const {
  const auto i = static_cast<size_t>(y * view_.width + x);
  return guides_.isAtLight(x, y) && (sample == 0 || hasLightAlone_[half][i] == 0);
}

// Options of a path, and the light that rays found in its pixel before.
struct PathRepair::Start {
  PathTracerOptions path;
  SeenLight seen{.surfaces = 1.0f};
  bool hasPath() const { return seen.surfaces > 0.0f; }
};

PathRepair::Start PathRepair::startAt(const Tracing& in, int x, int y, size_t half, uint32_t sample,
                                      uint64_t& rays) {
  Start start{.path = path_};
  start.path.seed = seedOfHalf(path_.seed, static_cast<uint32_t>(half));
  start.path.sureBounces = kSureBounces;
  start.path.seesLights = !hasSeenLight(x, y, half, sample);
  if (start.path.seesLights) return start;
  start.seen = seenLight(in.scene, in.caster, lights_, view_, x, y, sample, start.path.seed);
  start.path.inPixel = start.seen.onSurface;
  rays += kSeenRays;
  if (sample == 0)
    hasLightAlone_[half][static_cast<size_t>(y * view_.width + x)] =
        !start.seen.isMixed && !guides_.isAtBorder(x, y);
  return start;
}

vec3 PathRepair::wholePath(const Tracing& in, int x, int y, size_t half, uint32_t sample,
                           uint64_t& rays) {
  const Start start = startAt(in, x, y, half, sample, rays);
  if (!start.hasPath()) return start.seen.radiance;
  return start.seen.radiance + start.seen.surfaces * tracePath(in.scene, in.caster, lights_, view_,
                                                               x, y, sample, start.path, &rays);
}

// Traces the first path of each half: of one pixel of all blocks, then of the next one. Returns the
// work in rows of paths.
int PathRepair::traceBlocks(const FrameInputs& in, const Options& options, int most) {
  const Tracing tracing{in.scene, in.services.rays()};
  const int side = coarse_->side();
  const RepairGuides& blocks = coarse_->blocks();
  const glm::ivec2 pixel = coarse_->nextPixel();
  const int end = std::min(row_ + most * side / 2, blocks.height);
  std::atomic<uint64_t> rays = 0;
  tbb::parallel_for(row_, end, [&](int y) {
    uint64_t traced = 0;
    for (int x = 0; x < blocks.width; ++x) {
      const int u = side * x + pixel.x, v = side * y + pixel.y;
      const bool isInside = u < view_.width && v < view_.height;
      const bool isUsed = !blocks.isAtLight(x, y);
      if (!isInside && !isUsed) continue;
      const auto block = static_cast<size_t>(y * blocks.width + x);
      // In place of a pixel outside the picture, the nearest one inside gets another path.
      const auto sample = static_cast<uint32_t>(isInside ? 0 : coarse_->traced());
      for (size_t half = 0; half < 2; ++half) {
        const vec3 radiance = wholePath(tracing, std::min(u, view_.width - 1),
                                        std::min(v, view_.height - 1), half, sample, traced);
        if (isInside) whole_.add(half == 0, static_cast<size_t>(v * view_.width + u), radiance);
        if (isUsed) coarse_->add(half == 0, block, radiance);
      }
    }
    rays += traced;
  });
  rays_ += rays;
  const int work = (2 * (end - std::exchange(row_, end)) + side - 1) / side;
  if (row_ < blocks.height) return work;
  row_ = 0;
  coarse_->endPaths();
  if (coarse_->traced() == side * side) {
    coarse_.reset();
    whole_.endPath();
    whole_.endPath();
    if (isShown(paths(), shown_, options.paths, options.isPreview)) beginFilter();
  } else if (options.isPreview && isShownCoarsely(coarse_->traced(), side * side)) {
    coarse_->beginFilter(live_);
  }
  return work;
}

int PathRepair::filterBlocks(int most) {
  const int side = coarse_->side();
  const int rows = coarse_->filter(kFilterRows * side * most);
  if (!coarse_->isFiltering()) repaired_ = coarse_->image();
  return (rows + kFilterRows * side - 1) / (kFilterRows * side);
}

int PathRepair::tracePaths(const FrameInputs& in, const Options& options,
                           const MirroredLight* surfaces, int most) {
  const View& view = in.view;
  const int end = std::min(row_ + most, view.height);
  const bool isFirst = paths() % 2 == 0;
  const size_t half = isFirst ? 0 : 1;
  const auto sample = static_cast<uint32_t>(paths() / 2);
  const bool ends = surfaces != nullptr && whole_.paths >= kWholePaths;
  const bool goesOn = ends && sample % kPathsAWhole == 0;
  const Tracing tracing{in.scene, in.services.rays()};
  std::optional<KnownSurfaces> known;
  if (ends) known.emplace(*surfaces);
  std::atomic<uint64_t> rays = 0;
  tbb::parallel_for(row_, end, [&](int y) {
    uint64_t traced = 0;
    for (int x = 0; x < view.width; ++x) {
      const auto i = static_cast<size_t>(y * view.width + x);
      if (!known) {
        whole_.add(isFirst, i, wholePath(tracing, x, y, half, sample, traced));
        continue;
      }
      const Start start = startAt(tracing, x, y, half, sample, traced);
      const EndedPath rest = start.hasPath()
                                 ? traceEndedPath(in.scene, tracing.caster, lights_, view, x, y,
                                                  sample, start.path, *known, goesOn, &traced)
                                 : EndedPath();
      ended_.add(isFirst, i, start.seen.radiance + start.seen.surfaces * rest.radiance);
      if (goesOn) missing_.add(isFirst, i, start.seen.surfaces * rest.missing);
    }
    rays += traced;
  });
  rays_ += rays;
  const int rows = end - std::exchange(row_, end);
  if (row_ < view.height) return rows;
  row_ = 0;
  (ends ? ended_ : whole_).endPath();
  if (goesOn) missing_.endPath();
  if (isShown(paths(), shown_, options.paths, options.isPreview)) beginFilter();
  return rows;
}

// The error of known light is estimated first and subtracted from the complete paths: then these
// estimate the same value as paths that end at known light.
void PathRepair::beginFilter() {
  if (ended_.paths > 0 && !lacking_) {
    filter_ = std::make_unique<ResidualFilter>(guides_, live_->pixels(), missing_,
                                               ResidualFilter::Estimate::residual);
    return;
  }
  if (lacking_) {
    // Weighted by their noise: paths that end at known light may have far less.
    const double noise = whole_.noise();
    all_ = whole_;
    all_.subtract(*lacking_);
    if (noise > 0.0) all_.scale(static_cast<float>(std::min(ended_.noise() / noise, 1.0)));
    all_.add(ended_);
  }
  filter_ = std::make_unique<ResidualFilter>(guides_, live_->pixels(), lacking_ ? all_ : whole_);
}

void PathRepair::dropFilter() {
  filter_.reset();
  lacking_.reset();
  all_ = {};
}

// Returns the work in rows of paths.
int PathRepair::filter(int most) {
  const int rows = filter_->step(kFilterRows * most);
  const int work = (rows + kFilterRows - 1) / kFilterRows;
  if (!filter_->isDone()) return work;
  Image residual = filter_->takeResidual();
  if (ended_.paths == 0) isWrong_ = filter_->error() > kLeastError;
  if (ended_.paths > 0 && !lacking_) {
    lacking_ = std::move(residual);
    beginFilter();
    return work;
  }
  if (lacking_)
    for (size_t i = 0; i < residual.pixels.size(); ++i) residual.pixels[i] += lacking_->pixels[i];
  dropFilter();
  show(residual);
  return work;
}

void PathRepair::show(const Image& residual) {
  Image out = live_->pixels();
  for (size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = glm::max(out.pixels[i] + residual.pixels[i], vec3(0.0f));
  repaired_ = std::make_shared<HostImage>(std::move(out));
  shown_ = paths();
  mostShown_ = std::max(mostShown_, shown_);
}

}  // namespace lamplighter
