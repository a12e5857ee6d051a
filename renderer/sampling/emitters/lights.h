// All emitters of a scene in one list, for the path tracer and the VPL generator.
#pragma once

#include <memory>
#include <vector>

#include "renderer/base/alias_table.h"
#include "renderer/sampling/emitters/emitter_cells.h"
#include "renderer/sampling/emitters/emitter_choice.h"
#include "renderer/sampling/emitters/sky_sampler.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

enum class EmitterKind : uint8_t { surface, punctual, sky };

struct Emitter {
  EmitterKind kind = EmitterKind::surface;
  NodeId node = kNoNode;  // node of the light or object
  uint32_t object = 0;    // surface: index into RenderScene::objects
  uint32_t punctual = 0;  // punctual: index into RenderScene::punctuals
  uint32_t skySun = 0;    // sky: 0: all except its suns, otherwise the number of the sun, from 1
  // Flux Φ [W] per channel: surface π·L·A (both sides if double-sided; with the mean of the
  // emissive texture), point 4π·I, spot I × its solid angle (with a profile, both use the profile's
  // solid angle), directional E·πR², sky πR² ∫ L dω, with R the radius of the scene.
  vec3 flux{0.0f};
  // Light samples use a white light with this brightness (reference_brightness.h): the radiance of
  // a surface, the intensity of a punctual light, the factor of a sky. Times gain, per channel, it
  // is that of the scene.
  float reference = 0.0f;
  vec3 gain{0.0f};
  // The brightness in the scene; exact, because the reference is a power of two.
  vec3 brightness() const { return gain * reference; }
  float referenceFlux = 0.0f;  // luminance of the flux at the reference brightness [W]
  float area = 0.0f;           // surface: m²
  bool bothSides = false;      // surface
  uint32_t link = 0;           // light_linking.h
  AliasTable triangles;        // surface: by area
  EmitterCells cells;          // surface with varying emission: by flux
};

// A point on an emitter's surface, sampled uniformly by area, or by brightness if that varies.
struct EmitterPoint {
  vec3 position{0.0f};
  vec3 normal{0.0f, 0.0f, 1.0f};  // unit, front side
  vec3 radiance{0.0f};            // W/(m² sr), including texture; 0 in a hole of the alpha mask
  vec3 share{1.0f};               // the factor of texture and mask in it
  float pdfArea = 0.0f;           // 1/m²
  float area = 0.0f;              // 1 / pdfArea: the represented area if it were the only sample
                                  // [m²]
  bool bothSides = false;
};

// Lights that are switched off are emitters, too, with no flux.
class LightSet {
 public:
  LightSet() = default;
  explicit LightSet(const RenderScene& scene) : LightSet(scene, LightSet()) {}
  // The same, faster: reuses what `before` computed for unchanged textures.
  LightSet(const RenderScene& scene, const LightSet& before);
  // For paths: chooseSurface() prefers emitters near the point.
  static LightSet forPaths(const RenderScene& scene) { return forPaths(scene, LightSet()); }
  static LightSet forPaths(const RenderScene& scene, const LightSet& before);

  const std::vector<Emitter>& emitters() const { return emitters_; }
  // Selects an emitter that is a surface for light that arrives at a place, in proportion to the
  // luminance of its flux, or, forPaths(), as EmitterChoice does; kNone if there is none.
  int chooseSurface(const vec3& place, float u, float& probability) const;
  float surfaceProbability(const vec3& place, int emitter) const;
  // The emitter of this object's surface, or kNone.
  int emitterOfObject(uint32_t object) const;
  // u.x selects the triangle; the rest of u.x and u.y select the point on it.
  EmitterPoint samplePoint(const RenderScene& scene, int emitter, vec2 u) const;
  // 1 / the density of samplePoint() at a point [m²]. weights: of the triangle's second and third
  // vertex.
  float areaAt(int emitter, uint32_t triangle, vec2 weights) const;
  const SkySampler& sky() const { return sky_; }
  // The sky at its reference brightness.
  const SkySampler& referenceSky() const { return referenceSky_; }
  // Reference brightness of the emitters of the sky; 0 without a sky.
  float skyReference() const { return skyReference_; }
  // The sky at unit brightness: the same after any change of brightness.
  Sky unitSky() const;
  float sceneRadius() const { return radius_; }
  vec3 sceneCentre() const { return centre_; }

 private:
  void addSky(const RenderScene& scene);

  std::vector<Emitter> emitters_;
  std::vector<int> emitterOfObject_;
  AliasTable choice_;
  std::shared_ptr<const EmitterChoice> byPlace_;  // forPaths(), with several emitters
  SkySampler sky_, referenceSky_;
  float skyReference_ = 0.0f;
  vec3 centre_{0.0f};
  float radius_ = 0.0f;
};

}  // namespace lamplighter
