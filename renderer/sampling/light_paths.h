// The paths of all lights, kept from edit to edit (paper 1, 6.3: dynamic light sets): only those
// that an edit touches are looked at, and of a light that moves a little most stay as they are.
//
// Laine et al., "Incremental Instant Radiosity for Real-Time Indirect Illumination" (2007), keep
// VPLs of a moved light that it still sees and choose which others to drop and to add so that their
// directions are spread as they should be. Here each path is kept with the probability that
// leaves its first vertex distributed exactly as light leaves the moved light, and is drawn anew
// from what is lacking otherwise (maximal coupling of both densities; Thorisson, "Coupling,
// Stationarity, and Regeneration", 2000, chapter 1): no path changes its weight, so that brightness
// cannot jump.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "renderer/sampling/path_tracing.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/shadow_maps/refresh_scheduler.h"

namespace lamplighter {

class LightPaths {
 public:
  // In so many frames at rest kept paths are exchanged for those of a scene opened afresh.
  static constexpr int kRestingFrames = 8;
  // A light of which more than one in so many paths cannot stay has gone far. Dragged by a hand it
  // loses one in fifteen a frame.
  static constexpr int kFarShare = 5;

  struct Work {        // of the last update()
    int walked = 0;    // for which rays were traced
    int replaced = 0;  // of these, those that meet something else now
    int kept = 0;      // paths that are as they were
    int pending = 0;   // that wait for their turn, or to be what they are when opened afresh
    uint64_t rays = 0;
  };

  // Brings the paths up to date with the scene. `changes` and `movers` are those since the last
  // call. Where they say none, the scene is at rest and the set becomes generateVpls()'s, bit for
  // bit, whatever was before, a part a frame. Of a light
  // of which too few paths can stay all are walked anew at once. Rays are traced for mostPaths
  // paths at most (brightest × longest waiting first; 0: no limit), but after a change of the
  // counts or of which objects there are all are walked at once. Returns whether the set may have
  // changed.
  bool update(const RenderScene& scene, const RayCaster& rays, const RenderSceneChanges& changes,
              std::span<const MoverFinder::Mover> movers, const VplCounts& counts,
              int mostPaths = 0);

  // The set of a scene from nothing; suns are whole.
  static VplSet generate(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                         const VplCounts& counts);

  const LightSet& lights() const { return lightSet_; }
  // All VPLs, direct ones made anew: sorted by emitter, direct ones first. Suns are whole.
  VplSet set(const RenderScene& scene) const;

  // The set is generateVpls()'s.
  bool isAtRest() const { return atRest_; }
  const Work& work() const { return work_; }

 private:
  static constexpr size_t kNoStep = static_cast<size_t>(-1);
  struct Path {
    LightPath path;
    Departure start;           // that its first step is distributed by
    bool isOwn = true;         // it departs, moreover, as its own sample numbers say
    bool hasMoved = false;     // its light has, since it was looked at
    size_t touched = kNoStep;  // first step that something may have moved into or away from
    size_t broken = kNoStep;   // first step whose end has moved
    int framesWaiting = 0;
    bool isStale() const { return hasMoved || touched != kNoStep || broken != kNoStep; }
  };
  struct Light {
    PathWalker::Source source;
    int direct = 0, wanted = 0;  // VPLs on it; bounced ones, or paths where the counts say so
    float directScale = 1.0f, scale = 1.0f;
    size_t count = 0;  // paths in the set; behind them there may be more, whose turn it is not
    std::vector<Path> paths;
  };
  struct Task {
    Light* light;
    Path* path;
    float priority;
    LightPath before{};
    int rays = 0;
    bool follows = false;  // its light has moved
    bool isReplaced = false;
  };

  void takeLights(const RenderScene& scene, LightSet lights);
  void findTouched(const PathWalker& walker, const RenderSceneChanges& changes,
                   std::span<const MoverFinder::Mover> movers);
  static void takeMaterials(const PathWalker& walker, const Light& light, Path& p);
  void lookAgain(const PathWalker& walker, bool isResting, int mostPaths);
  std::vector<Task> tasksOf(bool isResting, int mostPaths);
  void lookAgain(const PathWalker& walker, bool isResting, Task& task) const;
  static void walkOwn(const PathWalker& walker, Task& task);
  int follow(const PathWalker& walker, const Light& light, Path& p, const Departure& now) const;
  void walkMore(const PathWalker& walker, Light& light, size_t count);
  size_t exactCount(const PathWalker& walker, Light& light, bool mayWalk);
  void fitCounts(const PathWalker& walker, bool isResting);
  bool isExact(const PathWalker& walker);

  bool atRest_ = false, started_ = false;
  VplCounts counts_;
  LightSet lightSet_;
  std::vector<Light> lights_;  // one for each emitter
  uint32_t edits_ = 0;         // so far: which numbers paths are kept or drawn by
  Work work_;
};

}  // namespace lamplighter
