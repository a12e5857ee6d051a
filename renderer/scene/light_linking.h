// Which objects get no light of which lights: a light's list names nodes, and means all below them.
//
// What a light leaves out receives none of its direct light, and so reflects none of it; it casts
// shadows in it as ever, and gets what others reflect of it. In terms of paths: those are left out
// whose last vertex before the light is on such an object. The same in all methods.
//
// Lights with one and the same list share a link, a number from 1 on; each object has a bit for
// each link that leaves it out.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/node_id.h"

namespace lamplighter {

struct Scene;

// Lists that differ, that a scene can have: so many bits has an object.
inline constexpr uint32_t kMostLinks = 32;

struct LightLinks {
  std::vector<uint8_t> ofLight;     // by node: its light's link; 0: it leaves nothing out
  uint8_t ofSky = 0;                // likewise
  std::vector<uint32_t> leftOutBy;  // by node
  uint32_t count = 0;

  bool operator==(const LightLinks&) const = default;
};

// In the order of Scene::nodes. Lists beyond kMostLinks leave nothing out.
LightLinks lightLinks(const Scene& scene);
// How many lists there are that differ, however many may be.
uint32_t countLinks(const Scene& scene);

// Whether an object with these bits gets no light of that link.
inline bool isLeftOut(uint32_t leftOutBy, uint32_t link) {
  return link != 0 && (leftOutBy >> (link - 1) & 1u) != 0;
}

}  // namespace lamplighter
