// Profiles of IES files on lights.
#pragma once

#include <memory>

#include "renderer/scene/scene.h"

namespace lamplighter {

// Whether a light of this kind can have a profile: point and spot.
bool takesProfile(const Node& node);
// The light with another profile, or none, and as many lumens as before.
PunctualLight withProfile(const Scene& scene, const Node& node,
                          std::shared_ptr<const IesProfile> profile);

}  // namespace lamplighter
