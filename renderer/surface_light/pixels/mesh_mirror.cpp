#include "renderer/surface_light/pixels/mesh_mirror.h"

#include <bit>

namespace lamplighter {

uint64_t MeshMirror::placeOf(const Ray& ray, const Hit& hit) const {
  return std::bit_cast<uint64_t>(linkTo(scene_, hit, ray));
}

vec3 MeshMirror::radianceOf(uint64_t place) const {
  const auto link = std::bit_cast<GatherLink>(place);
  if (!link.isLeaf() || light_->part() == SurfaceLightPart::sky || light_->reflected().empty())
    return vec3(0.0f);
  return gatheredLight({&link, 1}, light_->reflected()) / kPi;
}

float MeshMirror::areaOf(uint64_t place) const {
  const auto link = std::bit_cast<GatherLink>(place);
  if (link.isLeaf() && (scene_.mesh.isCluster(link.leaf) || light_->isMixed(link.leaf)))
    return std::numeric_limits<float>::infinity();
  const float edge = scene_.mesh.edge();
  return edge * edge;
}

vec3 MeshMirror::skyTowards(const vec3& direction) const {
  if (light_->part() == SurfaceLightPart::bounced) return vec3(0.0f);
  return light_->skyBrightness() * light_->skyTowards(direction);
}

}  // namespace lamplighter
