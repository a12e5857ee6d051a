#include "renderer/scene/ies/ies_lobes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace lamplighter {

namespace {

constexpr size_t kDirections = 4096;
constexpr int kSweeps = 60;
// Stop when the remaining fraction of the energy is below this: more lobes do not justify their
// shadow maps.
constexpr double kEnough = 2e-4;

// Directions uniform on the sphere, with equal solid angles: a Fibonacci spiral (Swinbank and
// Purser, "Fibonacci grids", 2006).
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

// The candidate lobes: hemispheres, and cones of several widths and falloffs around axes in all
// directions.
std::vector<SpotLobe> dictionary() {
  std::vector<SpotLobe> out;
  // Not dark at the horizon: together they approximate a cosine, too.
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

// Solves min |Σ w a − f|² with w ≥ 0 by coordinate descent on the normal equations.
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

// A candidate lobe, sampled at the directions; dark directions are omitted.
struct Atom {
  std::vector<uint16_t> where;  // ascending
  std::vector<float> value;
  double length = 0.0;
};

// Sums always run over ascending directions: bit-equal to sums that include the zeros.
double dot(const Atom& a, const std::vector<float>& b) {
  const uint16_t* where = a.where.data();
  const float *value = a.value.data(), *with = b.data();
  double sum = 0.0;
  for (size_t i = 0, n = a.where.size(); i < n; ++i)
    sum += static_cast<double>(value[i]) * static_cast<double>(with[where[i]]);
  return sum;
}

double dot(const std::vector<float>& a, const std::vector<float>& b) {
  const float *left = a.data(), *right = b.data();
  double sum = 0.0;
  for (size_t i = 0, n = a.size(); i < n; ++i)
    sum += static_cast<double>(left[i]) * static_cast<double>(right[i]);
  return sum;
}

void addTimes(float w, const Atom& a, std::vector<float>& sum) {
  const uint16_t* where = a.where.data();
  const float* value = a.value.data();
  float* out = sum.data();
  for (size_t i = 0, n = a.where.size(); i < n; ++i) out[where[i]] += w * value[i];
}

// Several atoms interleaved, so that their sums, each in its order, are independent and hide
// latency.
constexpr size_t kSide = 8;
struct Bundle {
  std::array<size_t, kSide> atoms{};
  size_t count = 0;             // of those
  std::vector<uint16_t> where;  // interleaved from kSide atoms; value 0 after an atom's end
  std::vector<float> value;
};

// The candidate lobes and their values: the same for every profile.
struct Dictionary {
  std::vector<vec3> directions = directionsOfSphere();
  std::vector<SpotLobe> lobes = dictionary();
  std::vector<Atom> atoms;
  std::vector<Bundle> bundles;

  Dictionary() {
    std::vector<size_t> byLength;
    for (const SpotLobe& l : lobes) {
      byLength.push_back(atoms.size());
      Atom& atom = atoms.emplace_back();
      double square = 0.0;
      for (size_t i = 0; i < kDirections; ++i) {
        const float v = l.at(directions[i]);
        if (v == 0.0f) continue;
        atom.where.push_back(static_cast<uint16_t>(i));
        atom.value.push_back(v);
        square += static_cast<double>(v) * static_cast<double>(v);
      }
      atom.length = std::sqrt(square);
    }
    std::stable_sort(byLength.begin(), byLength.end(), [&](size_t a, size_t b) {
      return atoms[a].where.size() > atoms[b].where.size();
    });
    for (size_t first = 0; first < byLength.size(); first += kSide) {
      Bundle& bundle = bundles.emplace_back();
      const size_t longest = atoms[byLength[first]].where.size();
      bundle.where.resize(longest * kSide);
      bundle.value.resize(longest * kSide);
      for (; bundle.count < std::min(kSide, byLength.size() - first); ++bundle.count) {
        const size_t a = bundle.atoms[bundle.count] = byLength[first + bundle.count];
        for (size_t i = 0; i < atoms[a].where.size(); ++i) {
          bundle.where[i * kSide + bundle.count] = atoms[a].where[i];
          bundle.value[i * kSide + bundle.count] = atoms[a].value[i];
        }
      }
    }
  }

  // Computes dot(atoms[a], with) for each atom.
  void dots(const std::vector<float>& with, std::vector<double>& out) const {
    const std::vector<double> wide(with.begin(), with.end());
    out.resize(atoms.size());
    for (const Bundle& bundle : bundles) {
      double sums[kSide] = {};
      const uint16_t* where = bundle.where.data();
      const float* value = bundle.value.data();
      const double* by = wide.data();
      for (size_t i = 0, n = bundle.where.size(); i < n; i += kSide) {
        for (size_t s = 0; s < kSide; ++s)
          sums[s] += static_cast<double>(value[i + s]) * by[where[i + s]];
      }
      for (size_t s = 0; s < bundle.count; ++s) out[bundle.atoms[s]] = sums[s];
    }
  }
};

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
  static const Dictionary kAll;
  std::vector<float> wanted(kDirections);
  for (size_t i = 0; i < kDirections; ++i) wanted[i] = intensity(kAll.directions[i]);
  const double energy = dot(wanted, wanted);
  std::vector<size_t> chosen;
  std::vector<std::vector<double>> gram;
  std::vector<double> right, weights, gains;
  std::vector<float> rest = wanted;
  while (chosen.size() < kMostLobes && dot(rest, rest) > kEnough * energy) {
    kAll.dots(rest, gains);
    size_t best = kAll.atoms.size();
    double most = 0.0;
    for (size_t a = 0; a < kAll.atoms.size(); ++a) {
      const double length = kAll.atoms[a].length;
      if (!(length > 0.0) || std::find(chosen.begin(), chosen.end(), a) != chosen.end()) continue;
      const double gain = gains[a] / length;
      if (gain > most) {
        most = gain;
        best = a;
      }
    }
    if (best == kAll.atoms.size()) break;
    chosen.push_back(best);
    std::vector<float> whole(kDirections);
    addTimes(1.0f, kAll.atoms[best], whole);
    for (size_t i = 0; i + 1 < chosen.size(); ++i)
      gram[i].push_back(dot(kAll.atoms[chosen[i]], whole));
    std::vector<double>& row = gram.emplace_back();
    for (const size_t c : chosen) row.push_back(dot(kAll.atoms[c], whole));
    right.push_back(dot(kAll.atoms[best], wanted));
    weights.push_back(0.0);
    weigh(gram, right, weights);
    rest = wanted;
    for (size_t i = 0; i < chosen.size(); ++i)
      addTimes(-static_cast<float>(weights[i]), kAll.atoms[chosen[i]], rest);
  }

  std::vector<SpotLobe> out;
  double flux = 0.0;
  for (size_t i = 0; i < chosen.size(); ++i) {
    if (!(weights[i] > 0.0)) continue;
    out.push_back(kAll.lobes[chosen[i]]);
    out.back().intensity = static_cast<float>(weights[i]);
    flux += weights[i] * sumOf(kAll.atoms[chosen[i]].value);
  }
  // Scales the result so that its total flux is exact.
  const double scale = flux > 0.0 ? sumOf(wanted) / flux : 0.0;
  for (SpotLobe& l : out) l.intensity *= static_cast<float>(scale);
  return out;
}

}  // namespace lamplighter
