// The contribution of each lamp to the view, by which samples are distributed to lamps: lamps that
// light much of the view get more samples, and lamps that light none of it may get none.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/sampling/choice/point_visibility.h"
#include "renderer/sampling/light_paths.h"

namespace lamplighter {

// An emitter is left out if both hold, and the lamps of the scene need more than 32 samples:
// - None of 1024 points of the view receives light from it, which rays find.
// - Even without shadows it would contribute less than a third of the light at each of 128 of them.
// Where none of n points is lit, less than 3/n of the picture is, with 95% confidence. So less than
// 1/1000 of the light of the picture is missing for each lamp that is left out, at the reference
// brightness of all lamps (reference_brightness.h).
class LampImportance {
 public:
  // Invalidates cached rays after a change of the scene. Call it before the next of().
  void outdate(const RenderSceneChanges& changes, std::span<const MoverFinder::Mover> movers);

  // One for each emitter of paths.lights(), for its counts; `view`: steadyView(). At the reference
  // brightness of lights, so that edits of brightness do not change the result. Empty if the choice
  // has no effect or no lamp lights a point: then samples are shared by flux. 1/d² is bounded at
  // clampDistance [m].
  std::vector<LampShare> of(const RenderScene& scene, const RayCaster& rays,
                            const LightPaths& paths, const View& view, float clampDistance);

 private:
  static constexpr size_t kTests = 8;  // of 128 points each
  // Probes of one emitter: a range of VPLs.
  struct Probes {
    size_t emitter = 0, first = 0, end = 0;
  };
  void leaveOut(const RenderScene& scene, const RayCaster& rays, const View& view,
                float clampDistance, std::span<const SceneVpl> vpls, std::vector<Probes> dark,
                std::vector<LampShare>& lamps);

  std::array<PointVisibility, kTests> visibility_;  // by the points; the first for importance
};

// Whether the distribution of samples to lamps may be kept during an edit: the same lamps are left
// out, and the importance of no lamp changed by more than a factor of four.
bool isNear(std::span<const LampShare> a, std::span<const LampShare> b);

}  // namespace lamplighter
