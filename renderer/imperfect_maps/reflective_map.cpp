#include "renderer/imperfect_maps/reflective_map.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

bool isDark(const vec3& c) { return !(c.r > 0.0f || c.g > 0.0f || c.b > 0.0f); }

bool meets(const PathStep& s, const Bounds& box) {
  return !box.empty() && mayTouch({s.origin, 0.0f, s.direction, s.hit.t}, box);
}

bool isTouched(const LightPath& path, std::span<const MoverFinder::Mover> movers) {
  return std::ranges::any_of(path.steps, [&](const PathStep& step) {
    return std::ranges::any_of(movers, [&](const MoverFinder::Mover& m) {
      return meets(step, m.before) || meets(step, m.after);
    });
  });
}

bool startsAs(const LightPath& path, const Departure& start) {
  return !path.steps.empty() && path.steps[0].origin == start.origin &&
         path.steps[0].direction == start.direction;
}

// The cell of a number in [0, 1), of 2ᵏ.
int cellOf(float u, int cells) {
  return std::min(static_cast<int>(u * static_cast<float>(cells)), cells - 1);
}

// The power of two that is nearest to a share of the columns, at least 1.
int powerNear(double columns) {
  const double exponent = std::log2(std::max(columns, 1.0));
  return 1 << static_cast<int>(std::lround(exponent));
}

}  // namespace

bool ReflectiveMap::update(const RenderScene& scene, const RayCaster& rays,
                           const RenderSceneChanges& changes,
                           std::span<const MoverFinder::Mover> movers,
                           const ReflectiveMapOptions& options) {
  rays_ = 0;
  walked_ = 0;
  const bool isOther = !isStarted_ || options != options_;
  if (!isOther && changes.none()) return false;
  options_ = options;
  const std::vector<Block> before = std::move(blocks_);
  lights_ = LightSet(scene, isStarted_ ? lights_ : LightSet());
  counts_ = VplCounts();
  counts_.bounces = options.bounces;
  counts_.seed = options.seed;
  divide();
  const auto isSame = [](const Block& a, const Block& b) {
    return a.light == b.light && a.emitter == b.emitter && a.first == b.first &&
           a.columns == b.columns && a.bounce == b.bounce;
  };
  const bool keeps = !isOther && !changes.rebuilt && !changes.materials && !changes.objects &&
                     std::ranges::equal(before, blocks_, isSame);
  isStarted_ = true;

  const PathWalker walker(scene, rays, lights_, counts_);
  if (!keeps) {
    size_t paths = 0;
    for (const Block& block : blocks_)
      if (block.bounce == 1) paths += static_cast<size_t>(block.columns) * kRows;
    paths_.assign(paths, {});
    for (const Block& block : blocks_)
      if (block.bounce == 1) place(walker, block);
  }
  for (const Block& block : blocks_)
    if (block.bounce == 1) walk(walker, block, keeps, movers);
  const size_t size = this->size();
  for (std::vector<float>* v : {&texels_.x, &texels_.y, &texels_.z, &texels_.nx, &texels_.ny,
                                &texels_.nz, &texels_.red, &texels_.green, &texels_.blue})
    v->assign(size, 0.0f);
  pathIndex_.assign(size, 0);
  for (const Block& block : blocks_) fill(block);
  return true;
}

// Columns by flux, a power of two for each light.
void ReflectiveMap::divide() {
  blocks_.clear();
  blockOfColumn_.clear();
  columns_ = 0;
  const std::vector<Emitter>& emitters = lights_.emitters();
  std::vector<size_t> order;
  double all = 0.0;
  const auto weight = [&](size_t i) { return static_cast<double>(luminance(emitters[i].flux)); };
  for (size_t i = 0; i < emitters.size(); ++i) {
    if (!(weight(i) > 0.0)) continue;
    order.push_back(i);
    all += weight(i);
  }
  if (order.empty() || options_.bounces <= 0) return;
  std::ranges::stable_sort(order, [&](size_t a, size_t b) { return weight(a) > weight(b); });
  const int wanted = std::max(options_.texels / (options_.bounces * kRows), 1);
  order.resize(std::min<size_t>(order.size(), static_cast<size_t>(wanted)));
  double served = 0.0;
  for (const size_t i : order) served += weight(i);
  scale_ = static_cast<float>(all / served);
  std::ranges::sort(order);
  const std::vector<VplId> ids = emitterIds(lights_);
  size_t paths = 0;
  for (const size_t i : order) {
    Block& block = blocks_.emplace_back();
    block.emitter = static_cast<int>(i);
    block.light = ids[i];
    block.first = columns_;
    block.columns = powerNear(wanted * weight(i) / served);
    block.paths = paths;
    columns_ += block.columns;
    paths += static_cast<size_t>(block.columns) * kRows;
  }
  const std::vector<Block> first = blocks_;
  const int firstColumns = columns_;
  for (int bounce = 2; bounce <= options_.bounces; ++bounce) {
    for (Block block : first) {
      block.bounce = static_cast<uint32_t>(bounce);
      block.first += columns_;
      blocks_.push_back(block);
    }
    columns_ += firstColumns;
  }
  for (size_t b = 0; b < blocks_.size(); ++b)
    blockOfColumn_.insert(blockOfColumn_.end(), static_cast<size_t>(blocks_[b].columns), b);
}

void ReflectiveMap::place(const PathWalker& walker, const Block& block) {
  const Emitter& emitter = lights_.emitters()[static_cast<size_t>(block.emitter)];
  const bool isParallel =
      emitter.kind == EmitterKind::sky ||
      walker.depart({block.emitter, block.light}, 0).spread == Departure::Spread::parallel;
  const uint32_t dimension =
      isParallel ? SampleStreams::kPlaceDimension : SampleStreams::kDirectionDimension;
  const auto count = static_cast<uint32_t>(block.columns * kRows);
  for (uint32_t index = 0; index < count; ++index) {
    const vec2 u = walker.numbers().point(block.light, index, dimension, SampleStreams::indirect);
    const int column = cellOf(u.x, block.columns), row = cellOf(u.y, kRows);
    paths_[block.paths + indexOf(column, row)].index = index;
  }
}

void ReflectiveMap::walk(const PathWalker& walker, const Block& block, bool keeps,
                         std::span<const MoverFinder::Mover> movers) {
  const PathWalker::Source source{block.emitter, block.light};
  const size_t count = static_cast<size_t>(block.columns) * kRows;
  std::atomic<uint64_t> rays{0};
  std::atomic<int> walked{0};
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 64), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
      LightPath& path = paths_[block.paths + i];
      const Departure start = walker.depart(source, path.index);
      if (keeps && startsAs(path, start) && !isTouched(path, movers)) {
        path.flux = start.flux;
        continue;
      }
      rays += static_cast<uint64_t>(walker.walk(source, start, path));
      ++walked;
    }
  });
  rays_ += rays;
  walked_ += walked;
}

void ReflectiveMap::fill(const Block& block) {
  const vec3 gain = lights_.emitters()[static_cast<size_t>(block.emitter)].gain;
  const float share = scale_ / static_cast<float>(block.columns * kRows);
  for (int column = 0; column < block.columns; ++column) {
    for (int row = 0; row < kRows; ++row) {
      const LightPath& path = paths_[block.paths + indexOf(column, row)];
      const size_t i = indexOf(block.first + column, row);
      pathIndex_[i] = path.index;
      vec3 flux = gain * path.flux;
      const PathStep* at = nullptr;
      for (uint32_t bounce = 1; bounce <= block.bounce; ++bounce) {
        at = bounce <= path.steps.size() ? &path.steps[bounce - 1] : nullptr;
        if (at == nullptr || !at->hit) break;
        flux *= at->albedo;
      }
      if (at == nullptr || !at->hit || isDark(flux)) continue;
      const vec3 intensity = share / kPi * flux;
      texels_.x[i] = at->position.x;
      texels_.y[i] = at->position.y;
      texels_.z[i] = at->position.z;
      texels_.nx[i] = at->normal.x;
      texels_.ny[i] = at->normal.y;
      texels_.nz[i] = at->normal.z;
      texels_.red[i] = intensity.r;
      texels_.green[i] = intensity.g;
      texels_.blue[i] = intensity.b;
    }
  }
}

SceneVpl ReflectiveMap::sampleOf(int column, int row) const {
  const Block& block = blockOf(column);
  const size_t i = indexOf(column, row);
  VplId id = block.light;
  id.bounce = block.bounce;
  id.index = pathIndex_[i];
  return SampleStreams(counts_).makeVpl(id, shared::kVplCosine, texels_.position(i),
                                        texels_.normal(i), texels_.intensity(i));
}

}  // namespace lamplighter
