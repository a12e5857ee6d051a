// IES profiles of lights.
#pragma once

#include <memory>

#include "renderer/scene/scene.h"

namespace lamplighter {

// Whether a light of this kind can have a profile (point and spot lights).
bool takesProfile(const Node& node);
// The light with another profile, or none, and with the same luminous flux.
PunctualLight withProfile(const Scene& scene, const Node& node,
                          std::shared_ptr<const IesProfile> profile);

}  // namespace lamplighter
