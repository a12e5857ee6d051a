#include "editor/probes/probe_overlay.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "editor/tools/projection.h"

namespace lamplighter {
namespace {

constexpr float kBall = 0.09f, kProp = 0.16f;  // radius, in spacings
constexpr float kLargestBall = 26.0f;          // radius of the ball of a probe [px]
constexpr float kSmallestBall = 1.5f;          // [px]
constexpr float kMark = 2.5f;   // half a side of the mark of one that is not valid [px]
constexpr float kLarge = 5.0f;  // balls of this radius have more facets [px]
constexpr vec4 kInvalid{0.95f, 0.25f, 0.2f, 0.85f};
constexpr vec4 kRim{0.0f, 0.0f, 0.0f, 0.55f};
constexpr float kRimWidth = 1.5f;  // it fades to its outer edge [px]
// All corners together are limited, so that a frame stays fast.
constexpr size_t kMostBalls = 1500;

struct Placed {
  vec2 at{0.0f};
  float distance = 0.0f, radius = 0.0f;  // of the eye; [px]
  size_t probe = 0;
};

// The part of a ball that the eye sees, as rings around its middle.
void addBall(Overlay& overlay, const View& view, const Placed& ball, const vec3& towardsEye,
             const ProbeSh& light, const ProbeLook& look, const vec4& rim = kRim) {
  const vec3 right = glm::normalize(glm::cross(view.orientation * vec3(0, 1, 0), towardsEye));
  const vec3 up = glm::cross(towardsEye, right);
  const bool isLarge = ball.radius >= kLarge;
  const std::vector<float> rings =
      isLarge ? std::vector<float>{0.45f, 0.8f, 1.0f} : std::vector<float>{1.0f};
  const uint32_t sides = isLarge ? 16 : 8;
  OverlayMesh mesh;
  const auto add = [&](float share, uint32_t side) {
    const float angle = 2.0f * kPi * static_cast<float>(side) / static_cast<float>(sides);
    const vec2 d = share * vec2(std::cos(angle), std::sin(angle));
    const float height = std::sqrt(std::max(0.0f, 1.0f - share * share));
    const vec3 normal = d.x * right + d.y * up + height * towardsEye;
    const vec3 radiance = glm::max(irradianceFrom(light, normal), vec3(0.0f)) / kPi;
    mesh.points.push_back(ball.at + ball.radius * vec2(d.x, -d.y));
    mesh.colours.emplace_back(toneMapPixel(radiance, look.exposureEv, look.toneMapper), 1.0f);
  };
  add(0.0f, 0);
  for (const float ring : rings)
    for (uint32_t side = 0; side < sides; ++side) add(ring, side);
  for (uint32_t side = 0; side < sides; ++side) {
    const uint32_t next = (side + 1) % sides;
    mesh.triangles.insert(mesh.triangles.end(), {0, 1 + side, 1 + next});
    for (uint32_t ring = 1; ring < rings.size(); ++ring) {
      const uint32_t inner = 1 + (ring - 1) * sides, outer = inner + sides;
      mesh.triangles.insert(mesh.triangles.end(), {inner + side, outer + side, outer + next});
      mesh.triangles.insert(mesh.triangles.end(), {inner + side, outer + next, inner + next});
    }
  }
  // A thin rim, so that balls show on any picture.
  const auto first = static_cast<uint32_t>(mesh.points.size());
  const float width = (ball.radius + kRimWidth) / ball.radius;
  for (uint32_t side = 0; side < sides; ++side) {
    const vec2 edge = mesh.points[1 + (rings.size() - 1) * sides + side];
    mesh.points.push_back(edge);
    mesh.points.push_back(ball.at + width * (edge - ball.at));
    mesh.colours.insert(mesh.colours.end(), {rim, vec4(vec3(rim), 0.0f)});
    const uint32_t here = first + 2 * side, there = first + 2 * ((side + 1) % sides);
    mesh.triangles.insert(mesh.triangles.end(),
                          {here, here + 1, there + 1, here, there + 1, there});
  }
  overlay.meshes.push_back(std::move(mesh));
}

void addMark(Overlay& overlay, const vec2& at) {
  overlay.meshes.push_back(
      {{at + vec2(0, -kMark), at + vec2(kMark, 0), at + vec2(0, kMark), at + vec2(-kMark, 0)},
       {kInvalid, kInvalid, kInvalid, kInvalid},
       {0, 1, 2, 0, 2, 3}});
}

// In the picture, on the near side of all surfaces.
std::optional<Placed> placedIn(const View& view, const RayCaster& rays, const vec3& position,
                               float radius) {
  const auto at = projectPoint(view, position);
  if (!at || at->x < -kLargestBall || at->y < -kLargestBall ||
      at->x > static_cast<float>(view.width) + kLargestBall ||
      at->y > static_cast<float>(view.height) + kLargestBall)
    return std::nullopt;
  const vec3 way = position - view.eye;
  if (rays.intersect({view.eye, 0.0f, way, 1.0f}, Surfaces::seen)) return std::nullopt;
  return Placed{*at, glm::length(way), radius / metresPerPixel(view, position)};
}

}  // namespace

float propRadius(const LiveProbes& probes) { return kProp * probes.grid().spacing; }

void drawProbes(Overlay& overlay, const View& view, const LiveProbes& probes,
                const RenderScene& scene, const RayCaster& rays, const ProbeLook& look,
                const std::optional<vec3>& prop) {
  ProbeGrid grid = probes.grid();
  markUnlit(scene, probes.light(), grid);
  std::vector<std::optional<Placed>> all(grid.probes.size());
  tbb::parallel_for(size_t{0}, all.size(), [&](size_t i) {
    if (probes.grid().probes[i].isValid() && !probes.hasLight(i)) return;
    all[i] = placedIn(view, rays, grid.probes[i].position, kBall * grid.spacing);
    if (!all[i]) return;
    all[i]->probe = i;
    all[i]->radius = std::clamp(all[i]->radius, kSmallestBall, kLargestBall);
  });
  std::vector<Placed> balls;
  for (const auto& ball : all)
    if (ball) balls.push_back(*ball);
  std::ranges::sort(balls, [](const Placed& a, const Placed& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.probe < b.probe;
  });
  // The nearest ones, from the furthest to the nearest.
  const size_t first = balls.size() > kMostBalls ? balls.size() - kMostBalls : 0;
  for (size_t i = first; i < balls.size(); ++i) {
    const Probe& probe = grid.probes[balls[i].probe];
    if (!probe.isValid()) {
      addMark(overlay, balls[i].at);
      continue;
    }
    addBall(overlay, view, balls[i], glm::normalize(view.eye - probe.position),
            probes.light()[balls[i].probe], look);
  }
  if (!prop) return;
  const auto light = interpolatedLight(grid, probes.light(), *prop);
  const auto ball = placedIn(view, rays, *prop, propRadius(probes));
  if (light && ball && ball->radius > kSmallestBall)
    addBall(overlay, view, *ball, glm::normalize(view.eye - *prop), *light, look, kHoverColour);
}

}  // namespace lamplighter
