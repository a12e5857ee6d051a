#include "renderer/probes/probe_file.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "renderer/base/error.h"
#include "renderer/image/image_io.h"
#include "renderer/prt/spherical_harmonics.h"

namespace lamplighter {
namespace {

constexpr const char* kQuantity =
    "incident radiance, W/(m2 sr), linear Rec. 709; coefficient i is its integral over the sphere "
    "times Y_i of the direction to where the light comes from";
constexpr const char* kSpace = "metres of the scene file, right-handed, Y up";
constexpr const char* kBasis =
    "real spherical harmonics, bands 0 to 2, orthonormal, without the Condon-Shortley phase: "
    "0.282095, 0.488603 y, 0.488603 z, 0.488603 x, 1.092548 x y, 1.092548 y z, "
    "0.315392 (3 z^2 - 1), 1.092548 x z, 0.546274 (x^2 - y^2)";
constexpr const char* kIrradiance =
    "W/m2 on a surface with normal n: the sum over i of cosine[i] Y_i(n) coefficient i, at least "
    "0; reflected radiance is albedo / pi times it";
constexpr const char* kOrder =
    "x varies fastest, then y, then z; node (x, y, z) is at origin + "
    "spacing (x, y, z), and its probe at position";
constexpr const char* kLayout =
    "RGB: coefficient i of node (x, y, z) in column i size_x + x and row z size_y + y from the "
    "upper left; A: 1 valid, 0 filled from neighbours";

template <typename Values>
void append(std::string& out, const Values& values, size_t count) {
  out += '[';
  for (size_t i = 0; i < count; ++i) {
    const float v = values(i);
    if (!std::isfinite(v))
      throw InputError("a probe", "has light that is not a finite number",
                       "look for lights with an extreme strength");
    if (i > 0) out += ", ";
    fmt::format_to(std::back_inserter(out), "{}", v);
  }
  out += ']';
}

void append(std::string& out, const vec3& v) {
  append(
      out, [&](size_t i) { return v[static_cast<int>(i)]; }, 3);
}

}  // namespace

const char* nameOf(ProbeState state) {
  constexpr std::array<const char*, kProbeStates> kNames{"valid", "inside", "near", "outside",
                                                         "dark"};
  return kNames[static_cast<size_t>(state)];
}

std::string probeText(const ProbeGrid& grid, std::span<const ProbeSh> light,
                      const ProbeFileNotes& notes) {
  const auto text = [](const std::string& s) { return nlohmann::json(s).dump(); };
  std::string out = "{\n";
  for (const auto& [name, value] : {std::pair<const char*, std::string>{"volume", notes.volume},
                                    {"quantity", kQuantity},
                                    {"space", kSpace},
                                    {"basis", kBasis},
                                    {"irradiance", kIrradiance},
                                    {"order", kOrder},
                                    {"layout", kLayout}})
    out += fmt::format("  \"{}\": {},\n", name, text(value));
  out += "  \"cosine\": ";
  append(
      out,
      [](size_t i) {
        return kCosineFactors[i == 0 ? 0 : i < 4 ? 1 : 2];
      },
      kProbeCoefficients);
  out += fmt::format(",\n  \"method\": \"reference\",\n  \"samples\": {},\n  \"bounces\": {},\n",
                     notes.samples, notes.bounces);
  out += "  \"origin\": ";
  append(out, notes.unit * grid.placeOf(glm::ivec3(0)));
  out += fmt::format(",\n  \"spacing\": {},\n  \"padding\": {},\n  \"size\": [{}, {}, {}],\n",
                     notes.unit * grid.spacing, notes.unit * notes.padding, grid.size.x,
                     grid.size.y, grid.size.z);
  out += "  \"probes\": [";
  for (size_t i = 0; i < grid.probes.size(); ++i) {
    const Probe& p = grid.probes[i];
    out += i == 0 ? "\n    {\"position\": " : ",\n    {\"position\": ";
    append(out, notes.unit * p.position);
    out += fmt::format(", \"valid\": {}, \"state\": \"{}\", \"coefficients\": ", p.isValid(),
                       nameOf(p.state));
    append(
        out, [&](size_t c) { return light[i][c / 3][static_cast<int>(c % 3)]; },
        3 * kProbeCoefficients);
    out += '}';
  }
  return out + "\n  ]\n}\n";
}

std::vector<uint8_t> probeVolume(const ProbeGrid& grid, std::span<const ProbeSh> light) {
  const int width = static_cast<int>(kProbeCoefficients) * grid.size.x;
  const int height = grid.size.y * grid.size.z;
  std::vector<vec4> pixels(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (size_t i = 0; i < grid.probes.size(); ++i) {
    const glm::ivec3 node = grid.nodeAt(i);
    const auto row = static_cast<size_t>(node.z * grid.size.y + node.y);
    for (size_t c = 0; c < kProbeCoefficients; ++c)
      pixels[row * static_cast<size_t>(width) + c * static_cast<size_t>(grid.size.x) +
             static_cast<size_t>(node.x)] =
          vec4(light[i][c], grid.probes[i].isValid() ? 1.0f : 0.0f);
  }
  return encodeExr(width, height, pixels);
}

}  // namespace lamplighter
