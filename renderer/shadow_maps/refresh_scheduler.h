// Finds the shadow maps that a change affects, and chooses which of the waiting ones are rendered
// in this frame (paper 1, 4.5.3).
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/scene/render_scene.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// Whether an object that moved from `before` to `after` may be visible in the VPL's map: it is not
// completely behind the VPL. A directional VPL sees everything.
bool seesMover(const shared::Vpl& vpl, const Bounds& before, const Bounds& after);

// How much of the light of a VPL something inside the box may block: a share of the VPL's
// hemisphere (directional: of its square), in [0, 1]. It estimates the error of a map that does not
// show this object.
float hiddenShare(const shared::Vpl& vpl, const Bounds& box);

// Work of refreshing VPLs, or its limit per frame.
struct RefreshWork {
  uint64_t shadowMaps = 0;
  uint64_t visibilityTests = 0;  // occlusion pyramids tested against the scene
  uint64_t lightMapTexels = 0;   // texels × lights that are added or subtracted
  uint64_t rays = 0;             // for traced shadow maps, and to light points

  RefreshWork& operator+=(const RefreshWork& o);
  // Whether `work` is within this limit, for each kind of work.
  bool allows(const RefreshWork& work) const;
};
inline constexpr uint64_t kNoLimit = std::numeric_limits<uint64_t>::max();

struct RefreshBudget {
  int vpls = 0;
  RefreshWork work{kNoLimit, kNoLimit, kNoLimit, kNoLimit};
};

// One waiting VPL, or the waiting VPLs of one path.
struct RefreshCandidate {
  float brightness = 0.0f;  // intensity of its brightest channel
  int framesWaiting = 1;    // 1 in the frame in which it became stale
  RefreshWork work{};       // estimated work of its refresh
  int vpls = 1;             // number of VPLs that must be refreshed together
  bool isFirst = false;     // chosen before all others, whatever their priority
};

// The indices of the candidates for which the budget is sufficient, in the order of choice: those
// with isFirst, then the others; within both by priority = brightness × frames waiting, highest
// first, ties by index. Priority grows while a candidate
// waits, so none starves. The first one is always chosen, even if it exceeds the budget (unless the
// budget allows no VPL).
std::vector<size_t> chooseRefreshes(std::span<const RefreshCandidate> candidates,
                                    const RefreshBudget& budget);

// Finds the objects that changed position or shape between two frames, even if the scene was
// rebuilt.
class MoverFinder {
 public:
  struct Mover {
    Bounds before, after;   // empty where the object did not exist
    NodeId node = kNoNode;  // of the object
  };
  // The movers since the last call; the first call returns every object.
  std::vector<Mover> update(const RenderScene& scene, const RenderSceneChanges& changes);
  void reset() { objects_.clear(); }

 private:
  struct Caster {
    NodeId node;
    uint32_t triangles;
    // The material properties that decide which rays pass.
    bool isClear;
    AlphaMode alphaMode;
    float alphaCutoff, alpha;
    int alphaTexture;
    Bounds bounds;

    bool operator==(const Caster& o) const;
  };
  static Caster casterOf(const RenderScene& scene, const RenderObject& object);
  std::vector<Caster> objects_;
};

}  // namespace lamplighter
