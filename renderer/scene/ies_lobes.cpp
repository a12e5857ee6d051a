#include "renderer/scene/ies_lobes.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

namespace {

constexpr size_t kDirections = 4096;
constexpr int kSweeps = 60;
// What is left of the energy when more lobes are not worth their shadow maps.
constexpr double kEnough = 2e-4;

// Evenly over the sphere, each for the same solid angle: a Fibonacci spiral (Swinbank and Purser,
// "Fibonacci grids", 2006).
std::vector<vec3> directionsOfSphere() {
  std::vector<vec3> out(kDirections);
  const float turn = kPi * (3.0f - std::sqrt(5.0f));
  for (size_t i = 0; i < kDirections; ++i) {
    const float z = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / kDirections;
    const float r = std::sqrt(1.0f - z * z), a = turn * static_cast<float>(i);
    out[i] = {r * std::cos(a), r * std::sin(a), z};
  }
  return out;
}

SpotLobe lobe(const vec3& axis, float inner, float outer) {
  SpotLobe l{axis, 1.0f};
  const float ci = std::cos(glm::radians(inner)), co = std::cos(glm::radians(outer));
  l.scale = 1.0f / std::max(ci - co, 1e-3f);
  l.offset = -co * l.scale;
  return l;
}

// What there is to choose from: hemispheres, and cones of several widths and edges about axes all
// round.
std::vector<SpotLobe> dictionary() {
  std::vector<SpotLobe> out;
  // Not dark at the horizon: together they are near a cosine, too.
  for (const float side : {-1.0f, 1.0f}) {
    for (const float edge : {1.0f, 0.7f, 0.5f, 0.35f, 0.2f, 0.1f})
      out.push_back({vec3(0, 0, side), 1.0f, 1.0f - edge, edge});
  }
  struct Cone {
    float inner, outer;
  };
  static constexpr Cone kSoft[] = {{0, 90}, {0, 60}, {0, 42}, {0, 30}, {0, 21},
                                   {0, 15}, {0, 10}, {0, 7},  {0, 4}};
  static constexpr Cone kSharp[] = {{80, 90}, {60, 80}, {50, 65}, {38, 50}, {28, 38},
                                    {20, 28}, {14, 20}, {9, 14},  {5, 9},   {73, 77},
                                    {58, 62}, {43, 47}, {29, 31}};
  for (const float side : {-1.0f, 1.0f}) {
    for (const Cone& c : kSoft) out.push_back(lobe(vec3(0, 0, side), c.inner, c.outer));
    for (const Cone& c : kSharp) out.push_back(lobe(vec3(0, 0, side), c.inner, c.outer));
  }
  constexpr int kAround = 8;
  for (int polar = 15; polar < 180; polar += 15) {
    for (int i = 0; i < kAround; ++i) {
      const float v = glm::radians(static_cast<float>(polar));
      const float h = 2.0f * kPi * static_cast<float>(i) / kAround;
      const vec3 axis(std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), -std::cos(v));
      for (size_t c = 0; c < 6; ++c) out.push_back(lobe(axis, kSoft[c].inner, kSoft[c].outer));
    }
  }
  return out;
}

// min |Σ w a − f|² with w ≥ 0 by coordinate descent on the normal equations.
void weigh(const std::vector<std::vector<double>>& gram, const std::vector<double>& right,
           std::vector<double>& w) {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (size_t i = 0; i < w.size(); ++i) {
      double rest = right[i];
      for (size_t j = 0; j < w.size(); ++j) {
        if (j != i) rest -= gram[i][j] * w[j];
      }
      w[i] = std::max(rest / gram[i][i], 0.0);
    }
  }
}

double dot(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.size(); ++i)
    sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return sum;
}

double sumOf(const std::vector<float>& a) {
  double sum = 0.0;
  for (const float v : a) sum += static_cast<double>(v);
  return sum;
}

}  // namespace

float SpotLobe::at(const vec3& direction) const {
  const float z = glm::dot(direction, axis);
  if (z <= 0.0f) return 0.0f;
  const float ramp = std::clamp(z * scale + offset, 0.0f, 1.0f);
  return intensity * ramp * ramp;
}

std::vector<SpotLobe> fitLobes(const std::function<float(const vec3&)>& intensity) {
  const std::vector<vec3> directions = directionsOfSphere();
  std::vector<float> wanted(kDirections);
  for (size_t i = 0; i < kDirections; ++i) wanted[i] = intensity(directions[i]);
  const std::vector<SpotLobe> all = dictionary();
  std::vector<std::vector<float>> atoms;
  std::vector<double> lengths;
  for (const SpotLobe& l : all) {
    std::vector<float>& atom = atoms.emplace_back(kDirections);
    for (size_t i = 0; i < kDirections; ++i) atom[i] = l.at(directions[i]);
    lengths.push_back(std::sqrt(dot(atom, atom)));
  }
  const double energy = dot(wanted, wanted);
  std::vector<size_t> chosen;
  std::vector<std::vector<double>> gram;
  std::vector<double> right, weights;
  std::vector<float> rest = wanted;
  while (chosen.size() < kMostLobes && dot(rest, rest) > kEnough * energy) {
    size_t best = all.size();
    double most = 0.0;
    for (size_t a = 0; a < all.size(); ++a) {
      if (!(lengths[a] > 0.0) || std::find(chosen.begin(), chosen.end(), a) != chosen.end())
        continue;
      const double gain = dot(atoms[a], rest) / lengths[a];
      if (gain > most) {
        most = gain;
        best = a;
      }
    }
    if (best == all.size()) break;
    chosen.push_back(best);
    for (size_t i = 0; i + 1 < chosen.size(); ++i)
      gram[i].push_back(dot(atoms[chosen[i]], atoms[best]));
    std::vector<double>& row = gram.emplace_back();
    for (const size_t c : chosen) row.push_back(dot(atoms[c], atoms[best]));
    right.push_back(dot(atoms[best], wanted));
    weights.push_back(0.0);
    weigh(gram, right, weights);
    rest = wanted;
    for (size_t i = 0; i < chosen.size(); ++i) {
      const auto w = static_cast<float>(weights[i]);
      for (size_t d = 0; d < kDirections; ++d) rest[d] -= w * atoms[chosen[i]][d];
    }
  }

  std::vector<SpotLobe> out;
  double flux = 0.0;
  for (size_t i = 0; i < chosen.size(); ++i) {
    if (!(weights[i] > 0.0)) continue;
    out.push_back(all[chosen[i]]);
    out.back().intensity = static_cast<float>(weights[i]);
    flux += weights[i] * sumOf(atoms[chosen[i]]);
  }
  // All of its light, wherever the fit is a little off.
  const double scale = flux > 0.0 ? sumOf(wanted) / flux : 0.0;
  for (SpotLobe& l : out) l.intensity *= static_cast<float>(scale);
  return out;
}

}  // namespace lamplighter
