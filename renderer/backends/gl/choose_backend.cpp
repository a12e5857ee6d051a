#include "renderer/backends/gl/choose_backend.h"

#include <algorithm>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/backends/many_lights_kernels.h"

namespace lamplighter {
namespace {

// Similar to a frame of the editor with a fraction of its pixels and lights: the ratio of maps to
// sums is that of 300 lights with 100 refreshed per frame.
constexpr int kVpls = 48, kMapsAFrame = 16, kMapResolution = 64;
constexpr int kWidth = 320, kHeight = 180;
constexpr int kSpheres = 24, kSphereRings = 12;

// A sphere of rings of quads; the winding is outwards.
std::shared_ptr<const Mesh> sphere(float radius) {
  Primitive p;
  constexpr int kColumns = 2 * kSphereRings;
  for (int i = 0; i <= kSphereRings; ++i) {
    for (int j = 0; j <= kColumns; ++j) {
      const float theta = kPi * static_cast<float>(i) / kSphereRings;
      const float phi = 2.0f * kPi * static_cast<float>(j) / kColumns;
      const vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta),
                   std::sin(theta) * std::cos(phi));
      p.positions.push_back(radius * n);
      p.normals.push_back(n);
    }
  }
  for (uint32_t i = 0; i < kSphereRings; ++i) {
    for (uint32_t j = 0; j < kColumns; ++j) {
      const uint32_t a = i * (kColumns + 1) + j, b = a + kColumns + 1;
      p.indices.insert(p.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  auto mesh = std::make_shared<Mesh>();
  mesh->primitives.push_back(std::move(p));
  return mesh;
}

std::shared_ptr<const Mesh> square(float size) {
  Primitive p;
  const float h = 0.5f * size;
  p.positions = {vec3(-h, 0, h), vec3(h, 0, h), vec3(h, 0, -h), vec3(-h, 0, -h)};
  p.normals.assign(4, vec3(0, 1, 0));
  p.indices = {0, 1, 2, 0, 2, 3};
  auto mesh = std::make_shared<Mesh>();
  mesh->primitives.push_back(std::move(p));
  return mesh;
}

// Floor, wall, and a grid of spheres: about 14,000 triangles.
Scene trialScene() {
  Scene scene;
  scene.meshes = {square(12.0f), sphere(0.4f)};
  const auto add = [&](int mesh, const vec3& at) -> Node& {
    Node& node = scene.nodes.emplace_back();
    node.id = scene.nextId++;
    node.mesh = mesh;
    node.local.translation = at;
    return node;
  };
  add(0, vec3(0.0f));
  add(0, vec3(0, 0, -6)).local.rotation = glm::angleAxis(0.5f * kPi, vec3(1, 0, 0));
  for (int i = 0; i < kSpheres; ++i) {
    add(1, vec3(1.5f * static_cast<float>(i % 6) - 3.75f, 0.5f + 0.3f * static_cast<float>(i % 4),
                1.5f * static_cast<float>(i / 6) - 3.0f));
  }
  return scene;
}

std::vector<shared::Vpl> trialVpls() {
  std::vector<shared::Vpl> vpls;
  for (int i = 0; i < kVpls; ++i) {
    const vec3 at(0.5f * static_cast<float>(i % 8) - 1.75f, 4.0f,
                  0.5f * static_cast<float>(i / 8) - 1.5f);
    vpls.push_back({vec4(at, shared::kVplCosine), vec4(0, -1, 0, 0), vec4(1, 0, 0, 1),
                    vec4(1, 1, 1, static_cast<float>(i))});
  }
  return vpls;
}

View trialView() {
  View view;
  view.eye = vec3(0, 3, 8);
  view.orientation = glm::angleAxis(-0.3f, vec3(1, 0, 0));
  view.width = kWidth;
  view.height = kHeight;
  return view;
}

double frameSeconds(Backend& backend, const RenderScene& scene, const RayCaster& rays,
                    const Stopwatch& stopwatch) {
  RenderSceneChanges all;
  all.rebuilt = true;
  backend.setScene(scene, all, rays);
  auto& kernels = backend.kernels<ManyLightsKernels>("many_lights");
  kernels.reserveShadowMaps(kVpls, kMapResolution);
  const std::vector<shared::Vpl> vpls = trialVpls();
  const shared::ShadingParams params{vec4(0.1f, 0.002f, kMapResolution, kVpls),
                                     vec4(1.0f, 0.0f, 0.0f, 0.0f)};
  const auto frame = [&](std::span<const shared::Vpl> maps) {
    kernels.renderShadowMaps(maps);
    backend.renderGBuffer(trialView(), vec2(0.0f));
    kernels.sumVpls(vpls, params, nullptr);
    kernels.compose();
    backend.finish();
  };
  frame(vpls);
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 2; ++i) {
    const double start = stopwatch();
    frame(std::span(vpls).first(kMapsAFrame));
    best = std::min(best, stopwatch() - start);
  }
  return best;
}

}  // namespace

BackendTrial tryBackends(Backend& cpu, Backend& gl, const Stopwatch& stopwatch) {
  RenderScene scene;
  update(scene, trialScene(), SceneChanges::all());
  const RayCaster rays(scene);
  BackendTrial trial;
  trial.cpuSeconds = frameSeconds(cpu, scene, rays, stopwatch);
  trial.glSeconds = frameSeconds(gl, scene, rays, stopwatch);
  return trial;
}

std::unique_ptr<Backend> chooseBackend(const Stopwatch& stopwatch, BackendTrial* trial) {
  auto cpu = makeCpuBackend();
  auto gl = makeGlBackend();
  const BackendTrial result = tryBackends(*cpu, *gl, stopwatch);
  if (trial != nullptr) *trial = result;
  // A new backend, without data and counters of the trial.
  if (result.glSeconds < result.cpuSeconds) return makeGlBackend();
  return makeCpuBackend();
}

}  // namespace lamplighter
