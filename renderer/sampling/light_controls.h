// Brightness controls. One control sets the brightness of the surfaces of an object with one
// material, a punctual light, or the sky. Objects that share a material can be switched one by one,
// so each has its own control.
#pragma once

#include <map>
#include <vector>

#include "renderer/sampling/light_gains.h"

namespace lamplighter {

struct LightControls {
  LightControls() = default;
  LightControls(const RenderScene& scene, const LightSet& lights);

  // Identifies a control, also after an edit.
  struct Key {
    enum class Kind : uint8_t { surfaces, punctual, sky };
    Kind kind = Kind::sky;
    NodeId node = kNoNode;
    int material = kNone;  // of surfaces: index into RenderScene::materials, not of a dark copy
    bool operator==(const Key&) const = default;
  };
  struct Control {
    Key key;
    vec3 gain{0.0f};         // of its emitters (reference_brightness.h)
    float reference = 0.0f;  // their reference brightness
    float flux = 0.0f;       // sum of their reference fluxes [W]
  };
  std::vector<Control> controls;
  std::map<VplId, uint32_t> ofEmitter;  // by emitterIds()
  std::vector<int> ofObject;            // by object: its control or kNone
  int ofSky = kNone;

  size_t size() const { return controls.size(); }
  uint32_t of(const VplId& id) const { return ofEmitter.at({id.light, id.emitter, 0, 0}); }
};

}  // namespace lamplighter
