#include "editor/lights/light_list.h"

#include <algorithm>

#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_picture.h"
#include "renderer/scene/light_shapes.h"

namespace lamplighter {

namespace {

float areaOf(const Primitive& p, const mat4& world) {
  double area = 0.0;
  const auto at = [&](uint32_t i) { return vec3(world * vec4(p.positions[i], 1.0f)); };
  for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
    const vec3 a = at(p.indices[i]);
    area += 0.5 * static_cast<double>(
                      glm::length(glm::cross(at(p.indices[i + 1]) - a, at(p.indices[i + 2]) - a)));
  }
  return static_cast<float>(area);
}

// The solid angle of a spot's cone, weighted by the intensity relative to the axis. The square of
// KHR's falloff is linear between the cones, so ∫ = 2π [(1 − cos i) + (cos i − cos o)/3].
double spotSolidAngle(const PunctualLight& l) {
  const double inner = std::cos(l.innerCone), outer = std::cos(l.outerCone);
  return 2.0 * static_cast<double>(kPi) * ((1.0 - inner) + (inner - outer) / 3.0);
}

// A lamp whose output depends on its tilt is measured at its current tilt.
LightMeasure punctualMeasure(const PunctualLight& l, const mat4& world) {
  const bool isSpot = l.kind == PunctualKind::spot;
  if (l.profile && l.kind != PunctualKind::directional) {
    const vec3 aim = mat3(world) * vec3(0, 0, -1);
    const float length = glm::length(aim);
    const float tilt = l.profile->atTilt(length > 0.0f ? aim / length : vec3(0, 0, -1));
    constexpr double kLeast = 1e-3;  // a lamp without output at its tilt can still be set
    return {isSpot ? LightKind::spot : LightKind::point, 0.0, 0.0,
            std::max(static_cast<double>(tilt), kLeast), l.profile->solidAngle};
  }
  switch (l.kind) {
    case PunctualKind::point:
      return {LightKind::point, 0.0, 0.0, 1.0, 4.0 * static_cast<double>(kPi)};
    case PunctualKind::spot:
      return {LightKind::spot, 0.0, 0.0, 1.0, spotSolidAngle(l)};
    case PunctualKind::directional:
      return {LightKind::sun};
  }
  return {};
}

// Calls visit(primitive, material) for each emissive primitive.
template <typename Visit>
void forEachEmissive(const Scene& scene, const Node& node, Visit visit) {
  if (node.mesh == kNone) return;
  for (const Primitive& p : scene.meshes[static_cast<size_t>(node.mesh)]->primitives) {
    if (p.material == kNone) continue;
    const Material& m = scene.materials[static_cast<size_t>(p.material)];
    if (m.emits()) visit(p, m);
  }
}

}  // namespace

LightMeasure measureOf(const Scene& scene, const Node& node, const mat4& world) {
  if (node.area) {
    static constexpr LightKind kKinds[] = {LightKind::rectangle, LightKind::disk, LightKind::sphere,
                                           LightKind::tube};
    LightMeasure m{kKinds[static_cast<size_t>(node.area->shape)],
                   lamplighter::areaOf(*node.area, world), projectedAreaOf(*node.area, world)};
    const vec3 factor = meanFactor(*node.area);
    const float plain = luminance(node.area->radiance);
    m.left = static_cast<double>(plain > 0.0f ? luminance(factor * node.area->radiance) / plain
                                              : luminance(factor));
    return m;
  }
  if (node.punctual) return punctualMeasure(*node.punctual, world);
  LightMeasure m{LightKind::mesh};
  forEachEmissive(scene, node, [&](const Primitive& p, const Material& material) {
    m.area += areaOf(p, world) * (material.doubleSided ? 2.0 : 1.0);
  });
  return m;
}

std::vector<LightSource> lightsOf(const Scene& scene) {
  std::vector<LightSource> out;
  const std::vector<mat4> world = worldMatrices(scene);
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& n = scene.nodes[i];
    if (emitsLight(scene, n)) out.push_back({n.id, i, measureOf(scene, n, world[i])});
  }
  if (!scene.sky.isBlack()) out.push_back({kNoNode, 0, {LightKind::sky}});
  return out;
}

std::vector<LightSource> selectedLights(const Document& document) {
  std::vector<LightSource> out = lightsOf(document.scene);
  const std::unordered_set<NodeId> selected = document.selected();
  std::erase_if(
      out, [&](const LightSource& l) { return l.node == kNoNode || !selected.contains(l.node); });
  return out;
}

vec3 emissionOf(const Scene& scene, const LightSource& light) {
  if (light.node == kNoNode) {
    const Sky& s = scene.sky;
    if (s.kind == SkyKind::gradient)
      return 0.5f * (0.5f * (s.zenith + s.horizon) + s.ground);  // the mean height above is 1/2
    return s.kind == SkyKind::image ? vec3(s.scale) : s.radiance;
  }
  const Node& node = scene.nodes[light.index];
  if (node.area) return node.area->radiance;
  if (node.punctual) return node.punctual->intensity;
  const std::vector<int> materials = emissiveMaterials(scene, node);
  if (materials.size() == 1) return scene.materials[static_cast<size_t>(materials[0])].emissive;
  vec3 sum(0.0f);
  float area = 0.0f;
  forEachEmissive(scene, node, [&](const Primitive& p, const Material& m) {
    const float a = areaOf(p, mat4(1.0f)) * (m.doubleSided ? 2.0f : 1.0f);
    sum += a * m.emissive;
    area += a;
  });
  return area > 0.0f ? sum / area : vec3(0.0f);
}

const LightState& stateOf(const Scene& scene, const LightSource& light) {
  return light.node == kNoNode ? scene.skyLight : scene.nodes[light.index].light;
}

std::vector<int> emissiveMaterials(const Scene& scene, const Node& node) {
  std::vector<int> out;
  forEachEmissive(scene, node, [&](const Primitive& p, const Material&) {
    if (std::find(out.begin(), out.end(), p.material) == out.end()) out.push_back(p.material);
  });
  return out;
}

}  // namespace lamplighter
