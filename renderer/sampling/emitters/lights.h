// Everything in a scene that emits, as one list that the path tracer and the VPL generator sample.
#pragma once

#include <vector>

#include "renderer/base/alias_table.h"
#include "renderer/sampling/emitters/emitter_cells.h"
#include "renderer/sampling/emitters/sky_sampler.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

enum class EmitterKind : uint8_t { surface, punctual, sky };

struct Emitter {
  EmitterKind kind = EmitterKind::surface;
  NodeId node = kNoNode;  // the light's or object's node
  uint32_t object = 0;    // surface: index into RenderScene::objects
  uint32_t punctual = 0;  // punctual: index into RenderScene::punctuals
  uint32_t skySun = 0;    // sky: 0 all but its suns, else the sun of that number, from 1 on
  // Flux Φ [W] per channel: surface π·L·A (both sides when double-sided, the emissive texture's
  // mean included), point 4π·I, spot I × its solid angle (both that of their profile), directional
  // E·πR², sky πR² ∫ L dω, with R the radius of the scene.
  vec3 flux{0.0f};
  float area = 0.0f;       // surface: m²
  bool bothSides = false;  // surface
  uint32_t link = 0;       // light_linking.h
  AliasTable triangles;    // surface: by area
  EmitterCells cells;      // surface whose emission varies: by flux
};

// A point on an emitter's surface, chosen uniformly by area, or by brightness where that varies.
struct EmitterPoint {
  vec3 position{0.0f};
  vec3 normal{0.0f, 0.0f, 1.0f};  // unit, the front side
  vec3 radiance{0.0f};            // W/(m² sr), texture included, 0 in a hole of the alpha mask
  float pdfArea = 0.0f;           // 1/m²
  float area = 0.0f;              // 1 / pdfArea: what it stands for, were it the only one [m²]
  bool bothSides = false;
};

class LightSet {
 public:
  LightSet() = default;
  explicit LightSet(const RenderScene& scene) : LightSet(scene, LightSet()) {}
  // The same, faster: what `before` knows of textures that are still there is not found again.
  LightSet(const RenderScene& scene, const LightSet& before);

  const std::vector<Emitter>& emitters() const { return emitters_; }
  // Chooses among the emitters that are surfaces, in proportion to the luminance of their flux;
  // kNone when there are none.
  int chooseSurface(float u, float& probability) const;
  float surfaceProbability(int emitter) const;
  // The emitter whose surface this object is, or kNone.
  int emitterOfObject(uint32_t object) const;
  // u selects the triangle (u.x, reused within it) and the point on it.
  EmitterPoint samplePoint(const RenderScene& scene, int emitter, vec2 u) const;
  // 1 / the density with which samplePoint() draws a point of its surface [m²]. weights: of the
  // triangle's second and third corner.
  float areaAt(int emitter, uint32_t triangle, vec2 weights) const;
  const SkySampler& sky() const { return sky_; }
  float sceneRadius() const { return radius_; }
  vec3 sceneCentre() const { return centre_; }

 private:
  std::vector<Emitter> emitters_;
  std::vector<int> emitterOfObject_;
  AliasTable choice_;
  SkySampler sky_;
  vec3 centre_{0.0f};
  float radius_ = 0.0f;
};

}  // namespace lamplighter
