// Lights in glTF: KHR_lights_punctual; EXT_lights_area (draft, KhronosGroup/glTF pull request
// 2525): a rectangle or disk that emits towards −Z, size = height or diameter, rect.aspect = width
// / height, intensity in nits; and this program's own note for a sphere or tube, on a node whose
// mesh shows the light in other programs. One nit is read as one unit of radiance, and one candela
// as one unit of radiant intensity.
#include "renderer/scene/gltf/gltf_lights.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/gltf/gltf_content.h"

namespace lamplighter {

namespace {

const Json* lightsOf(const GltfDocument& document, const char* extension) {
  const Json* root = extensionOf(document.json, extension);
  const Json* lights = root == nullptr ? nullptr : member(*root, "lights");
  return lights != nullptr && lights->is_array() ? lights : nullptr;
}

// The light to which the node refers, or null. `index` receives its index in the list.
const Json* lightOf(const GltfDocument& document, size_t node, const char* extension,
                    size_t& index) {
  const Json* reference = extensionOf(listOf(document, "nodes")[node], extension);
  if (reference == nullptr) return nullptr;
  const Json* lights = lightsOf(document, extension);
  const auto light = indexMember(document, *reference, "light", {"nodes", node},
                                 lights == nullptr ? 0 : lights->size());
  if (!light) return nullptr;
  index = *light;
  if (!(*lights)[index].is_object()) {
    document.fail({"nodes", node},
                  std::string("refers to a light of ") + extension + " that is none", kExportAgain);
  }
  return &(*lights)[index];
}

// color × intensity, in double, so that a saved light is read back bit-equal.
vec3 colored(const GltfDocument& document, const Json& light, double defaultIntensity, At at) {
  std::vector<double> color = numbersMember(document, light, "color", 3, at);
  if (color.empty()) color = {1.0, 1.0, 1.0};
  const double intensity = numberMember(document, light, "intensity", defaultIntensity, at);
  vec3 out;
  for (int c = 0; c < 3; ++c) {
    const double value = std::max(color[static_cast<size_t>(c)] * intensity, 0.0);
    if (value > 1e30) document.fail(at, "is brighter than a float can hold", kExportAgain);
    out[c] = static_cast<float>(value);
  }
  return out;
}

std::optional<AreaLight> readNoted(const GltfDocument& document, const Json& node, At at) {
  const Json* light = noteOf(node, "areaLight");
  if (light == nullptr) return std::nullopt;
  const std::string shape = textMember(document, *light, "shape", at);
  if (shape != "sphere" && shape != "tube") return std::nullopt;
  AreaLight area;
  area.shape = shape == "tube" ? AreaShape::tube : AreaShape::sphere;
  area.radiance = glm::clamp(vec3Member(document, *light, "radiance", vec3(1.0f), at), 0.0f, 1e30f);
  const double diameter = numberMember(document, *light, "diameter", 1.0, at);
  const double length = shape == "tube" ? numberMember(document, *light, "length", 1.0, at) : 1.0;
  if (!(diameter > 0.0 && diameter < 1e9 && length > 0.0 && length < 1e9)) {
    document.fail(at, "has a " + shape + " light of no sound size", kExportAgain);
  }
  area.size = vec2(static_cast<float>(diameter));
  if (area.shape == AreaShape::tube) area.size.x = static_cast<float>(length);
  return area;
}

}  // namespace

std::optional<PunctualLight> readPunctual(const GltfDocument& document, size_t node) {
  At at{"KHR_lights_punctual.lights", 0};
  const Json* json = lightOf(document, node, "KHR_lights_punctual", at.index);
  if (json == nullptr) return std::nullopt;
  PunctualLight light;
  const std::string type = textMember(document, *json, "type", at);
  if (type == "point") {
    light.kind = PunctualKind::point;
  } else if (type == "spot") {
    light.kind = PunctualKind::spot;
  } else if (type == "directional") {
    light.kind = PunctualKind::directional;
  } else {
    return std::nullopt;
  }
  light.intensity = colored(document, *json, 1.0, at);
  light.range = static_cast<float>(std::max(numberMember(document, *json, "range", 0.0, at), 0.0));
  if (const Json* spot = member(*json, "spot")) {
    constexpr double kWidest = 1.57079632679;
    const double outer = numberMember(document, *spot, "outerConeAngle", 0.78539816339, at);
    const double inner = numberMember(document, *spot, "innerConeAngle", 0.0, at);
    if (!(outer > 0.0) || outer > kWidest + 1e-4 || inner < 0.0 || inner > outer) {
      document.fail(at, "has a cone that is none: 0 <= inner <= outer <= pi/2 is asked for",
                    kExportAgain);
    }
    light.outerCone = static_cast<float>(outer);
    light.innerCone = static_cast<float>(inner);
  }
  return light;
}

std::optional<AreaLight> readArea(const GltfDocument& document, size_t node,
                                  const vec3& worldScale) {
  const Json& json = listOf(document, "nodes")[node];
  if (auto noted = readNoted(document, json, {"nodes", node})) return noted;

  At at{"EXT_lights_area.lights", 0};
  const Json* light = lightOf(document, node, "EXT_lights_area", at.index);
  if (light == nullptr) return std::nullopt;
  std::string type = textMember(document, *light, "type", at);
  if (type.empty()) type = "rect";
  if (type != "rect" && type != "disk") return std::nullopt;

  AreaLight area;
  area.shape = type == "rect" ? AreaShape::rectangle : AreaShape::disk;
  area.radiance = colored(document, *light, 1000.0, at);
  const double size = numberMember(document, *light, "size", 1.0, at);
  double aspect = 1.0;
  if (const Json* rect = member(*light, "rect"); rect != nullptr && type == "rect") {
    aspect = numberMember(document, *rect, "aspect", 1.0, at);
  }
  if (!(size > 0.0 && size < 1e9 && aspect > 0.0 && aspect < 1e9 && size * aspect < 1e9)) {
    document.fail(at, "has a size or aspect that is none", kExportAgain);
  }
  const AxisRatios s = areaScale(worldScale);
  area.size = vec2(static_cast<float>(size * aspect * s.x), static_cast<float>(size * s.y));
  if (area.shape == AreaShape::disk) area.size.x = area.size.y = static_cast<float>(size * s.x);
  return area;
}

AxisRatios areaScale(const vec3& worldScale) {
  const double largest = std::max({worldScale.x, worldScale.y, worldScale.z});
  const auto ratio = [&](double s) {
    const double r = s > 1e-6 * largest ? largest / s : 1.0;
    return std::abs(r - 1.0) < 1e-5 ? 1.0 : r;  // a deviation due to rotation is not a scale
  };
  return {ratio(worldScale.x), ratio(worldScale.y)};
}

vec3 axisLengths(const mat4& m) {
  return {glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))};
}

void warnOfUnknownLights(GltfDocument& document) {
  struct Kind {
    const char* extension;
    std::vector<std::string> types;
  };
  for (const Kind& kind : {Kind{"KHR_lights_punctual", {"point", "spot", "directional"}},
                           Kind{"EXT_lights_area", {"rect", "disk", ""}}}) {
    const Json* lights = lightsOf(document, kind.extension);
    if (lights == nullptr) continue;
    for (size_t i = 0; i < lights->size(); ++i) {
      const std::string type = textMember(document, (*lights)[i], "type", {kind.extension, i});
      if (std::find(kind.types.begin(), kind.types.end(), type) == kind.types.end()) {
        document.warn(std::string(kind.extension) + ".lights[" + std::to_string(i) +
                      "] is of the unknown type \"" + printable(type) + "\"; shown without it");
      }
    }
  }
}

}  // namespace lamplighter
