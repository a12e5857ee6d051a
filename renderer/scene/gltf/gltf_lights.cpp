// KHR_lights_punctual; EXT_lights_area (draft, KhronosGroup/glTF pull request 2525): a rectangle
// or disk that emits towards −Z, size its height or diameter, rect.aspect width over height,
// intensity in nits; and this program's own note of a sphere or tube, on a node whose mesh shows
// it to others. A nit is taken as one unit of radiance, as a candela is as one of radiant
// intensity.
#include "renderer/scene/gltf/gltf_lights.h"

#include <algorithm>
#include <cmath>

#include <tiny_gltf.h>

#include "renderer/scene/gltf/gltf_content.h"

namespace lamplighter {

namespace {

// color × intensity, in double so that a saved light comes back with the same bits. No color is
// white.
vec3 colored(const GltfDocument& document, const std::vector<double>& color, double intensity,
             At at) {
  vec3 out;
  for (int c = 0; c < 3; ++c) {
    const double share = color.empty() ? 1.0 : color[static_cast<size_t>(c)];
    const double value = std::max(share * intensity, 0.0);
    if (value > 1e30) document.fail(at, "is brighter than a float can hold");
    out[c] = static_cast<float>(value);
  }
  return out;
}

std::optional<AreaLight> readNoted(const GltfDocument& document, const Json& node, At at) {
  const Json* light = noteOf(node, "areaLight");
  if (light == nullptr) return std::nullopt;
  const std::string shape = textIn(*light, "shape");
  if (shape != "sphere" && shape != "tube") return std::nullopt;
  AreaLight area;
  area.shape = shape == "tube" ? AreaShape::tube : AreaShape::sphere;
  const std::vector<double> radiance = numbersIn(*light, "radiance");
  if (!radiance.empty()) area.radiance = vec3(radiance[0], radiance[1], radiance[2]);
  area.radiance = glm::clamp(area.radiance, 0.0f, 1e30f);
  const double diameter = numberIn(*light, "diameter", 1.0);
  const double length = shape == "tube" ? numberIn(*light, "length", 1.0) : 1.0;
  if (!(diameter > 0.0 && diameter < 1e9 && length > 0.0 && length < 1e9)) {
    document.fail(at, "has a " + shape + " light with an invalid size");
  }
  area.size = vec2(static_cast<float>(diameter));
  if (area.shape == AreaShape::tube) area.size.x = static_cast<float>(length);
  return area;
}

}  // namespace

std::optional<PunctualLight> readPunctual(const GltfDocument& document, size_t node) {
  const Json* reference = extensionOf(listOf(document, "nodes")[node], "KHR_lights_punctual");
  if (reference == nullptr || !reference->contains("light")) return std::nullopt;
  const At at{kPunctualLights, sizeIn(*reference, "light")};
  const tinygltf::Light& source = document.model->lights[at.index];
  PunctualLight light;
  if (source.type == "point") {
    light.kind = PunctualKind::point;
  } else if (source.type == "spot") {
    light.kind = PunctualKind::spot;
  } else if (source.type == "directional") {
    light.kind = PunctualKind::directional;
  } else {
    return std::nullopt;
  }
  light.intensity = colored(document, source.color, source.intensity, at);
  light.range = static_cast<float>(std::max(source.range, 0.0));
  constexpr double kWidest = 1.57079632679;
  const double outer = source.spot.outerConeAngle, inner = source.spot.innerConeAngle;
  if (!(outer > 0.0) || outer > kWidest + 1e-4 || inner < 0.0 || inner > outer) {
    document.fail(at, "has invalid cone angles: 0 <= inner <= outer <= pi/2 is required");
  }
  light.outerCone = static_cast<float>(outer);
  light.innerCone = static_cast<float>(inner);
  return light;
}

std::optional<AreaLight> readArea(const GltfDocument& document, size_t node,
                                  const vec3& worldScale) {
  const Json& json = listOf(document, "nodes")[node];
  if (auto noted = readNoted(document, json, {"nodes", node})) return noted;

  const Json* reference = extensionOf(json, "EXT_lights_area");
  if (reference == nullptr || !reference->contains("light")) return std::nullopt;
  const At at{kAreaLights, sizeIn(*reference, "light")};
  const Json& light = listOf(document, kAreaLights)[at.index];
  std::string type = textIn(light, "type");
  if (type.empty()) type = "rect";
  if (type != "rect" && type != "disk") return std::nullopt;

  AreaLight area;
  area.shape = type == "rect" ? AreaShape::rectangle : AreaShape::disk;
  area.radiance =
      colored(document, numbersIn(light, "color"), numberIn(light, "intensity", 1000.0), at);
  const double size = numberIn(light, "size", 1.0);
  double aspect = 1.0;
  if (const Json* rect = member(light, "rect"); rect != nullptr && type == "rect") {
    aspect = numberIn(*rect, "aspect", 1.0);
  }
  if (!(size > 0.0 && size < 1e9 && aspect > 0.0 && aspect < 1e9 && size * aspect < 1e9)) {
    document.fail(at, "has an invalid size or aspect");
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
    return std::abs(r - 1.0) < 1e-5 ? 1.0 : r;  // what rotating leaves is no scale
  };
  return {ratio(worldScale.x), ratio(worldScale.y)};
}

vec3 axisLengths(const mat4& m) {
  return {glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))};
}

void warnOfUnknownLights(GltfDocument& document) {
  struct Kind {
    const char* list;
    std::vector<std::string> types;
  };
  for (const Kind& kind : {Kind{kPunctualLights, {"point", "spot", "directional"}},
                           Kind{kAreaLights, {"rect", "disk", ""}}}) {
    const Json& lights = listOf(document, kind.list);
    for (size_t i = 0; i < lights.size(); ++i) {
      const std::string type = textIn(lights[i], "type");
      if (std::find(kind.types.begin(), kind.types.end(), type) == kind.types.end()) {
        document.warn(At{kind.list, i}.text() + " is of the unknown type \"" + printable(type) +
                      "\"; shown without it");
      }
    }
  }
}

}  // namespace lamplighter
