#include "renderer/sampling/light_paths.h"

#include <algorithm>
#include <limits>

#include <tbb/parallel_for.h>

#include "renderer/sampling/direct_vpls.h"
#include "renderer/sampling/path_reuse.h"
#include "renderer/sampling/vpl_counts.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Largest number of paths per wanted VPL: in an open scene most paths escape.
constexpr size_t kPathsPerVpl = 16;

// How much more urgent a path is that an object has moved into.
constexpr float kAstrayFirst = 64.0f;

// The part of the direct samples that is distributed by flux only, because lamps also light
// surfaces between the points of the view.
constexpr double kFluxShare = 0.25;

bool sameHit(const Hit& a, const Hit& b) {
  return a.object == b.object && a.triangle == b.triangle && a.t == b.t && a.u == b.u && a.v == b.v;
}

bool touches(const PathStep& s, const Bounds& box) {
  return mayTouch({s.origin, 0.0f, s.direction, s.hit.t}, box);
}

bool meetSame(const LightPath& a, const LightPath& b) {
  return std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(),
                    [](const PathStep& s, const PathStep& t) {
                      return s.position == t.position && s.normal == t.normal &&
                             static_cast<bool>(s.hit) == static_cast<bool>(t.hit);
                    });
}

}  // namespace

bool LightPaths::update(const RenderScene& scene, const RayCaster& rays,
                        const RenderSceneChanges& changes,
                        std::span<const MoverFinder::Mover> movers, const VplCounts& counts,
                        int mostPaths) {
  work_ = {};
  const bool isEdited = !changes.none() && !changes.onlyGains();
  const bool isAfresh = !started_ || changes.rebuilt || counts != counts_;
  if (!isAfresh && changes.onlyGains()) lightSet_ = LightSet(scene, lightSet_);
  if (!isAfresh && !isEdited && atRest_) return false;
  if (isAfresh) lights_.clear();
  counts_ = counts;
  started_ = true;
  edits_ += isEdited;
  if (isAfresh || isEdited) takeLights(scene, LightSet(scene, lightSet_));
  const PathWalker walker(scene, rays, lightSet_, counts_);
  if (isEdited) findTouched(walker, changes, movers);
  const bool isResting = isAfresh || !isEdited;
  lookAgain(walker, isResting, mostPaths);
  fitCounts(walker, isResting);
  atRest_ = isExact(walker);
  return true;
}

VplSet LightPaths::generate(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                            const VplCounts& counts) {
  LightPaths paths;
  paths.counts_ = counts;
  paths.takeLights(scene, lights);
  paths.fitCounts(PathWalker(scene, rays, paths.lightSet_, counts), true);
  return paths.set(scene);
}

void LightPaths::takeLights(const RenderScene& scene, LightSet lights) {
  lightSet_ = std::move(lights);
  const std::vector<Emitter>& emitters = lightSet_.emitters();
  const int indirect = std::max(counts_.total, 0) - directSamples(counts_);
  std::vector<SampleShare> indirectShares;
  for (const Emitter& e : emitters)
    indirectShares.push_back({directShareOf(scene, e, counts_).weight, 1, false});
  const SampleCounts directCounts = shareDirectSamples(scene, {});
  const int candidates = std::max(counts_.candidates, 1);
  const SampleCounts indirectCounts =
      shareSamples(indirectShares, (counts_.paths > 0 ? counts_.paths : indirect) * candidates);

  const std::vector<VplId> ids = emitterIds(lightSet_);
  std::vector<Light> now(emitters.size());
  for (size_t i = 0; i < now.size(); ++i) {
    const auto before = std::find_if(lights_.begin(), lights_.end(),
                                     [&](const Light& l) { return l.source.id == ids[i]; });
    if (before != lights_.end()) now[i] = std::move(*before);
    now[i].source = {static_cast<int>(i), ids[i]};
    now[i].direct = directCounts.counts[i];
    now[i].directScale = directCounts.scale;
    now[i].wanted = counts_.bounces > 0 ? indirectCounts.counts[i] : 0;
    now[i].scale = indirectCounts.scale;
  }
  lights_ = std::move(now);
}

// The samples of each emitter, without the factor of candidates.
SampleCounts LightPaths::shareDirectSamples(const RenderScene& scene,
                                            std::span<const LampShare> lamps) const {
  const std::vector<Emitter>& emitters = lightSet_.emitters();
  std::vector<SampleShare> shares;
  for (const Emitter& e : emitters) shares.push_back(directShareOf(scene, e, counts_));
  if (lamps.size() != shares.size()) return shareSamples(shares, directSamples(counts_));
  double flux = 0.0, importance = 0.0;
  for (size_t i = 0; i < shares.size(); ++i) {
    flux += shares[i].weight;
    importance += lamps[i].importance;
  }
  for (size_t i = 0; i < shares.size(); ++i) {
    SampleShare& share = shares[i];
    if (!(share.weight > 0.0f)) continue;
    const double mixed =
        (1.0 - kFluxShare) * lamps[i].importance / importance + kFluxShare * share.weight / flux;
    share.weight = lamps[i].isLeftOut ? 0.0f : nearestPowerOfTwo(static_cast<float>(mixed));
    share.order = lamps[i].importance;
  }
  SampleCounts counts = shareSamples(shares, directSamples(counts_));
  // Lamps that get samples also represent the contribution of the others to the view, not their
  // flux.
  double all = 0.0, served = 0.0;
  for (size_t i = 0; i < shares.size(); ++i) {
    all += lamps[i].light;
    if (counts.counts[i] > 0) served += lamps[i].light;
  }
  counts.scale = served > 0.0 ? static_cast<float>(all / served) : 1.0f;
  return counts;
}

void LightPaths::findTouched(const PathWalker& walker, const RenderSceneChanges& changes,
                             std::span<const MoverFinder::Mover> movers) {
  std::vector<bool> hasMoved(walker.scene().objects.size(), false);
  for (const uint32_t object : changes.movedObjects) hasMoved[object] = true;
  for (Light& light : lights_)
    tbb::parallel_for(size_t{0}, light.paths.size(), [&](size_t i) {
      findTouched(walker, changes.materials, hasMoved, movers, light, light.paths[i]);
    });
}

void LightPaths::findTouched(const PathWalker& walker, bool takesMaterials,
                             const std::vector<bool>& hasMoved,
                             std::span<const MoverFinder::Mover> movers, const Light& light,
                             Path& p) {
  const Departure now = walker.depart(light.source, p.path.index);
  p.hasMoved = !now.startsAs(p.start);
  if (!p.hasMoved)
    p.path.flux =
        p.isOwn ? now.flux : walker.fluxAlong(light.source, now, p.path.steps[0].direction);
  if (takesMaterials) takeMaterials(walker, light, p);
  for (size_t s = 0; s < p.path.steps.size(); ++s) {
    const PathStep& step = p.path.steps[s];
    if (s >= p.broken) break;
    if (step.hit && hasMoved[step.hit.object]) {
      p.broken = s;
      break;
    }
    if (s >= p.touched) continue;
    // A moved light does not block its own paths: it is no longer at the start of the old path.
    const bool isTouched =
        std::any_of(movers.begin(), movers.end(), [&](const MoverFinder::Mover& m) {
          const bool isOwnBody = s == 0 && p.hasMoved && m.node == light.source.id.light;
          return !isOwnBody && (touches(step, m.before) || touches(step, m.after));
        });
    if (isTouched) p.touched = s;
  }
}

// Updates the reflectance at the path's vertices; the vertices do not move.
void LightPaths::takeMaterials(const PathWalker& walker, const Light& light, Path& p) {
  std::vector<PathStep>& steps = p.path.steps;
  for (size_t s = 0; s < steps.size() && steps[s].hit; ++s) {
    const bool ended = steps[s].ends();
    const Hit& h = steps[s].hit;
    steps[s].albedo = surfaceAt(walker.scene(), h.object, h.triangle, h.u, h.v).albedo;
    if (s == 0) walker.receive(light.source, steps[s]);
    if (steps[s].ends()) {
      steps.resize(s + 1);
    } else if (ended && steps.size() < walker.bounces()) {
      p.broken = std::min(p.broken, s);  // the path continues from there now
    }
  }
}

// Selects the paths to process: those that an edit affects and, at rest, some that are not those of
// a newly opened scene.
std::vector<LightPaths::Task> LightPaths::tasksOf(bool isResting, int mostPaths) {
  std::vector<Task> stale, strange;
  size_t count = 0, order = 0;
  for (Light& light : lights_) {
    count += light.paths.size();
    for (Path& p : light.paths) {
      ++order;
      if (!p.isStale() && !(isResting && !p.isOwn)) continue;
      const float brightness = std::max({p.path.flux.r, p.path.flux.g, p.path.flux.b});
      // Where an object moved, VPLs may be in the air: those paths come first.
      const bool isAstray = p.touched != kNoStep || p.broken != kNoStep;
      const float urgency = (isAstray ? kAstrayFirst : 1.0f) * brightness;
      (p.isStale() ? stale : strange)
          .push_back({&light, &p, urgency * static_cast<float>(++p.framesWaiting), order});
    }
  }
  const auto take = [](std::vector<Task>& tasks, size_t most) {
    if (tasks.size() <= most) return;
    std::nth_element(tasks.begin(), tasks.begin() + static_cast<ptrdiff_t>(most), tasks.end(),
                     [](const Task& a, const Task& b) {
                       return a.priority != b.priority ? a.priority > b.priority
                                                       : a.order < b.order;
                     });
    tasks.resize(most);
  };
  // With many candidates a frame continues with a part of them.
  const auto candidates = static_cast<size_t>(std::max(counts_.candidates, 1));
  const size_t most = mostPaths > 0 ? static_cast<size_t>(mostPaths)
                      : candidates > kCandidatesAFrame
                          ? (count * kCandidatesAFrame + candidates - 1) / candidates
                          : std::numeric_limits<size_t>::max();
  take(stale, most);
  take(strange, std::min(most - stale.size(), (count + kRestingFrames - 1) / kRestingFrames));
  stale.insert(stale.end(), strange.begin(), strange.end());
  return stale;
}

void LightPaths::lookAgain(const PathWalker& walker, bool isResting, int mostPaths) {
  std::vector<Task> tasks = tasksOf(isResting, mostPaths);
  tbb::parallel_for(size_t{0}, tasks.size(),
                    [&](size_t i) { lookAgain(walker, isResting, tasks[i]); });
  // If a light moved far, its paths become those of a newly opened scene again. Redrawn paths would
  // be replaced by those at rest, and need new shadow maps twice.
  for (const Light& light : lights_) {
    const auto isOf = [&](const Task& t) { return t.light == &light && t.follows; };
    const auto following = std::count_if(tasks.begin(), tasks.end(), isOf);
    const auto replaced = std::count_if(tasks.begin(), tasks.end(),
                                        [&](const Task& t) { return isOf(t) && t.isReplaced; });
    if (kFarShare * replaced <= following) continue;
    tbb::parallel_for(size_t{0}, tasks.size(), [&](size_t i) {
      if (isOf(tasks[i])) walkOwn(walker, tasks[i]);
    });
  }
  work_.walked = static_cast<int>(tasks.size());
  for (const Task& task : tasks) {
    work_.rays += static_cast<uint64_t>(task.rays);
    work_.replaced += task.isReplaced;
  }
}

void LightPaths::walkOwn(const PathWalker& walker, Task& task) {
  Path& p = *task.path;
  p.start = walker.depart(task.light->source, p.path.index);
  p.isOwn = true;
  task.rays += walker.walk(task.light->source, p.start, p.path);
  task.isReplaced = !meetSame(task.before, p.path);
}

void LightPaths::lookAgain(const PathWalker& walker, bool isResting, Task& task) const {
  const PathWalker::Source& source = task.light->source;
  Path& p = *task.path;
  task.before = p.path;
  if (isResting && (p.hasMoved || !p.isOwn)) {
    walkOwn(walker, task);
  } else {
    // First process objects that moved into the old path, then move the path with its light.
    for (size_t s = std::min(p.touched, p.broken); s < p.path.steps.size(); ++s) {
      const PathStep& step = p.path.steps[s];
      if (s < p.broken) {
        ++task.rays;
        if (sameHit(walker.rays().intersect({step.origin, 0.0f, step.direction}), step.hit))
          continue;
      }
      task.rays += walker.walkOn(source, p.path, s);
      break;
    }
    task.follows = p.hasMoved;
    if (p.hasMoved)
      task.rays += follow(walker, *task.light, p, walker.depart(source, p.path.index));
    task.isReplaced = !meetSame(task.before, p.path);
  }
  p.hasMoved = false;
  p.touched = p.broken = kNoStep;
  p.framesWaiting = 0;
}

int LightPaths::follow(const PathWalker& walker, const Light& light, Path& p,
                       const Departure& now) const {
  int traced = 0;
  if (now.spread == Departure::Spread::parallel || p.start.spread != now.spread) {
    // Parallel light starts at the edge of the scene, which may be all that has moved.
    LightPath own{p.path.index, {}, {}};
    traced = walker.walk(light.source, now, own);
    p.isOwn = !isNearly(own, p.path, 1e-4f * lightSet_.sceneRadius());
    if (p.isOwn) p.path.steps = std::move(own.steps);
    p.path.flux = now.flux;
  } else {
    p.isOwn = false;
    traced = followStart(walker, light.source, p.start, now, edits_, p.path);
    p.path.flux = walker.fluxAlong(light.source, now, p.path.steps[0].direction);
  }
  p.start = now;
  return traced;
}

void LightPaths::walkMore(const PathWalker& walker, Light& light, size_t count) {
  const size_t before = light.paths.size();
  light.paths.resize(std::max(count, before));
  const uint32_t first = firstIndex(counts_.batch, light.wanted);
  std::vector<int> traced(light.paths.size() - before);
  tbb::parallel_for(before, light.paths.size(), [&](size_t i) {
    Path& p = light.paths[i];
    p.path.index = first + static_cast<uint32_t>(i);
    p.start = walker.depart(light.source, p.path.index);
    traced[i - before] = walker.walk(light.source, p.start, p.path);
  });
  for (const int n : traced) work_.rays += static_cast<uint64_t>(n);
  work_.walked += static_cast<int>(traced.size());
}

// The number of paths that leave the wanted number of VPLs. A path that would leave too many is not
// started: cutting off its last bounces would favour the first bounces. Returns kNoStep if more
// paths would have to be walked to find out.
size_t LightPaths::exactCount(const PathWalker& walker, Light& light, bool mayWalk) {
  if (light.wanted <= 0) return 0;
  const auto wanted = static_cast<size_t>(light.wanted);
  const bool countsPaths = counts_.paths > 0;
  const size_t cap = (countsPaths ? 1 : kPathsPerVpl) * wanted;
  const size_t most = countsPaths ? std::numeric_limits<size_t>::max() : wanted;
  size_t count = 0, vpls = 0;
  while (count < cap && vpls < most) {
    if (count == light.paths.size()) {
      if (!mayWalk) return kNoStep;
      // At least this many are necessary.
      const size_t needed =
          countsPaths ? cap : (most - vpls + walker.bounces() - 1) / walker.bounces();
      walkMore(walker, light, std::min(count + needed, cap));
    }
    const auto length = vplCount(light.paths[count].path);
    if (vpls > 0 && vpls + length > most) break;
    ++count;
    vpls += length;
  }
  return count;
}

// During an edit the number of paths stays constant, unless there are far too few or too many VPLs,
// because each additional path makes all others darker.
void LightPaths::fitCounts(const PathWalker& walker, bool isResting) {
  const auto isPending = [&](const Path& p) { return p.isStale() || !p.isOwn; };
  for (Light& light : lights_) {
    size_t vpls = 0;
    light.count = std::min(light.count, light.paths.size());
    for (size_t i = 0; i < light.count; ++i) vpls += vplCount(light.paths[i].path);
    const auto wanted = static_cast<size_t>(std::max(light.wanted, 0));
    const bool isFitting = vpls + std::max(wanted / 8, walker.bounces()) >= wanted &&
                           vpls <= wanted + std::max(wanted / 16, walker.bounces());
    const bool isPassing =
        !isResting || std::any_of(light.paths.begin(), light.paths.end(), isPending);
    if (isPassing && light.count > 0 && isFitting) continue;
    light.count = exactCount(walker, light, true);
    if (!isPassing) light.paths.resize(std::min(light.paths.size(), light.count + 1));
  }
  for (const Light& light : lights_) {
    work_.kept += static_cast<int>(light.count);
    work_.pending +=
        static_cast<int>(std::count_if(light.paths.begin(), light.paths.end(), isPending));
  }
  work_.kept = std::max(0, work_.kept - work_.replaced);
}

bool LightPaths::isExact(const PathWalker& walker) {
  if (work_.pending > 0) return false;
  return std::all_of(lights_.begin(), lights_.end(),
                     [&](Light& light) { return exactCount(walker, light, false) == light.count; });
}

VplSet LightPaths::set(const RenderScene& scene, bool isForChoice,
                       std::span<const LampShare> lamps) const {
  VplSet result;
  result.rays = work_.rays;
  const SampleStreams numbers(counts_);
  const DirectVpls direct(scene, lightSet_, counts_);
  const bool isTurned = !isForChoice || counts_.candidates <= 1;
  SampleCounts shared;
  if (!lamps.empty()) shared = shareDirectSamples(scene, lamps);
  for (size_t i = 0; i < lights_.size(); ++i) {
    const Light& light = lights_[i];
    const Emitter& e = lightSet_.emitters()[i];
    const bool isWholeSky = e.kind == EmitterKind::sky && e.skySun == 0;
    direct.add(light.source,
               (lamps.empty() ? light.direct : shared.counts[i]) *
                   (isWholeSky ? std::max(counts_.candidates, 1) : 1),
               lamps.empty() ? light.directScale : shared.scale, result.vpls);
    const size_t first = result.vpls.size();
    const float share = light.scale / static_cast<float>(std::max<size_t>(light.count, 1));
    for (size_t k = 0; k < light.count; ++k) {
      const LightPath& path = light.paths[k].path;
      addVpls(numbers, light.source.id, path, share, isTurned, result.vpls);
      result.pathIds.push_back({light.source.id.light, light.source.id.emitter, 1, path.index});
    }
    // A path is only cut if it is longer than all VPLs together.
    const auto most = static_cast<size_t>(std::max(light.wanted, 0));
    if (counts_.paths == 0 && result.vpls.size() - first > most &&
        result.vpls[first].id.path() == result.vpls.back().id.path())
      result.vpls.resize(first + most);
    result.paths += static_cast<int>(light.count);
  }
  return result;
}

}  // namespace lamplighter
