#include "renderer/surface_light/direct_factors.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/sampling/path_tracing.h"

namespace lamplighter {
namespace {

// Number of rays from an element to a partly visible light.
constexpr uint32_t kPartialRays = 24, kPartialSet = 0x52;
// Large elements whose corners agree are tested by some of them for shadows between the corners.
constexpr uint32_t kProbeRays = 8;
constexpr float kLarge = 0.3f;  // longest side [m]
constexpr float kLift = 0.04f;  // of rays along a surface [edges of elements]

// Corners whose light is summed together, in registers and the nearest cache.
constexpr size_t kCornersASum = 1024;

// Number of elements that are tested together for occluders.
constexpr size_t kLeavesAGroup = 32;

// Number of elements that share the light of one of them until the light of each is computed: more
// if there are many elements for the rays of a call. An element of a new light takes about
// kRaysALeader.
constexpr uint32_t kLeastSpread = 8, kMostSpread = 32;
constexpr uint64_t kRaysALeader = 6;

uint32_t spreadOf(const SurfaceMesh& mesh, uint64_t mostRays) {
  uint32_t spread = kLeastSpread;
  while (spread < kMostSpread && kRaysALeader * mesh.leaves() / spread > mostRays) spread *= 2;
  return spread;
}

uint32_t leaderOf(const SurfaceMesh& mesh, uint32_t leaf, uint32_t spread) {
  return leaf - (leaf - mesh.part(mesh.objectOfLeaf(leaf)).firstLeaf) % spread;
}

// Points at which the light of an element is computed.
std::vector<SurfaceSpot> spotsOf(const DirectFactors::Scene& now, uint32_t leaf) {
  const uint32_t object = now.mesh.objectOfLeaf(leaf);
  std::vector<SurfaceSpot> spots;
  if (now.isMixed[leaf] != 0) {
    for (const uint32_t sample : now.mesh.samplesOfLeaf(leaf))
      spots.push_back(spotAt(now.scene, object, now.mesh.placesOfSample(sample)[0]));
  } else {
    for (const SurfacePlace& place : now.mesh.placesOfLeaf(leaf))
      spots.push_back(spotAt(now.scene, object, place));
  }
  return spots;
}

// `spots`: spotsOf() of an element that is not a cluster.
bool isLarge(std::span<const SurfaceSpot> spots, bool isMixed) {
  const auto side = [&](size_t a, size_t b) {
    return (isMixed ? 1.0f : 2.0f) * glm::distance(spots[a].position, spots[b].position);
  };
  return std::max({side(0, 1), side(1, 2), side(2, 0)}) > kLarge;
}

// Whether nothing blocks the line between a spot of an element and one of its corners, just above
// the surface.
bool seesCorner(const DirectFactors::Scene& now, uint32_t leaf, size_t corner,
                const SurfaceSpot& spot) {
  const uint32_t sample = now.mesh.samplesOfLeaf(leaf)[corner];
  const vec3 lift = kLift * now.mesh.edge() * spot.geometricNormal;
  const vec3 from = spot.position + lift;
  const vec3 to =
      spotAt(now.scene, now.mesh.objectOfLeaf(leaf), now.mesh.placesOfSample(sample)[0]).position +
      lift;
  return !now.rays.occluded({from, 0.0f, to - from, 1.0f});
}

Ball ballAround(const DirectFactors::Scene& now, uint32_t leaf) {
  const uint32_t object = now.mesh.objectOfLeaf(leaf);
  Bounds bounds;
  for (const SurfacePlace& place : now.mesh.placesOfLeaf(leaf))
    bounds.add(spotAt(now.scene, object, place).position);
  for (const uint32_t sample : now.mesh.samplesOfLeaf(leaf))
    bounds.add(spotAt(now.scene, object, now.mesh.placesOfSample(sample)[0]).position);
  return Ball(bounds);
}

}  // namespace

// Data that the stages of an update share.
struct DirectFactors::Work {
  const Scene& now;
  std::vector<uint8_t> isNew;  // by emitter: none of its light is known
  std::vector<EmitterFactor> emitters{};
  std::vector<std::optional<FlatLight>> flat{};
  std::atomic<size_t> computed = 0, masked = 0, open = 0, traced = 0;
};

// Matches the columns with the current emitters. Returns which emitters have none.
std::vector<uint8_t> DirectFactors::matchColumns(const Scene& now, bool isNewMesh,
                                                 const std::vector<bool>& isMoved) {
  const std::vector<VplId> ids = emitterIds(now.lights);
  std::vector<Column> before = std::move(columns_);
  columns_ = std::vector<Column>(ids.size());
  const Sky sky = now.lights.unitSky();
  const bool isSameSky = sky == sky_;
  sky_ = sky;
  const size_t leaves = now.mesh.leaves();
  std::vector<uint8_t> isNew(ids.size(), 1);
  std::vector<size_t> oldOf(ids.size());
  bool isSameOrder = before.size() == ids.size();
  for (size_t i = 0; i < ids.size(); ++i) {
    const Emitter& e = now.lights.emitters()[i];
    Column& column = columns_[i];
    column.id = ids[i];
    column.isColoured = EmitterFactor(now.scene, now.lights, i, ids[i], now.seed).isColoured();
    if (e.kind == EmitterKind::punctual)
      column.light = withoutBrightness(now.scene.punctuals[e.punctual]);
    // Most emitters keep their index.
    size_t old = i;
    if (old >= before.size() || before[old].id != column.id)
      old = static_cast<size_t>(std::ranges::find(before, column.id, &Column::id) - before.begin());
    isSameOrder = isSameOrder && old == i;
    oldOf[i] = old;
    if (!isNewMesh && now.mask == mask_ && old < before.size() &&
        before[old].light == column.light && before[old].isColoured == column.isColoured &&
        (e.kind != EmitterKind::sky || isSameSky) &&
        !(e.kind == EmitterKind::surface && isMoved[e.object])) {
      column.factors = std::move(before[old].factors);
      isNew[i] = 0;
    }
    column.factors.resize(3 * leaves * (column.isColoured ? 3 : 1), 0.0f);
  }
  if (isSameOrder && !isNewMesh) {
    stale_.resize(leaves * words_, 0);
    return isNew;
  }
  const DirectFactors& known = *this;
  const std::vector<uint64_t> staleBefore = std::move(stale_);
  const size_t wordsBefore = words_;
  words_ = (ids.size() + 63) / 64;
  stale_.assign(leaves * words_, 0);
  for (size_t leaf = 0; !isNewMesh && known.staleLeaves_ > 0 && leaf < leaves; ++leaf) {
    if ((leaf + 1) * wordsBefore > staleBefore.size()) break;
    for (size_t e = 0; e < ids.size(); ++e)
      if (oldOf[e] < before.size() &&
          (staleBefore[leaf * wordsBefore + oldOf[e] / 64] >> oldOf[e] % 64 & 1u) != 0)
        setStale(leaf, e);
  }
  return isNew;
}

uint64_t DirectFactors::update(const Scene& now, bool isNewMesh,
                               std::span<const uint32_t> movedObjects,
                               std::span<const Bounds> boxes, uint64_t mostRays) {
  std::vector<bool> isMoved(now.mesh.objects(), false);
  for (const uint32_t o : movedObjects) isMoved[o] = true;
  const size_t columnsBefore = columns_.size();
  findBalls(now, isNewMesh, isMoved);
  Work work{now, matchColumns(now, isNewMesh, isMoved)};
  if (now.mask != 0) blockers_.update(now.scene, isNewMesh || mask_ == 0, movedObjects);
  mask_ = now.mask;
  const bool isOtherwiseMixed =
      wasMixed_.size() != now.isMixed.size() || !std::ranges::equal(wasMixed_, now.isMixed);
  const bool hasNew = std::ranges::count(work.isNew, 1) > 0;
  computed_ = masked_ = open_ = 0;
  changed_ = hasNew || columns_.size() != columnsBefore || !movedObjects.empty();
  if (!hasNew && boxes.empty() && movedObjects.empty() && !isOtherwiseMixed && isDone()) return 0;

  const std::vector<VplId> ids = emitterIds(now.lights);
  for (size_t e = 0; e < columns_.size(); ++e) {
    work.emitters.emplace_back(now.scene, now.lights, e, ids[e], now.seed);
    work.flat.push_back(work.emitters.back().flat(now.mask));
  }
  if (hasNew || isOtherwiseMixed || !boxes.empty() || !movedObjects.empty())
    outdate(work, isMoved, boxes);
  wasMixed_.assign(now.isMixed.begin(), now.isMixed.end());
  const std::vector<uint32_t> chosen = choose(work, mostRays);
  tbb::parallel_for(size_t{0}, chosen.size(), [&](size_t k) { find(work, chosen[k]); });
  if (hasNew && !isDone()) spread(work, spreadOf(now.mesh, mostRays));
  changed_ = changed_ || !chosen.empty();
  computed_ = work.computed;
  masked_ = work.masked;
  open_ = work.open;
  return work.traced;
}

// For elements whose position is unknown or changed.
void DirectFactors::findBalls(const Scene& now, bool isNewMesh, const std::vector<bool>& isMoved) {
  const size_t known = isNewMesh ? 0 : balls_.size();
  balls_.resize(now.mesh.leaves(), Ball(vec3(0.0f)));
  tbb::parallel_for(size_t{0}, balls_.size(), [&](size_t k) {
    const uint32_t object = now.mesh.objectOfLeaf(static_cast<uint32_t>(k));
    if (object != SurfaceMesh::kUnused && (k >= known || isMoved[object]))
      balls_[k] = ballAround(now, static_cast<uint32_t>(k));
  });
}

// Marks light that may have changed. Neighbouring elements are tested together first.
void DirectFactors::outdate(const Work& work, const std::vector<bool>& isMoved,
                            std::span<const Bounds> boxes) {
  const SurfaceMesh& mesh = work.now.mesh;
  const size_t emitters = work.emitters.size();
  std::vector<Ball> lights, moved;
  for (const EmitterFactor& e : work.emitters) lights.emplace_back(e.bounds());
  for (const Bounds& b : boxes) moved.emplace_back(b);
  std::vector<size_t> fresh;
  for (size_t e = 0; e < emitters; ++e)
    if (work.isNew[e]) fresh.push_back(e);
  const auto mayDiffer = [&](const Ball& ball, size_t e) {
    return work.emitters[e].bounds().empty() || std::ranges::any_of(moved, [&](const Ball& m) {
             return mayBeBetween(ball, lights[e], m);
           });
  };
  const size_t groups = (mesh.leaves() + kLeavesAGroup - 1) / kLeavesAGroup;
  tbb::parallel_for(size_t{0}, groups, [&](size_t group) {
    const size_t first = group * kLeavesAGroup;
    const size_t last = std::min(first + kLeavesAGroup, mesh.leaves());
    std::vector<size_t> near;  // emitters
    if (!boxes.empty()) {
      std::vector<Ball> used;
      for (size_t k = first; k < last; ++k)
        if (mesh.objectOfLeaf(static_cast<uint32_t>(k)) != SurfaceMesh::kUnused)
          used.push_back(balls_[k]);
      const Ball all{std::span<const Ball>(used)};
      for (size_t e = 0; e < emitters && !used.empty(); ++e)
        if (!work.isNew[e] && mayDiffer(all, e)) near.push_back(e);
    }
    for (size_t k = first; k < last; ++k) {
      const uint32_t object = mesh.objectOfLeaf(static_cast<uint32_t>(k));
      if (object == SurfaceMesh::kUnused) {
        std::ranges::fill(staleOf(k), 0u);
        continue;
      }
      const bool isOther = k >= wasMixed_.size() || wasMixed_[k] != work.now.isMixed[k];
      if (isMoved[object] || isOther) {
        for (size_t e = 0; e < emitters; ++e) setStale(k, e);
        continue;
      }
      for (const size_t e : fresh) setStale(k, e);
      for (const size_t e : near)
        if (!isStale(k, e) && mayDiffer(balls_[k], e)) setStale(k, e);
    }
  });
}

// The elements whose light is computed in this call; for new emitters at least the leaders.
std::vector<uint32_t> DirectFactors::choose(const Work& work, uint64_t mostRays) {
  const SurfaceMesh& mesh = work.now.mesh;
  const auto leaves = static_cast<uint32_t>(mesh.leaves());
  const bool hasNew = std::ranges::count(work.isNew, 1) > 0;
  std::vector<uint8_t> isChosen(leaves, 0);
  uint64_t planned = 0;
  const auto take = [&](uint32_t leaf) {
    uint64_t stale = 0;
    for (const uint64_t word : staleOf(leaf)) stale += static_cast<uint64_t>(std::popcount(word));
    if (stale == 0 || isChosen[leaf]) return;
    isChosen[leaf] = 1;
    planned += 3 * stale;
  };
  const uint32_t spread = spreadOf(mesh, mostRays);
  for (uint32_t leaf = 0; hasNew && leaf < leaves; ++leaf)
    if (mesh.objectOfLeaf(leaf) != SurfaceMesh::kUnused && leaderOf(mesh, leaf, spread) == leaf)
      take(leaf);
  const uint32_t first = next_ < leaves ? next_ : 0;
  for (uint32_t i = 0; i < leaves && planned < mostRays; ++i) {
    next_ = (first + i) % leaves;
    take(next_);
  }
  std::vector<uint32_t> chosen;
  staleLeaves_ = 0;
  for (uint32_t leaf = 0; leaf < leaves; ++leaf) {
    if (isChosen[leaf])
      chosen.push_back(leaf);
    else if (std::ranges::any_of(staleOf(leaf), [](uint64_t word) { return word != 0; }))
      ++staleLeaves_;
  }
  return chosen;
}

// The light of a partly shadowed element: more rays, from points all over it. Each corner gets the
// visible share of the light around it; on a mixed element the corner is dark if no point near it
// sees the light. `seenRays`: number of unblocked rays. Returns the number of rays.
uint64_t DirectFactors::findPartial(const Work& work, size_t emitter, uint32_t leaf, uint32_t count,
                                    std::array<vec3, 3>& corners, size_t& seenRays) {
  const Scene& now = work.now;
  const uint32_t object = now.mesh.objectOfLeaf(leaf);
  const uint32_t key = leaf - now.mesh.part(object).firstLeaf;
  const auto places = now.mesh.placesOfLeaf(leaf);
  std::array<vec2, 3> at;
  for (size_t c = 0; c < 3; ++c) at[c] = {places[c].u, places[c].v};
  const vec2 middle = (at[0] + at[1] + at[2]) / 3.0f;
  // The points lie half-way between the centre and the corners.
  const auto spotOf = [&](const vec3& w) {
    vec2 place(0.0f);
    for (int c = 0; c < 3; ++c) place += w[c] * (2.0f * at[static_cast<size_t>(c)] - middle);
    return spotAt(now.scene, object, {places[0].triangle, place.x, place.y});
  };
  std::vector<SurfaceSpot> spots;
  std::vector<vec3> weights;
  for (uint32_t i = 0; i < count; ++i) {
    const vec2 p = sobol2(i, hash4(key, 0, 0, kPartialSet));
    const float root = std::sqrt(p.x);
    vec3 w(1.0f - root, root * (1.0f - p.y), root * p.y);
    vec3 counts = w;
    if (now.isMixed[leaf] != 0) {
      // Each corner has its own light, on its side of the wall.
      const int c = static_cast<int>(i % 3);
      counts = vec3(0.0f);
      counts[c] = 1.0f;
      w = 0.5f * w + 0.5f * counts;
      if (!seesCorner(now, leaf, static_cast<size_t>(c), spotOf(w))) continue;
    }
    weights.push_back(counts);
    spots.push_back(spotOf(w));
  }
  std::vector<LightRay> lights;
  work.emitters[emitter].raysTo(spots, now.scene.objects[object].leftOutBy, ~key, lights);
  std::array<vec3, 3> seen{}, all{};
  for (size_t first = 0; first < lights.size(); first += RayCaster::kLanes) {
    const auto some =
        std::span(lights).subspan(first, std::min(RayCaster::kLanes, lights.size() - first));
    std::array<Ray, RayCaster::kLanes> rays;
    for (size_t i = 0; i < RayCaster::kLanes; ++i)
      if (i < some.size())
        rays[i] = some[i].ray;
      else
        rays[i].tFar = -1.0f;
    const std::array<bool, RayCaster::kLanes> isHidden = now.rays.occluded8(rays);
    for (size_t i = 0; i < some.size(); ++i) {
      seenRays += isHidden[i] ? 0 : 1;
      for (size_t c = 0; c < 3; ++c) {
        const vec3 part = weights[some[i].spot][static_cast<int>(c)] * some[i].irradiance;
        all[c] += part;
        if (!isHidden[i]) seen[c] += part;
      }
    }
  }
  for (size_t c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k) corners[c][k] *= all[c][k] > 0.0f ? seen[c][k] / all[c][k] : 0.0f;
  return lights.size();
}

// Computes all outdated light of an element.
void DirectFactors::find(Work& work, uint32_t leaf) {
  const Scene& now = work.now;
  const uint32_t object = now.mesh.objectOfLeaf(leaf);
  const uint32_t leftOutBy = now.scene.objects[object].leftOutBy;
  const bool isCluster = now.mesh.isCluster(leaf);
  const uint32_t key = leaf - now.mesh.part(object).firstLeaf;
  const std::vector<SurfaceSpot> spots = spotsOf(now, leaf);
  std::vector<LightRay> lights;
  for (size_t e = 0; e < work.emitters.size(); ++e) {
    if (!isStale(leaf, e)) continue;
    work.emitters[e].raysTo(spots, leftOutBy, key, lights);
    std::array<vec3, 3> corners{}, open{};
    size_t visible = 0, tested = 0;
    for (const LightRay& l : lights) {
      float share = 0.0f;
      const auto& flat = work.flat[e];
      const auto byMask = flat ? maskedShare(now.scene, blockers_, *flat, spots[l.spot])
                               : std::optional<MaskedShare>();
      if (byMask) {
        share = byMask->share;
        ++(byMask->isOpen ? work.open : work.masked);
      } else {
        share = now.rays.occluded(l.ray) ? 0.0f : 1.0f;
        ++work.traced;
        ++tested;
        visible += share > 0.0f ? 1 : 0;
      }
      if (!isCluster) open[l.spot] = l.irradiance;
      if (!isCluster)
        corners[l.spot] = share * l.irradiance;
      else
        corners[0] += share * l.irradiance / static_cast<float>(spots.size());
    }
    if (!isCluster && tested > 0) {
      const bool isMixed = now.isMixed[leaf] != 0;
      bool isPartial = !isMixed && visible > 0 && visible < tested;
      if (!isPartial && isLarge(spots, isMixed)) {
        std::array<vec3, 3> probed = open;
        size_t seen = 0;
        const uint64_t rays = findPartial(work, e, leaf, kProbeRays, probed, seen);
        work.traced += rays;
        isPartial = visible < tested || seen < rays ? visible > 0 || seen > 0 : false;
      }
      if (isPartial) {
        std::array<vec3, 3> found = open;
        size_t seen = 0;
        work.traced += findPartial(work, e, leaf, kPartialRays, found, seen);
        corners = found;
      }
    }
    if (isCluster) corners[1] = corners[2] = corners[0];
    ++work.computed;
    Column& column = columns_[e];
    const size_t channels = column.isColoured ? 3 : 1;
    float* out = &column.factors[3 * size_t{leaf} * channels];
    for (const vec3& corner : corners) out = std::copy_n(&corner.x, channels, out);
  }
  std::ranges::fill(staleOf(leaf), 0u);
}

// Fills missing light of new emitters with that of a nearby element.
void DirectFactors::spread(const Work& work, uint32_t elements) {
  const SurfaceMesh& mesh = work.now.mesh;
  tbb::parallel_for(size_t{0}, mesh.leaves(), [&](size_t k) {
    const auto leaf = static_cast<uint32_t>(k);
    if (mesh.objectOfLeaf(leaf) == SurfaceMesh::kUnused) return;
    const uint32_t leader = leaderOf(mesh, leaf, elements);
    for (size_t e = 0; e < columns_.size(); ++e) {
      if (!work.isNew[e] || !isStale(k, e)) continue;
      const size_t channels = columns_[e].isColoured ? 3 : 1;
      float* factors = columns_[e].factors.data();
      for (size_t c = 0; c < channels; ++c) {
        const float* from = factors + 3 * leader * channels + c;
        float* to = factors + 3 * k * channels + c;
        to[0] = to[channels] = to[2 * channels] =
            (from[0] + from[channels] + from[2 * channels]) / 3.0f;
      }
    }
  });
}

void DirectFactors::sum(const LightSet& lights, std::vector<vec3>& out) const {
  const size_t blocks = (out.size() + kCornersASum - 1) / kCornersASum;
  tbb::parallel_for(size_t{0}, blocks, [&](size_t block) {
    const size_t first = block * kCornersASum;
    const size_t count = std::min(kCornersASum, out.size() - first);
    std::array<std::array<float, kCornersASum>, 3> sums{};
    for (size_t e = 0; e < columns_.size(); ++e) {
      const Column& column = columns_[e];
      const vec3 brightness = lights.emitters()[e].brightness();
      const size_t channels = column.isColoured ? 3 : 1;
      const float* factors = &column.factors[channels * first];
      for (size_t c = 0; c < 3; ++c) {
        const float scale = brightness[static_cast<int>(c)];
        if (scale == 0.0f) continue;
        float* channel = sums[c].data();
        const float* from = factors + c % channels;
        for (size_t k = 0; k < count; ++k) channel[k] += scale * from[channels * k];
      }
    }
    for (size_t k = 0; k < count; ++k) out[first + k] = {sums[0][k], sums[1][k], sums[2][k]};
  });
}

size_t DirectFactors::bytes() const {
  size_t bytes = stale_.size() * sizeof(uint64_t) + balls_.size() * sizeof(Ball);
  for (const Column& column : columns_) bytes += column.factors.size() * sizeof(float);
  return bytes;
}

}  // namespace lamplighter
