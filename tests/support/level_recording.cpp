#include "tests/support/level_recording.h"

#include <algorithm>

#include "renderer/raycast/ray_caster.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {
namespace {

// Lengths as shares of the distance to what the camera sees.
constexpr float kLampAhead = 0.5f, kLampAbove = 0.12f, kLampSize = 0.15f;
constexpr float kBoxAhead = 0.6f, kBoxBelow = 0.1f, kBoxSize = 0.1f;
constexpr float kDrag = 0.3f, kMove = 0.2f, kFly = 0.15f;
// The angle by which the camera turns in flight.
constexpr float kTurn = 0.2f;
// The lamp's radiance as a multiple of the picture's mean: so it lights what is below it about as
// brightly as the level is.
constexpr float kBrightness = 70.0f, kLeastRadiance = 1.0f;
// The distance where the camera sees only the sky [m].
constexpr float kFar = 10.0f;

// Of a coarse picture of the reference.
float meanRadiance(const Scene& scene, View view) {
  view.width = 32;
  view.height = 24;
  return luminance(meanOf(renderReference(scene, view, 4, 2)));
}

float distanceSeen(const Scene& scene, const View& view) {
  const RenderScene render = renderSceneOf(scene);
  const RayCaster rays(render);
  std::vector<float> seen;
  for (int y = 1; y < 8; ++y)
    for (int x = 1; x < 8; ++x) {
      const vec3 way = view.rayDirection(static_cast<float>(view.width * x) / 8.0f,
                                         static_cast<float>(view.height * y) / 8.0f);
      const Hit hit = rays.intersect({view.eye, view.znear, way}, Surfaces::seen);
      if (hit) seen.push_back(hit.t);
    }
  if (seen.empty()) return kFar;
  std::ranges::nth_element(seen, seen.begin() + static_cast<long>(seen.size() / 2));
  return seen[seen.size() / 2];
}

}  // namespace

LevelRecording::LevelRecording(Scene level, const View& view) : scene_(std::move(level)) {
  distance_ = distanceSeen(scene_, view);
  first_.view = view;
  first_.radiance = vec3(std::max(kLeastRadiance, kBrightness * meanRadiance(scene_, view)));
  first_.lamp = view.eye + distance_ * (kLampAhead * view.forward() + kLampAbove * view.up() -
                                        0.5f * kDrag * view.right());
  first_.box = view.eye + distance_ * (kBoxAhead * view.forward() - kBoxBelow * view.up() -
                                       0.5f * kMove * view.right());
  lamp_ = addRectangleLight(scene_, first_.lamp, vec2(kLampSize * distance_), first_.radiance);
  const int brown = addMaterial(scene_, vec3(0.6f, 0.3f, 0.2f));
  box_ = addMesh(scene_, boxMesh(vec3(kBoxSize * distance_), brown), first_.box);
}

LevelRecording::State LevelRecording::after(size_t step, int frame) const {
  // How much of a step has happened.
  const auto share = [&](size_t of) {
    if (step != of) return step < of ? 0.0f : 1.0f;
    return static_cast<float>(frame) / static_cast<float>(kSteps[of].frames);
  };
  State state = first_;
  const View& view = first_.view;
  state.lamp += share(1) * kDrag * distance_ * view.right();
  state.box += share(2) * kMove * distance_ * view.right();
  state.radiance *= 1.0f + share(3);
  state.view.eye += share(4) * kFly * distance_ * view.forward();
  state.view.orientation =
      glm::angleAxis(share(4) * kTurn, vec3(0.0f, 1.0f, 0.0f)) * view.orientation;
  return state;
}

void LevelRecording::apply(const State& state, Scene& scene) const {
  Node& lamp = *scene.find(lamp_);
  lamp.local.translation = state.lamp;
  lamp.area->radiance = state.radiance;
  scene.find(box_)->local.translation = state.box;
}

}  // namespace lamplighter::test
