#include "renderer/methods/mesh_senders.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace lamplighter {
namespace {

// The light of the element at the hit of a ray, as gatheredLight() sums it [W/m²].
vec3 lightAtEnd(const GatherLink& link, const ReflectedLight& reflected) {
  const float* corners = &reflected[12 * size_t{link.leaf}];
  const vec3 w = link.weights();
  vec3 sum(0.0f);
  for (int c = 0; c < 3; ++c)
    sum += w[c] * vec3(corners[4 * c], corners[4 * c + 1], corners[4 * c + 2]);
  return sum;
}

// The centre of an element and the approximate side of a square with its area.
void placeSender(const RenderScene& scene, const SurfaceMesh& mesh, uint32_t leaf,
                 InspectedLink& out) {
  out.object = mesh.objectOfLeaf(leaf);
  const auto places = mesh.placesOfLeaf(leaf);
  for (const SurfacePlace& p : places)
    out.to += spotAt(scene, out.object, p).position / static_cast<float>(places.size());
  out.size = mesh.edge();
  if (mesh.isCluster(leaf)) return;
  std::array<vec3, 3> corners;
  for (size_t c = 0; c < 3; ++c)
    corners[c] =
        spotAt(scene, out.object, mesh.placesOfSample(mesh.samplesOfLeaf(leaf)[c])[0]).position;
  out.size =
      std::sqrt(0.5f * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])));
}

}  // namespace

std::vector<InspectedLink> meshSendersTo(const RenderScene& scene, const SurfaceLight& light,
                                         const InspectedPlace& place) {
  const SurfaceMesh& mesh = light.mesh();
  MeshPoint point;
  if (!mesh.find(scene, place.object, place.triangle, place.isBack, place.weights, point))
    return {};
  std::map<uint32_t, double> shares;  // by sample
  for (size_t c = 0; c < 3; ++c)
    for (const auto& [sample, share] : light.sharesOf(place.object, point.values[c]))
      shares[sample] += static_cast<double>(point.weights[static_cast<int>(c)]) * share;
  std::map<uint32_t, glm::dvec3> byElement;
  for (const auto& [sample, share] : shares) {
    const auto known = light.links().of(sample);
    const auto links = known.first(std::min(known.size(), light.linksGathered()));
    for (const GatherLink& link : links)
      if (link.isLeaf())
        byElement[link.leaf] += share / static_cast<double>(links.size()) *
                                glm::dvec3(lightAtEnd(link, light.reflected()));
  }
  std::vector<InspectedLink> out;
  for (const auto& [leaf, irradiance] : byElement) {
    if (irradiance == glm::dvec3(0.0)) continue;
    InspectedLink& link = out.emplace_back();
    link.from = place.position;
    link.irradiance = vec3(irradiance);
    placeSender(scene, mesh, leaf, link);
  }
  return out;
}

}  // namespace lamplighter
