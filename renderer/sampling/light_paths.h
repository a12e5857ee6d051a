// The paths of all lights, kept between edits (paper 1, 6.3: dynamic light sets). An edit processes
// only the paths that it affects; if a light moves a little, most of its paths stay unchanged.
//
// Laine et al., "Incremental Instant Radiosity for Real-Time Indirect Illumination" (2007), keep
// the VPLs that a moved light still sees, and choose which VPLs to drop and add so that the
// directions stay well distributed. Here each path is kept with the probability that makes its
// first vertex distributed exactly as light leaves the moved light; otherwise it is redrawn from
// the density that is missing (maximal coupling of both densities; Thorisson, "Coupling,
// Stationarity, and Regeneration", 2000, chapter 1). No path changes its weight, so the brightness
// cannot jump.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "renderer/sampling/path_tracing.h"
#include "renderer/sampling/vpl_counts.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/shadow_maps/refresh_scheduler.h"

namespace lamplighter {

class LightPaths {
 public:
  // When nothing changes, kept paths are replaced within this number of frames by those of a newly
  // opened scene.
  static constexpr int kRestingFrames = 8;
  // A light has moved far if more than one in this number of its paths cannot stay. A light dragged
  // by hand loses one in fifteen per frame.
  static constexpr int kFarShare = 5;

  // With more candidates per VPL than this (VplCounts), an update continues only the paths of this
  // many, so that a drag does not cost more; the others wait for later updates.
  static constexpr size_t kCandidatesAFrame = 8;

  struct Work {        // in the last update()
    int walked = 0;    // paths for which rays were traced
    int replaced = 0;  // walked paths that hit something else now
    int kept = 0;      // unchanged paths
    int pending = 0;   // paths that must still be walked, or replaced by those of a newly opened
                       // scene
    uint64_t rays = 0;
  };

  // Updates the paths for the scene. `changes` and `movers` are those since the last call. If they
  // are empty, the scene is at rest: over several frames the set becomes bit-equal to that of
  // generateVpls(), independent of the history. If too few paths of a light can stay, all its paths
  // are walked again at once. Rays are traced for at most mostPaths paths (brightness × waiting
  // time decides; 0: no limit). After a change of the counts, or if the scene was rebuilt, all
  // paths are walked at once. Changes of gains alone count as rest. Returns whether the set may
  // have changed.
  bool update(const RenderScene& scene, const RayCaster& rays, const RenderSceneChanges& changes,
              std::span<const MoverFinder::Mover> movers, const VplCounts& counts,
              int mostPaths = 0);

  // Generates the set without history, at the reference brightness of lights; suns are not divided
  // into tiles.
  static VplSet generate(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                         const VplCounts& counts);

  const LightSet& lights() const { return lightSet_; }
  const VplCounts& counts() const { return counts_; }
  // All VPLs, with new direct ones: sorted by emitter, direct ones first. At the reference
  // brightness of lights (light_gains.h). Suns are not divided into tiles.
  // `isForChoice`: without the tangents of indirect VPLs, which chooseForView() adds to those that
  // it keeps if there are candidates.
  // `lamps`: contribution of each emitter to the view, by which direct samples are distributed;
  // empty: by flux.
  VplSet set(const RenderScene& scene, bool isForChoice = false,
             std::span<const LampShare> lamps = {}) const;

  // Whether the set is equal to that of generateVpls().
  bool isAtRest() const { return atRest_; }
  const Work& work() const { return work_; }

 private:
  static constexpr size_t kNoStep = static_cast<size_t>(-1);
  struct Path {
    LightPath path;
    Departure start;           // the distribution of its first step
    bool isOwn = true;         // the path that a newly opened scene would have
    bool hasMoved = false;     // its light has moved since the path was last processed
    size_t touched = kNoStep;  // first step that a moved object may block or no longer block
    size_t broken = kNoStep;   // first step whose hit point has moved
    int framesWaiting = 0;
    bool isStale() const { return hasMoved || touched != kNoStep || broken != kNoStep; }
  };
  struct Light {
    PathWalker::Source source;
    int direct = 0, wanted = 0;  // wanted numbers of direct VPLs and of indirect VPLs (or paths, if
                                 // the counts say so)
    float directScale = 1.0f, scale = 1.0f;
    size_t count = 0;  // paths in the set; more may be stored behind them
    std::vector<Path> paths;
  };
  struct Task {
    Light* light;
    Path* path;
    float priority;
    size_t order;  // of equal priorities
    LightPath before{};
    int rays = 0;
    bool follows = false;  // its light has moved
    bool isReplaced = false;
  };

  void takeLights(const RenderScene& scene, LightSet lights);
  SampleCounts shareDirectSamples(const RenderScene& scene, std::span<const LampShare> lamps) const;
  void findTouched(const PathWalker& walker, const RenderSceneChanges& changes,
                   std::span<const MoverFinder::Mover> movers);
  static void findTouched(const PathWalker& walker, bool takesMaterials,
                          const std::vector<bool>& hasMoved,
                          std::span<const MoverFinder::Mover> movers, const Light& light, Path& p);
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
  uint32_t edits_ = 0;         // number of edits so far; selects the random numbers for keeping or
                               // redrawing paths
  Work work_;
};

}  // namespace lamplighter
