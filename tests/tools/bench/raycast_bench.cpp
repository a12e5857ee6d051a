// The cost of rays: millions per second on all threads, coherent and incoherent, and the cost of
// updating the tree when one of many objects moves.
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// A ball of radius 1 with 2·n² triangles, with bumps so that rays leave it in different directions.
std::shared_ptr<const Mesh> ball(uint32_t n) {
  Primitive p;
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; j <= n; ++j) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(n);
      const float phi = 2.0f * kPi * static_cast<float>(j) / static_cast<float>(n);
      const vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta),
                   std::sin(theta) * std::sin(phi));
      p.positions.push_back(d * (1.0f + 0.05f * std::sin(9.0f * theta) * std::sin(8.0f * phi)));
      p.normals.push_back(d);
    }
  }
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      const uint32_t a = i * (n + 1) + j, b = a + n + 1;
      p.indices.insert(p.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
    }
  }
  auto mesh = std::make_shared<Mesh>();
  mesh->primitives.push_back(std::move(p));
  return mesh;
}

// 64 balls of 1,568 triangles each over a floor, under a sky: 100,354 triangles.
struct World {
  Scene scene;
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  std::vector<Ray> primary, bounced;

  World() {
    Primitive floor;
    floor.positions = {{-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20}};
    floor.normals.assign(4, vec3(0, 1, 0));
    floor.indices = {0, 1, 2, 0, 2, 3};
    auto mesh = std::make_shared<Mesh>();
    mesh->primitives.push_back(floor);
    scene.meshes = {ball(28), mesh};
    for (int i = 0; i < 65; ++i) {
      Node& node = scene.nodes.emplace_back();
      node.id = scene.nextId++;
      node.mesh = i == 64 ? 1 : 0;
      if (i < 64)
        node.local.translation = vec3(3.0f * static_cast<float>(i % 8) - 10.5f, 1.0f,
                                      3.0f * static_cast<float>(i / 8) - 10.5f);
    }
    update(render, scene, SceneChanges::all());
    rays = std::make_unique<RayCaster>(render);
    castOnce();
  }

  // The primary rays of a picture in 4×2 blocks, and one cosine-distributed ray from each hit
  // point.
  void castOnce() {
    View view;
    view.eye = vec3(0, 9, 18);
    view.orientation = glm::angleAxis(-0.45f, vec3(1, 0, 0));
    for (int y = 0; y < view.height; y += 2) {
      for (int x = 0; x < view.width; x += 4) {
        for (int i = 0; i < 8; ++i) {
          const vec3 d = view.rayDirection(static_cast<float>(x + i % 4) + 0.5f,
                                           static_cast<float>(y + i / 4) + 0.5f);
          primary.push_back({view.eye, 0.0f, d});
        }
      }
    }
    for (uint32_t i = 0; i < primary.size(); ++i) {
      const Hit hit = rays->intersect(primary[i]);
      if (!hit) continue;
      const Surface at = surfaceAt(render, hit.object, hit.triangle, hit.u, hit.v);
      const vec3 d = Frame(at.geometricNormal).toWorld(sampleCosineHemisphere(sobol2(i, 7)));
      bounced.push_back({at.position + rayEpsilon(at.position) * at.geometricNormal, 0.0f, d});
    }
    bounced.resize(bounced.size() / 8 * 8);
  }
};

World& world() {
  static World instance;
  return instance;
}

enum class Query { one, eight, occluded };

void castRays(benchmark::State& state, const std::vector<Ray>& rays, Query query) {
  const RayCaster& caster = *world().rays;
  std::vector<Hit> hits(rays.size());
  for (auto _ : state) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, rays.size() / 8, 128), [&](const auto& range) {
      for (size_t block = range.begin(); block < range.end(); ++block) {
        const size_t first = 8 * block;
        if (query == Query::eight) {
          caster.intersect8(std::span<const Ray, 8>(&rays[first], 8),
                            std::span<Hit, 8>(&hits[first], 8));
          continue;
        }
        for (size_t i = first; i < first + 8; ++i) {
          if (query == Query::one) {
            hits[i] = caster.intersect(rays[i]);
          } else {
            hits[i].triangle = caster.occluded(rays[i]) ? 1 : 0;
          }
        }
      }
    });
    benchmark::DoNotOptimize(hits.data());
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) *
                          static_cast<int64_t>(rays.size()));
}

void coherentRays(benchmark::State& state) {
  castRays(state, world().primary, static_cast<Query>(state.range(0)));
}
void incoherentRays(benchmark::State& state) {
  castRays(state, world().bounced, static_cast<Query>(state.range(0)));
}
// 0: one by one, 1: eight at a time, 2: occlusion only.
BENCHMARK(coherentRays)->DenseRange(0, 2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(incoherentRays)->DenseRange(0, 2)->UseRealTime()->Unit(benchmark::kMillisecond);

// Embree alone with the same rays: one static tree over all triangles, rays and hits prepared in
// Embree's layout. 0: fastest; 1: also robust; 2: with the coherent flag.
void bareRays(benchmark::State& state) {
  const World& w = world();
  RTCDevice device = rtcNewDevice("isa=avx2");
  RTCScene scene = rtcNewScene(device);
  if (state.range(0) == 1) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  std::copy(w.render.positions.begin(), w.render.positions.end(),
            static_cast<vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                       RTC_FORMAT_FLOAT3, sizeof(vec3),
                                                       w.render.positions.size())));
  std::copy(w.render.indices.begin(), w.render.indices.end(),
            static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                           RTC_FORMAT_UINT3, 3 * sizeof(uint32_t),
                                                           w.render.triangleCount())));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  std::vector<RTCRayHit8> fresh(w.primary.size() / 8), rays(fresh.size());
  for (size_t i = 0; i < 8 * fresh.size(); ++i) {
    const Ray& from = w.primary[i];
    RTCRayHit8& to = fresh[i / 8];
    const size_t lane = i % 8;
    to.ray.org_x[lane] = from.origin.x;
    to.ray.org_y[lane] = from.origin.y;
    to.ray.org_z[lane] = from.origin.z;
    to.ray.dir_x[lane] = from.direction.x;
    to.ray.dir_y[lane] = from.direction.y;
    to.ray.dir_z[lane] = from.direction.z;
    to.ray.tfar[lane] = from.tFar;
    to.ray.mask[lane] = 0xffffffffu;
    to.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  }
  alignas(32) const int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (state.range(0) == 2) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (auto _ : state) {
    state.PauseTiming();
    rays = fresh;
    state.ResumeTiming();
    for (RTCRayHit8& packet : rays) rtcIntersect8(valid, scene, &context, &packet);
  }
  state.SetItemsProcessed(static_cast<int64_t>(8 * state.iterations() * rays.size()));
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}
BENCHMARK(bareRays)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

void ownRays(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  castRays(state, world().primary, Query::eight);
}
BENCHMARK(ownRays)->Unit(benchmark::kMillisecond);

void buildTree(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(RayCaster(world().render).occluded({}));
}
BENCHMARK(buildTree)->UseRealTime()->Unit(benchmark::kMillisecond);

void moveOneOf65Objects(benchmark::State& state) {
  World& w = world();
  float x = 0.0f;
  for (auto _ : state) {
    state.PauseTiming();
    Scene moved = w.scene;
    moved.nodes[20].local.translation.x += (x = 0.5f - x);
    const RenderSceneChanges changes = update(w.render, moved, compare(w.scene, moved));
    w.scene = std::move(moved);
    state.ResumeTiming();
    w.rays->update(changes);
  }
}
BENCHMARK(moveOneOf65Objects)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamplighter
