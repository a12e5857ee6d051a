#include "editor/debug_views/vpl_overlay.h"

#include <algorithm>
#include <cmath>

#include "editor/tools/projection.h"
#include "renderer/image/tone_map.h"
#include "renderer/scene/scene.h"

namespace lamplighter {
namespace {

constexpr float kRadius = 4.0f;     // radius of a mark [px]
constexpr float kPickReach = 8.0f;  // largest distance of the pointer from a mark [px]
constexpr float kNormal = 16.0f;    // length of the line along the normal [px]
constexpr vec3 kWaiting{1.0f, 0.45f, 0.25f};
constexpr vec3 kChosen{1.0f, 1.0f, 1.0f};

// Light samples lie on surfaces, so a hit only slightly nearer does not hide them.
bool isSeen(const View& view, const RayCaster& rays, const vec3& p) {
  const vec3 way = p - view.eye;
  constexpr float kNearlyThere = 0.998f;
  return !rays.intersect({view.eye, 0.0f, way, kNearlyThere}, Surfaces::seen);
}

float brightest(const vec3& c) { return std::max({c.r, c.g, c.b}); }

// The hue of the light with its brightness relative to `most`, the brightest, down to 1/10000. One
// sample of a narrow spot can be brighter than each of a panel's hundred samples by that factor.
vec3 colourOf(const vec3& intensity, float most) {
  constexpr float kDecades = 4.0f, kDarkest = 0.5f;
  const float own = std::max(brightest(intensity), 1e-20f);
  const float share = 1.0f + std::log10(own / std::max(most, 1e-20f)) / kDecades;
  const float value = glm::mix(kDarkest, 1.0f, std::clamp(share, 0.0f, 1.0f));
  vec3 colour;
  for (int c = 0; c < 3; ++c) colour[c] = value * encodeSrgb(intensity[c] / own);
  return colour;
}

// Parallel light has no position. Its mark is the point where the centre line of its square first
// hits the level.
vec3 placeOf(const shared::Vpl& vpl, const RayCaster& rays) {
  const vec3 position(vpl.position), towards(vpl.normal);
  if (vpl.position.w != shared::kVplDirectional) return position;
  const vec3 start = position + vpl.normal.w * towards;  // outside the level
  const Hit hit = rays.intersect({start, 0.0f, -towards});
  return hit ? start - hit.t * towards : position;
}

// The first corner is above the centre, rotated by `turn`, a fraction of the angle between two
// corners.
OverlayShape polygon(const vec2& centre, float radius, int corners, const vec3& colour, float alpha,
                     float turn = 0.0f) {
  OverlayShape shape{{}, true, false, vec4(colour, alpha), 1.5f};
  for (int i = 0; i < corners; ++i) {
    const float a = 2.0f * kPi * (static_cast<float>(i) + turn) / static_cast<float>(corners);
    shape.points.push_back(centre + radius * vec2(std::sin(a), -std::cos(a)));
  }
  return shape;
}

void drawPoints(Overlay& overlay, const View& view, std::span<const InspectedPoint> points,
                const RayCaster& rays) {
  constexpr vec3 kPoint{0.55f, 0.8f, 1.0f};
  for (const InspectedPoint& point : points) {
    const auto at = projectPoint(view, point.position);
    if (!at) continue;
    const float alpha = isSeen(view, rays, point.position) ? 1.0f : 0.22f;
    const vec3& colour = point.isStale ? kWaiting : kPoint;
    overlay.shapes.push_back(polygon(*at, kRadius, 3, colour, alpha));
    if (point.normal == vec3(0.0f)) continue;
    const vec3 tip = point.position + kNormal * metresPerPixel(view, point.position) * point.normal;
    addLine(overlay, view, point.position, tip, vec4(colour, alpha), 1.5f);
  }
}

}  // namespace

void drawVpls(Overlay& overlay, const View& view, const Inspection& inspection,
              const RayCaster& rays, int chosen) {
  if (inspection.points) drawPoints(overlay, view, inspection.points(), rays);
  // Direct and indirect samples are scaled separately; otherwise all bounces would be black.
  float most[2] = {0.0f, 0.0f};
  for (const LightSample& light : inspection.lights) {
    float& m = most[light.id.bounce == 0 ? 0 : 1];
    m = std::max(m, brightest(light.vpl.intensity));
  }
  for (size_t i = 0; i < inspection.lights.size(); ++i) {
    const LightSample& light = inspection.lights[i];
    const vec3 position = placeOf(light.vpl, rays), normal(light.vpl.normal);
    const auto at = projectPoint(view, position);
    if (!at) continue;
    const bool isDirect = light.id.bounce == 0;
    const bool isChosen = static_cast<int>(i) == chosen;
    const float alpha = isChosen || isSeen(view, rays, position) ? 1.0f : 0.22f;
    const vec3 colour = colourOf(light.vpl.intensity, most[isDirect ? 0 : 1]);

    // A dark line below the bright one makes it visible on any picture.
    const vec3 tip = position + kNormal * metresPerPixel(view, position) * normal;
    addLine(overlay, view, position, tip, vec4(vec3(0.0f), 0.6f * alpha), 4.0f);
    addLine(overlay, view, position, tip, vec4(colour, alpha), 2.0f);
    const bool isParallel = light.vpl.position.w == shared::kVplDirectional;
    const int corners = isDirect && !isParallel ? 12 : 4;
    const float radius = corners == 12 ? kRadius : 1.15f * kRadius;
    const float turn = isParallel ? 0.5f : 0.0f;
    if (light.isLive) {
      OverlayShape disc = polygon(*at, radius, corners, colour, alpha, turn);
      disc.filled = true;
      overlay.shapes.push_back(disc);
    }
    overlay.shapes.push_back(
        polygon(*at, radius, corners, light.isLive ? vec3(0.0f) : colour, 0.7f * alpha, turn));
    if (light.isStale) overlay.shapes.push_back(polygon(*at, 1.7f * kRadius, 16, kWaiting, alpha));
    if (isChosen) {
      OverlayShape ring = polygon(*at, 2.5f * kRadius, 20, kChosen, 1.0f);
      ring.thickness = 2.0f;
      overlay.shapes.push_back(ring);
    }
  }
}

int pickVpl(const View& view, const Inspection& inspection, const RayCaster& rays,
            const vec2& pointer) {
  int best = kNone;
  bool bestIsSeen = false;
  float nearest = kPickReach;
  for (size_t i = 0; i < inspection.lights.size(); ++i) {
    const vec3 position = placeOf(inspection.lights[i].vpl, rays);
    const auto at = projectPoint(view, position);
    if (!at) continue;
    const float distance = glm::length(*at - pointer);
    if (distance > kPickReach) continue;
    const bool seen = isSeen(view, rays, position);
    if (seen < bestIsSeen || (seen == bestIsSeen && distance >= nearest)) continue;
    best = static_cast<int>(i);
    bestIsSeen = seen;
    nearest = distance;
  }
  return best;
}

}  // namespace lamplighter
