// Light linking: each light has a list of nodes that it excludes, including all their descendants.
//
// An object that a light excludes receives no direct light from it, and so reflects none of it. It
// still casts shadows in that light and receives what other objects reflect of it. In terms of
// paths: a path is excluded if its last vertex before the light is on such an object. This is the
// same in all methods.
//
// Lights with the same list share a link, numbered from 1. Each object has one bit per link that
// leaves it out.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/node_id.h"

namespace lamplighter {

struct Scene;

// Largest number of different lists in a scene, one bit each.
inline constexpr uint32_t kMostLinks = 32;

struct LightLinks {
  std::vector<uint8_t> ofLight;     // by node: the link of its light; 0: it leaves nothing out
  uint8_t ofSky = 0;                // the same for the sky
  std::vector<uint32_t> leftOutBy;  // by node: bits of the links
  uint32_t count = 0;

  bool operator==(const LightLinks&) const = default;
};

// In the order of Scene::nodes. Lists beyond kMostLinks are ignored.
LightLinks lightLinks(const Scene& scene);
// Number of different lists, without the limit kMostLinks.
uint32_t countLinks(const Scene& scene);

// Whether an object with these bits receives no light of this link.
inline bool isLeftOut(uint32_t leftOutBy, uint32_t link) {
  return link != 0 && (leftOutBy >> (link - 1) & 1u) != 0;
}

}  // namespace lamplighter
