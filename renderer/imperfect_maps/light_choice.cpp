#include "renderer/imperfect_maps/light_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <unordered_map>

#include "renderer/base/cdf.h"
#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"

namespace lamplighter {
namespace {

constexpr uint32_t kChoiceSet = 0xc1;
constexpr float kBetweenVariance = 0.01f;  // of the squared distance in the picture, [-1, 1]²

// Position in the picture as [-1, 1]², and znear over the distance; none behind the eye.
std::optional<vec3> inPicture(const View& view, const vec3& world) {
  const vec3 p = view.project(world);
  if (p.z < view.znear) return std::nullopt;
  return vec3(2.0f * p.x / static_cast<float>(view.width) - 1.0f,
              2.0f * p.y / static_cast<float>(view.height) - 1.0f, view.znear / p.z);
}

// The texel at an offset of `step`, in the same block.
std::optional<size_t> neighbourOf(const ReflectiveMap& map, int column, int row, int stepColumn,
                                  int stepRow) {
  const ReflectiveMap::Block& block = map.blockOf(column);
  const int c = column + stepColumn, r = row + stepRow;
  if (c < block.first || c >= block.first + block.columns) return std::nullopt;
  if (r < 0 || r >= ReflectiveMap::kRows) return std::nullopt;
  const size_t i = ReflectiveMap::indexOf(c, r);
  if (!(luminance(map.texels().intensity(i)) > 0.0f)) return std::nullopt;
  return i;
}

// Moves the sample of a texel towards its neighbours by `within`, its place in the cell.
void moveBetween(const ReflectiveMap& map, int column, int row, vec2 within, const View& view,
                 SceneVpl& light) {
  const ReflectiveMap::Texels& t = map.texels();
  const vec2 off = within - 0.5f;
  const int stepColumn = off.x < 0.0f ? -1 : 1, stepRow = off.y < 0.0f ? -1 : 1;
  const vec2 part = glm::abs(off);
  const size_t own = ReflectiveMap::indexOf(column, row);
  const std::optional<vec3> image = inPicture(view, t.position(own));
  float weights = (1.0f - part.x) * (1.0f - part.y);
  vec3 position = weights * t.position(own), normal = weights * t.normal(own);
  const std::array<std::array<int, 2>, 3> steps{
      {{stepColumn, 0}, {0, stepRow}, {stepColumn, stepRow}}};
  for (const auto& [c, r] : steps) {
    const std::optional<size_t> other = neighbourOf(map, column, row, c, r);
    if (!other || !image) continue;
    const std::optional<vec3> there = inPicture(view, t.position(*other));
    if (!there) continue;
    const vec3 apart = *there - *image;
    const float similar = std::exp(-0.5f * glm::dot(apart, apart) / kBetweenVariance);
    const float weight =
        similar * (c != 0 ? part.x : 1.0f - part.x) * (r != 0 ? part.y : 1.0f - part.y);
    position += weight * t.position(*other);
    normal += weight * t.normal(*other);
    weights += weight;
  }
  const float length = glm::length(normal);
  if (!(length > 0.0f)) return;
  light.vpl.position = vec4(position / weights, light.vpl.position.w);
  light.vpl.normal = vec4(normal / length, light.vpl.normal.w);
  const Frame frame(normal / length);
  light.vpl.tangent = vec4(frame.tangent, light.vpl.tangent.w);
}

}  // namespace

ChosenLights chooseLights(const ReflectiveMap& map, std::span<const float> importance,
                          const LightChoiceOptions& options) {
  ChosenLights out;
  double important = 0.0, bright = 0.0, unseen = 0.0;
  std::vector<float> weights(map.size());
  for (size_t i = 0; i < weights.size(); ++i) {
    weights[i] = luminance(map.texels().intensity(i));
    important += static_cast<double>(importance[i]);
    bright += static_cast<double>(weights[i]);
    if (!(importance[i] > 0.0f)) unseen += static_cast<double>(weights[i]);
  }
  if (!(bright > 0.0) || options.count <= 0) return out;
  out.defended = static_cast<float>(unseen / bright);
  const float defence = important > 0.0 ? options.defence : 1.0f;
  for (size_t i = 0; i < weights.size(); ++i) {
    const double own = important > 0.0 ? static_cast<double>(importance[i]) / important : 0.0;
    weights[i] = static_cast<float>(static_cast<double>(1.0f - defence) * own +
                                    static_cast<double>(defence * weights[i]) / bright);
  }
  // Each row of the grid is a column of the map.
  const GridCdf grid(ReflectiveMap::kRows, map.columns(), weights);
  const uint32_t scramble = hash4(options.seed, 0, 0, kChoiceSet);
  const auto count = static_cast<uint32_t>(options.count);
  out.lights.reserve(count);
  for (uint32_t k = 0; k < count; ++k) {
    const GridCdf::Cell cell = grid.sample(sobol2Ordered(k, scramble));
    const int column = cell.y, row = cell.x;
    SceneVpl light = map.sampleOf(column, row);
    light.vpl.intensity /= static_cast<float>(count) * cell.probability;
    if (options.between != nullptr)
      moveBetween(map, column, row, vec2(cell.within.y, cell.within.x), *options.between, light);
    out.lights.push_back(light);
    out.texels.push_back(static_cast<uint32_t>(ReflectiveMap::indexOf(column, row)));
  }
  return out;
}

std::vector<SceneVpl> mergedLights(const ChosenLights& chosen) {
  std::vector<SceneVpl> out;
  std::unordered_map<uint32_t, size_t> places;
  for (size_t i = 0; i < chosen.lights.size(); ++i) {
    const auto [at, isNew] = places.try_emplace(chosen.texels[i], out.size());
    if (isNew)
      out.push_back(chosen.lights[i]);
    else
      out[at->second].vpl.intensity += chosen.lights[i].vpl.intensity;
  }
  return out;
}

std::vector<MapLight> boundedLights(std::span<const SceneVpl> lights, float clampDistance,
                                    float mostIrradiance) {
  std::vector<MapLight> out;
  out.reserve(lights.size());
  for (const SceneVpl& light : lights) {
    const float nearest =
        mostIrradiance > 0.0f ? std::sqrt(luminance(light.vpl.intensity) / mostIrradiance) : 0.0f;
    out.push_back({light.vpl, std::max(clampDistance, nearest)});
  }
  return out;
}

}  // namespace lamplighter
