#include "renderer/sampling/path_reuse.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

constexpr uint32_t kMostTries = 1000;
// The directions of candidates use dimensions from 1; the decisions use dimensions from this one.
constexpr uint32_t kChanceDimension = 2000;
// Largest number of the light's own surfaces that a ray may pass.
constexpr int kMostParts = 8;
// A vertex is visible if the ray to it ends this close to it, as a fraction of the distance.
constexpr float kSeen = 1e-3f;

// Density of a first step from `start`: per m² at its hit, or per steradian if it hits nothing.
float densityOf(const Departure& start, const PathStep& step) {
  if (!step.hit) return start.density(step.direction);
  const vec3 v = step.position - start.origin;
  const float d2 = glm::dot(v, v);
  if (!(d2 > 0.0f)) return 0.0f;
  const vec3 towards = v / std::sqrt(d2);
  return start.density(towards) * std::max(-glm::dot(step.normal, towards), 0.0f) / d2;
}

vec3 directionTo(const vec3& from, const PathStep& step) {
  return step.hit ? glm::normalize(step.position - from) : step.direction;
}

bool isSeenAt(const vec3& from, const vec3& place, const PathStep& step) {
  return glm::distance(place, step.position) <= kSeen * glm::distance(from, step.position);
}

// Whether only the light itself may be between a point and the hit of a step.
bool sees(const PathWalker& walker, NodeId light, const vec3& from, const PathStep& step,
          int& traced) {
  const vec3 direction = directionTo(from, step);
  vec3 origin = from;
  for (int part = 0; part < kMostParts; ++part) {
    const Hit hit = walker.rays().intersect({origin, 0.0f, direction});
    ++traced;
    if (!hit) return !step.hit;
    const vec3 place = origin + hit.t * direction;
    if (walker.scene().objects[hit.object].node != light)
      return step.hit && hit.object == step.hit.object && isSeenAt(from, place, step);
    origin = place + rayEpsilon(place) * direction;
  }
  return false;
}

}  // namespace

int followStart(const PathWalker& walker, const PathWalker::Source& source, const Departure& before,
                const Departure& now, uint32_t edit, LightPath& path) {
  int traced = 0;
  const uint32_t set = hash4(edit, 0, 0, SampleStreams::following);
  const auto chance = [&](uint32_t i) {
    return walker.numbers().point(source.id, path.index, kChanceDimension + i, set).x;
  };
  PathStep& first = path.steps.front();
  const float p = densityOf(before, first), q = densityOf(now, first);
  if (q > 0.0f && q >= chance(0) * p) {
    const PathStep seen = walker.step(now.origin, directionTo(now.origin, first));
    ++traced;
    const bool isSeen = seen.hit ? first.hit && seen.hit.object == first.hit.object &&
                                       isSeenAt(now.origin, seen.position, first)
                                 : !first.hit;
    if (isSeen) {
      first.origin = seen.origin;
      first.direction = seen.direction;
      first.hit = seen.hit;
      return traced;
    }
  }
  for (uint32_t i = 1;; ++i) {
    const vec2 u = walker.numbers().point(source.id, path.index, i, set);
    const PathStep tried = walker.step(now.origin, walker.directionFrom(now, u));
    ++traced;
    const float old = densityOf(before, tried), fresh = densityOf(now, tried);
    const bool isLacking = chance(i) * fresh < fresh - old ||
                           !sees(walker, source.id.light, before.origin, tried, traced);
    if (!isLacking && i < kMostTries) continue;
    path.steps.assign(1, tried);
    walker.receive(source, path.steps.front());
    return traced + walker.walkOn(source, path, 1);
  }
}

bool isNearly(const LightPath& a, const LightPath& b, float distance) {
  return std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(),
                    [&](const PathStep& s, const PathStep& t) {
                      return s.hit.object == t.hit.object &&
                             glm::distance(s.position, t.position) <= distance &&
                             glm::distance(s.normal, t.normal) <= 1e-3f;
                    });
}

}  // namespace lamplighter
