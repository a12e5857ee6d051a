// VPLs (light samples; paper 1, 4.1): virtual point lights that represent the lights of a scene and
// the light that surfaces reflect.
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

// Identifies a sample of a light. After an edit the same id is the same point on the emitter, or
// the same bounce of the same path. So a small motion of a light causes a small motion of its VPLs.
struct VplId {
  NodeId light = kNoNode;
  uint32_t emitter = 0;  // index among the emitters of one node
  uint32_t bounce = 0;   // 0: direct
  uint32_t index = 0;    // of the point or path

  auto operator<=>(const VplId&) const = default;
  // VPLs of one set share the flux of one light at one bounce.
  VplId set() const { return {light, emitter, bounce, 0}; }
  // VPLs of one path (its bounces) are added and removed together. A direct VPL is a path of its
  // own.
  VplId path() const { return {light, emitter, bounce == 0 ? 0u : 1u, index}; }
};

struct SceneVpl {
  shared::Vpl vpl;  // its slot is −1: the sampler does not assign slots
  VplId id;
  // False for VPLs of a punctual light: each one carries all light in its directions.
  bool isSample = true;
  float area = 0.0f;  // area of its light that it represents [m²]; 0: none

  // Whether it is a sun, or one of its shadow tiles.
  bool isOfSun() const { return !isSample && vpl.position.w == shared::kVplDirectional; }
};

struct VplCounts {
  int total = 300;
  float directShare = 0.5f;  // ignored without bounces: then all are direct
  int bounces = 2;
  uint32_t seed = 1;
  // 0: the set that is shown live. Batches 1, 2, … of the same counts continue sequences of their
  // own, each with differently rotated shadow maps. Their mean equals a picture with the samples of
  // all batches. They require `paths`.
  uint32_t batch = 0;
  // Number of paths to walk, independent of the number of indirect VPLs that they leave; 0: until
  // there are enough VPLs. In the latter case the number of paths depends on their lengths: a small
  // bias that remains in the mean of many sets.
  int paths = 0;
  // Factor for the number of samples of indirect light and of the sky, of which view_importance.h
  // chooses some.
  int candidates = 1;
  bool withoutSky = false;       // the sky gets no samples, but its suns do
  bool withoutSurfaces = false;  // emissive surfaces get no samples
  int sunMaps = 128;  // shadow tiles per sun, in addition to the total (sun_shadow_tiles.h)

  bool operator==(const VplCounts&) const = default;
};

struct VplSet {
  std::vector<SceneVpl> vpls;  // sorted by emitter, direct ones first
  uint64_t rays = 0;           // traced to find them
  int paths = 0;               // walked
  std::vector<VplId> pathIds;  // ids of all walked paths (VplId::path), including those without
                               // VPLs
};

// Whether both belong to the same sun. A sun counts as one sample.
bool isSameSun(const SceneVpl& a, const SceneVpl& b);
// The number of samples in these VPLs, which must be in the order of a set.
int sampleCount(std::span<const SceneVpl> vpls);

// First index of a batch in a sequence of which each batch takes `count` points.
inline uint32_t firstIndex(uint32_t batch, int count) {
  return batch == 0 ? 0 : (batch - 1) * static_cast<uint32_t>(count);
}

// Lights get samples in proportion to their flux at the reference brightness
// (reference_brightness.h), each at least one. If there are not enough samples, the brightest
// lights get them and represent the flux of all. A point light is always two VPLs (hemispheres), a
// spot one. A sun counts as one sample but is divided into shadow tiles, for the view if one is
// given. The range of KHR_lights_punctual, which bends the inverse-square law, is ignored. The
// result may have fewer than `total` VPLs, or more because of shadow tiles.
VplSet generateVpls(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                    const VplCounts& counts, const View* view = nullptr);

}  // namespace lamplighter
