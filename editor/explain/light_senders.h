// Where the bounced light of a point comes from: the surfaces that send it, strongest first.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editor/explain/picked_point.h"
#include "renderer/methods/inspection.h"

namespace lamplighter {

// A surface: the part of an object with one material.
struct SenderKey {
  NodeId node = kNoNode;  // kNoNode: all surfaces that have no row of their own
  int material = 0;       // index into RenderScene::materials
  auto operator<=>(const SenderKey&) const = default;
};

struct LightSender {
  // A part of the surface.
  struct Place {
    vec3 position{0.0f};  // world space [unit of the scene]
    float size = 0.0f;    // side of a square with its area [unit of the scene]
    vec3 light{0.0f};     // irradiance at the point from this place [W/m²]
    float irradiance() const { return luminance(light); }  // [lx]
  };
  SenderKey key;
  std::string name, material;
  float irradiance = 0.0f;  // irradiance at the point from this surface [lx]
  vec3 colour{0.0f};        // of this light; the largest component is 1
  // Strongest first, up to kMostPlaces. Together they give all of the light: each represents others
  // near it.
  std::vector<Place> places;
  static constexpr size_t kMostPlaces = 64;
};

struct LightSenders {
  std::string problem, remedy;    // why they are unknown, and the remedy; "": they are known
  float irradiance = 0.0f;        // by bounced light [lx]
  std::vector<LightSender> rows;  // strongest first; the last one may represent all others
  LightSender all;                // of all surfaces together
  static constexpr size_t kMostRows = 12;      // without the row for all others
  static constexpr float kLeastShare = 1e-3f;  // weaker surfaces have no row

  // Share of the bounced light, from 0 to 1.
  float shareOf(const LightSender& sender) const {
    return irradiance > 0.0f ? sender.irradiance / irradiance : 0.0f;
  }
};

// The place of a point (in the unit of the scene) on the surface of its node. None if there is no
// surface, as on objects that are hidden.
std::optional<InspectedPlace> placeOf(const RenderScene& world, const RayCaster& rays,
                                      const PickedPoint& point);

// The links of a point (in metres), by surface. `scene` gives the names of the nodes.
LightSenders lightSenders(const Scene& scene, const RenderScene& world, const RayCaster& rays,
                          const Inspection& inspection, const PickedPoint& point);

}  // namespace lamplighter
