// Which shadow maps a change touches, and which of those waiting are rendered this frame (paper 1,
// 4.5.3).
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/scene/render_scene.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// True when something that was within `before` and is within `after` may show in the VPL's map: it
// is not wholly behind the VPL. A directional VPL sees everything.
bool seesMover(const shared::Vpl& vpl, const Bounds& before, const Bounds& after);

// How much of what the VPL lights something within the box may hide, as the share of its hemisphere
// (directional: of its square), in [0, 1]: how wrong a map is that does not show it.
float hiddenShare(const shared::Vpl& vpl, const Bounds& box);

// Work that refreshing VPLs takes, or may take in one frame.
struct RefreshWork {
  uint64_t shadowMaps = 0;
  uint64_t visibilityTests = 0;  // occlusion pyramids against the scene
  uint64_t lightMapTexels = 0;   // times lights added or taken away
  uint64_t rays = 0;             // for shadow maps that are traced, and to light points

  RefreshWork& operator+=(const RefreshWork& o);
  // No kind of work is more than what this allows of it.
  bool allows(const RefreshWork& work) const;
};
inline constexpr uint64_t kNoLimit = std::numeric_limits<uint64_t>::max();

struct RefreshBudget {
  int vpls = 0;
  RefreshWork work{kNoLimit, kNoLimit, kNoLimit, kNoLimit};
};

// One VPL that waits for its turn, or those of one path.
struct RefreshCandidate {
  float brightness = 0.0f;  // intensity of its brightest channel
  int framesWaiting = 1;    // 1 in the frame that made it stale
  RefreshWork work{};       // that its refresh is thought to take
  int vpls = 1;             // that must be refreshed together
};

// The indices of the candidates that the budget is enough for, highest priority = brightness ×
// frames waiting first, ties by index. Waiting raises the priority without bound, so none starves;
// the first of them always has its turn, however little is allowed (unless no VPL is).
std::vector<size_t> chooseRefreshes(std::span<const RefreshCandidate> candidates,
                                    const RefreshBudget& budget);

// Tells which objects changed place or shape between two frames, across a rebuild too.
class MoverFinder {
 public:
  struct Mover {
    Bounds before, after;   // empty where it was or is not
    NodeId node = kNoNode;  // whose it is
  };
  // Movers since the last call; the first call gives every object.
  std::vector<Mover> update(const RenderScene& scene, const RenderSceneChanges& changes);
  void reset() { objects_.clear(); }

 private:
  struct Caster {
    NodeId node;
    uint32_t triangles;
    // What of its material decides which rays pass.
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
