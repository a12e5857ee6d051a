// Which shadow maps a change touches, and which of those waiting are rendered this frame (paper 1,
// 4.5.3).
#pragma once

#include <span>
#include <vector>

#include "renderer/math.h"
#include "renderer/scene/render_scene.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// True when something that was within `before` and is within `after` may show in the VPL's map: it
// is not wholly behind the VPL. A directional VPL sees everything.
bool seesMover(const shared::Vpl& vpl, const Bounds& before, const Bounds& after);

// One VPL that waits for its map.
struct RefreshCandidate {
  float brightness = 0.0f;  // intensity of its brightest channel
  int framesWaiting = 1;    // 1 in the frame that made it stale
};

// The indices of at most `budget` candidates, highest priority = brightness × frames waiting first,
// ties by index. Waiting raises the priority without bound, so none starves.
std::vector<size_t> chooseRefreshes(std::span<const RefreshCandidate> candidates, int budget);

// Tells which objects changed place or shape between two frames, across a rebuild too.
class MoverFinder {
 public:
  struct Mover {
    Bounds before, after;  // empty where it was or is not
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
