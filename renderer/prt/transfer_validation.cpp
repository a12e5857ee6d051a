#include "renderer/prt/transfer_validation.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/low_discrepancy.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

constexpr uint32_t kCheckScramble = 0x5eed0002u;
constexpr size_t kFewest = 32;
constexpr double kDark = 0.25;  // of the object's mean
// At most one in this number of the lights with an error may be excluded; if more are, transfer is
// not worth its cost.
constexpr size_t kMostLeft = 6;

// Adds the transfer of a vertex to the terms of the light points that it blends.
void addVertex(const Transfer::Vertex& vertex, const IncidentLightPoints::Blend& blend,
               float weight, std::vector<ValidationPoint::Term>& terms) {
  for (size_t k = 0; k < IncidentLightPoints::kBlended; ++k) {
    if (!(blend.weight[k] > 0.0f)) continue;
    const uint8_t point = blend.point[k];
    auto term = std::find_if(terms.begin(), terms.end(),
                             [&](const ValidationPoint::Term& t) { return t.point == point; });
    if (term == terms.end()) term = terms.insert(terms.end(), {point, ShVector{}});
    for (size_t i = 0; i < kShCoefficients; ++i)
      term->direct[i] += weight * blend.weight[k] * vertex.direct[i];
  }
}

}  // namespace

size_t validationPointsFor(size_t lightPoints) { return std::max(kFewest, 2 * lightPoints); }

std::vector<ValidationPoint> placeValidationPoints(const RenderScene& own, const Transfer& transfer,
                                                   const IncidentLightPoints& points,
                                                   const std::vector<bool>& isLit) {
  const size_t triangles = own.triangleCount();
  std::vector<double> areas(triangles);  // cumulative
  double area = 0.0;
  for (size_t t = 0; t < triangles; ++t) {
    const uint32_t* corner = &own.indices[3 * t];
    const vec3& a = own.positions[corner[0]];
    if (isLit[t])
      area += double{
          glm::length(glm::cross(own.positions[corner[1]] - a, own.positions[corner[2]] - a))};
    areas[t] = area;
  }
  std::vector<ValidationPoint> out;
  if (!(area > 0.0)) return out;
  const size_t count = validationPointsFor(points.places.size());
  for (size_t i = 0; i < count; ++i) {
    const double at = area * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const auto t =
        static_cast<size_t>(std::upper_bound(areas.begin(), areas.end() - 1, at) - areas.begin());
    const uint32_t* corner = &own.indices[3 * t];
    const vec2 u = sobol2(static_cast<uint32_t>(i), kCheckScramble);
    const float root = std::sqrt(u.x);
    const float weights[3] = {1.0f - root, root * (1.0f - u.y), root * u.y};
    ValidationPoint check{};
    for (size_t k = 0; k < 3; ++k) {
      check.place += weights[k] * own.positions[corner[k]];
      check.normal += weights[k] * own.normals[corner[k]];
      addVertex(transfer.vertices[corner[k]], points.ofVertex[corner[k]], weights[k], check.terms);
    }
    const vec3& a = own.positions[corner[0]];
    check.plane = glm::cross(own.positions[corner[1]] - a, own.positions[corner[2]] - a);
    const float side = glm::length(check.plane), length = glm::length(check.normal);
    if (!(side > 0.0f) || !(length > 0.0f)) continue;
    check.plane /= side;
    check.normal /= length;
    // Normals that disagree with the winding are turned, as surfaceAt() does.
    if (glm::dot(check.plane, check.normal) < 0.0f) check.normal = -check.normal;
    out.push_back(std::move(check));
  }
  return out;
}

LightErrors checkLight(const std::vector<ValidationPoint>& checks, const OwnSpace& space,
                       const RayCaster& rays, const shared::Vpl& vpl, std::span<const vec3> places,
                       std::span<const uint8_t> hidden, float clampDistance, uint64_t& traced) {
  LightErrors out(checks.size());
  bool isAny = false;
  // The light that arrives at the light points.
  std::vector<ShVector> light(places.size(), ShVector{});
  for (size_t p = 0; p < places.size(); ++p) {
    if (hidden[p] != 0) continue;
    const auto incident = incidentLight(vpl, places[p], clampDistance);
    if (!incident) continue;
    const float scale = luminance(incident->irradiance);
    light[p] = shBasis(glm::transpose(space.rotation) * incident->direction);
    for (float& y : light[p]) y *= scale;
  }
  for (size_t c = 0; c < checks.size(); ++c) {
    const ValidationPoint& check = checks[c];
    float byTransfer = 0.0f;
    for (const ValidationPoint::Term& term : check.terms)
      byTransfer += shDot(term.direct, light[term.point]);
    const vec3 plane = space.rotation * check.plane, normal = space.rotation * check.normal;
    const vec3 surface = space.scale * (space.rotation * check.place) + space.translation;
    const vec3 place = surface + rayEpsilon(surface) * plane;
    const float geometry = shared::vplGeometry(vpl, place, normal, plane, clampDistance);
    if (geometry > 0.0f) {
      const auto incident = incidentLight(vpl, place, clampDistance);
      if (incident) ++traced;
      if (incident && !rays.occluded({place, 0.0f, incident->direction,
                                      incident->distance - 2.0f * rayEpsilon(place)}))
        out[c].exact = geometry * luminance(vpl.intensity);
    }
    out[c].error = byTransfer - out[c].exact;
    isAny = isAny || out[c].exact != 0.0f || out[c].error != 0.0f;
  }
  if (!isAny) out = {};
  return out;
}

std::vector<bool> lightsToLeave(std::span<const LightErrors> lights,
                                const std::vector<bool>& isHeld, float mostError) {
  const size_t slots = isHeld.size();
  std::vector<bool> leaves(slots, false);
  size_t checks = 0;
  for (const LightErrors& light : lights) checks = std::max(checks, light.size());
  std::vector<double> light(checks, 0.0), error(checks, 0.0);
  double sum = 0.0;
  for (size_t slot = 0; slot < slots; ++slot) {
    for (size_t c = 0; c < lights[slot].size(); ++c) {
      light[c] += double{lights[slot][c].exact};
      sum += double{lights[slot][c].exact};
      if (isHeld[slot]) error[c] += double{lights[slot][c].error};
    }
  }
  if (!(sum > 0.0)) {  // all light from transfer is an error
    for (size_t slot = 0; slot < slots; ++slot)
      leaves[slot] = isHeld[slot] && !lights[slot].empty();
    return leaves;
  }
  const double mean = sum / static_cast<double>(checks);
  std::vector<double> weight(checks);
  for (size_t c = 0; c < checks; ++c) weight[c] = 1.0 / std::clamp(light[c], kDark * mean, mean);
  const auto square = [&](const auto& errorAt) {
    double squares = 0.0;
    for (size_t c = 0; c < checks; ++c) {
      const double e = weight[c] * errorAt(c);
      squares += e * e;
    }
    return squares / static_cast<double>(checks);
  };
  std::vector<std::pair<double, size_t>> order;
  for (size_t slot = 0; slot < slots; ++slot)
    if (isHeld[slot] && !lights[slot].empty())
      order.emplace_back(-square([&](size_t c) { return double{lights[slot][c].error}; }), slot);
  std::sort(order.begin(), order.end());
  const double most = double{mostError} * double{mostError};
  const auto wrong = static_cast<size_t>(
      std::count_if(order.begin(), order.end(), [](const auto& o) { return o.first < 0.0; }));
  size_t left = 0;
  for (const auto& [own, slot] : order) {
    if (!(square([&](size_t c) { return error[c]; }) > most)) break;
    if (++left * kMostLeft > wrong) return isHeld;
    leaves[slot] = true;
    for (size_t c = 0; c < checks; ++c) error[c] -= double{lights[slot][c].error};
  }
  return leaves;
}

}  // namespace lamplighter
