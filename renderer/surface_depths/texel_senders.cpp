#include "renderer/surface_depths/texel_senders.h"

#include <map>

namespace lamplighter {
namespace {

// Sums of the light from the texels of one object.
struct SentLight {
  glm::dvec3 power{0.0}, centre{0.0};
  double area = 0.0, weight = 0.0;
};

}  // namespace

std::vector<TexelSender> sendersTo(const TexelBlend& blend, const TexelSet& texels,
                                   const TexelTree& tree, const TexelLinks& links,
                                   const std::vector<vec3>& radiosity) {
  // Neighbouring texels have links to the same nodes.
  std::map<uint32_t, double> weights;
  for (size_t k = 0; k < 4; ++k) {
    if (!(blend.weights[k] > 0.0f)) continue;
    for (const TexelLink& link : links.of(blend.texels[k]))
      weights[link.node] +=
          static_cast<double>(blend.weights[k] * links.scaleOf(blend.texels[k]) * link.weight);
  }
  std::vector<TexelSender> out;
  for (const auto& [number, weight] : weights) {
    const TexelTree::Node& node = tree[number];
    std::map<uint32_t, SentLight> byObject;
    for (uint32_t i = node.firstTexel; i < node.firstTexel + node.texels; ++i) {
      const uint32_t t = tree.order()[i];
      SentLight& sent = byObject[texels[t].object];
      const auto area = static_cast<double>(texels[t].area);
      const glm::dvec3 power = area * glm::dvec3(radiosity[t]);
      const double share = power.r + power.g + power.b;
      sent.area += area;
      sent.power += power;
      sent.weight += share;
      sent.centre += share * glm::dvec3(texels[t].spot.position);
    }
    for (const auto& [object, sent] : byObject)
      if (sent.weight > 0.0 && node.area > 0.0f)
        out.push_back({object, vec3(sent.centre / sent.weight), static_cast<float>(sent.area),
                       vec3(weight / static_cast<double>(node.area) * sent.power)});
  }
  return out;
}

}  // namespace lamplighter
