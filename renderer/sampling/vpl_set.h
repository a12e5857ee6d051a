// Light samples (paper 1, 4.1): the virtual point lights that stand for a scene's lights and for
// what they bounce.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// Which sample of which light a VPL is. The same id after a change is the same point on the
// emitter, or the same bounce of the same path, so a light that moves a little moves its VPLs a
// little.
struct VplId {
  NodeId light = kNoNode;
  uint32_t emitter = 0;  // counts the emitters of one node
  uint32_t bounce = 0;   // 0: on the light itself
  uint32_t index = 0;    // of the point, or of the path

  auto operator<=>(const VplId&) const = default;
  // VPLs of one set share in one light's flux at one bounce.
  VplId set() const { return {light, emitter, bounce, 0}; }
  // VPLs of one path, the points at which it bounces, are there all or none; one on a light is a
  // path of its own.
  VplId path() const { return {light, emitter, bounce == 0 ? 0u : 1u, index}; }
};

struct SceneVpl {
  shared::Vpl vpl;  // intensity.w is −1: the slot is not the sampler's business
  VplId id;
  // False for the parts of a punctual light, of which each is all there is in its directions.
  bool isSample = true;
  float area = 0.0f;  // of the surface of its light that it stands for [m²]; 0: no such

  // A sun, or one of the squares into which it is divided.
  bool isOfSun() const { return !isSample && vpl.position.w == shared::kVplDirectional; }
};

struct VplCounts {
  int total = 300;
  float directShare = 0.5f;  // without bounces all are direct
  int bounces = 2;
  uint32_t seed = 1;
  // 0: the set that is shown live. Batches 1, 2, … of the same counts go on one after the other in
  // sequences of their own, each with its maps turned otherwise, so that their mean is a picture
  // with as many samples as all of them together. They want `paths`.
  uint32_t batch = 0;
  // Paths to walk, however many indirect VPLs they leave; 0: until there are enough of these. Then
  // how many there are depends on how long they are, a small error that the mean of many sets
  // keeps.
  int paths = 0;
  // As many times as many samples of bounced light and of the sky, of which others choose some
  // (view_importance.h).
  int candidates = 1;
  int sunMaps = 128;  // squares of each sun, which come on top of the total (sun_shadow_tiles.h)

  bool operator==(const VplCounts&) const = default;
};

struct VplSet {
  std::vector<SceneVpl> vpls;  // sorted by emitter, direct ones first
  uint64_t rays = 0;           // traced to find them
  int paths = 0;               // walked
  std::vector<VplId> pathIds;  // of these (VplId::path), those that left no VPL included
};

// Whether both are of one sun, which is one sample.
bool isSameSun(const SceneVpl& a, const SceneVpl& b);
// How many samples they are, in the order of a set.
int sampleCount(std::span<const SceneVpl> vpls);

// Where a batch goes on in a sequence of which each takes `count` points.
inline uint32_t firstIndex(uint32_t batch, int count) {
  return batch == 0 ? 0 : (batch - 1) * static_cast<uint32_t>(count);
}

// Lights get samples in proportion to their flux, each at least one; when there are not enough for
// that the brightest get them and stand for the flux of all. A point light is two VPLs
// (hemispheres) and a spot one, however many samples there are; a sun is one sample too, but is
// divided into the squares of its maps, for the view if one is given; KHR_lights_punctual's range,
// which bends the inverse-square law, is ignored. May return fewer than `total`, and more by the
// squares.
VplSet generateVpls(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                    const VplCounts& counts, const View* view = nullptr);

}  // namespace lamplighter
