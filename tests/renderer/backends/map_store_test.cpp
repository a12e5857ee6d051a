// Shadow maps that are kept between edits, and which of their parts change.
#include "renderer/backends/cpu/shadow_maps/map_store.h"

#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "shaders/shared/octahedral.h"
#include "shaders/shared/vpl_shading.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

enum class Kind {
  rasterised,
  traced
};  // how most triangles get into the maps: rasterised or by rays

// A room with lights of all kinds and objects that move.
class Room {
 public:
  Room(Kind kind, uint32_t seed) : random_(seed) {
    scene_ = test::loadAsset("pillar_room");
    // More triangles than the store rasterises individually.
    for (int i = 0; kind == Kind::traced && i < 100; ++i)
      test::addMesh(
          scene_, test::boxMesh(vec3(0.1f)),
          vec3(0.3f * static_cast<float>(i % 10), 0.2f, 0.3f * static_cast<float>(i / 10)));
    update(world, scene_, SceneChanges::all());
    rays = std::make_unique<RayCaster>(world);
    lights = test::lightsOf(world, 24);
    for (int i = 0; i < 3; ++i) {
      const float angle = 2.0f * static_cast<float>(i);
      shared::Vpl sun =
          test::makeVpl(world.bounds.centre(), vec3(std::cos(angle), 1.0f, std::sin(angle)),
                        shared::kVplDirectional, angle);
      sun.normal.w = 1.1f * world.bounds.radius();
      sun.tangent.w = (0.3f + 0.3f * static_cast<float>(i)) * world.bounds.radius();
      lights.push_back(sun);
    }
    for (size_t i = 0; i < lights.size(); ++i) lights[i].slot = static_cast<int>(i);
  }

  RenderSceneChanges moveSomething() {
    const Scene before = scene_;
    const char* const names[] = {"mover", "mover", "ceiling light", "pillar 1"};
    const std::string name = names[random_() % 4];
    std::uniform_real_distribution<float> step(-0.3f, 0.3f);
    for (Node& node : scene_.nodes)
      if (node.name == name)
        node.local.translation += vec3(step(random_), 0.2f * step(random_), step(random_));
    RenderSceneChanges changes = update(world, scene_, compare(before, scene_));
    rays->update(changes);
    return changes;
  }

  uint32_t number() { return static_cast<uint32_t>(random_()); }
  float number(float least, float most) {
    return std::uniform_real_distribution<float>(least, most)(random_);
  }

  RenderScene world;
  std::unique_ptr<RayCaster> rays;
  std::vector<shared::Vpl> lights;

 private:
  Scene scene_;
  std::mt19937 random_;
};

uint64_t render(cpu::MapStore& store, const Room& room, std::span<const shared::Vpl> lights,
                std::vector<cpu::ShadowMapDiff>& changes, MapSize size = MapSize::coarse) {
  changes.assign(lights.size(), {});
  return store.render(room.world, *room.rays, lights, size, changes);
}

std::vector<float> copyOf(std::span<const float> map) { return {map.begin(), map.end()}; }

class KeptMaps : public testing::TestWithParam<std::tuple<Kind, int, uint32_t>> {};

// After one or several moves, only the affected parts of a map are rendered again. The result has
// the same bits as a newly rendered map and costs fewer rays.
TEST_P(KeptMaps, EqualNewlyRenderedOnes) {
  const auto [kind, resolution, seed] = GetParam();
  Room room(kind, seed);
  const int slots = static_cast<int>(room.lights.size());
  cpu::MapStore kept;
  kept.reserve(slots, {resolution, slots}, {});
  std::vector<cpu::ShadowMapDiff> changes;
  render(kept, room, room.lights, changes);
  for (const cpu::ShadowMapDiff& change : changes)
    EXPECT_EQ(change.extent, cpu::ShadowMapDiff::Extent::everything);
  uint64_t rays = 0, freshRays = 0;
  size_t parts = 0;
  for (int step = 0; step < 12; ++step) {
    kept.castersMove(room.world, room.moveSomething());
    std::vector<shared::Vpl> some;
    for (const shared::Vpl& light : room.lights)
      if (room.number() % 3 != 0) some.push_back(light);
    std::vector<std::vector<float>> before;
    for (const shared::Vpl& light : some) before.push_back(copyOf(kept.map(light.slot)));
    rays += render(kept, room, some, changes);
    cpu::MapStore fresh;
    fresh.reserve(slots, {resolution, slots}, {});
    std::vector<cpu::ShadowMapDiff> freshChanges;
    freshRays += render(fresh, room, some, freshChanges);
    for (size_t i = 0; i < some.size(); ++i) {
      const int slot = some[i].slot;
      const std::vector<float> map = copyOf(kept.map(slot));
      ASSERT_EQ(map, copyOf(fresh.map(slot))) << "slot " << slot << ", step " << step;
      ASSERT_EQ(map == before[i], changes[i].extent == cpu::ShadowMapDiff::Extent::nothing);
      parts += changes[i].extent == cpu::ShadowMapDiff::Extent::part ? 1 : 0;
    }
  }
  std::cout << 100 * rays / freshRays << "% of the rays, " << parts << " changed in part\n";
  // Rays near the moved object are cast in both cases.
  EXPECT_LT(rays, kind == Kind::rasterised ? freshRays : freshRays / 2);
  EXPECT_GT(parts, 20u);
}
INSTANTIATE_TEST_SUITE_P(Rooms, KeptMaps,
                         testing::Combine(testing::Values(Kind::rasterised, Kind::traced),
                                          testing::Values(16, 64, 96), testing::Range(1u, 4u)));

// At this resolution a map cannot be updated in parts.
TEST(KeptMaps, OfAnyResolutionEqualNewlyRenderedOnes) {
  Room room(Kind::rasterised, 5);
  const int slots = static_cast<int>(room.lights.size()), resolution = 18;
  cpu::MapStore kept, fresh;
  std::vector<cpu::ShadowMapDiff> changes;
  kept.reserve(slots, {resolution, slots}, {});
  render(kept, room, room.lights, changes);
  kept.castersMove(room.world, room.moveSomething());
  render(kept, room, room.lights, changes);
  fresh.reserve(slots, {resolution, slots}, {});
  render(fresh, room, room.lights, changes);
  for (int slot = 0; slot < slots; ++slot)
    EXPECT_EQ(copyOf(kept.map(slot)), copyOf(fresh.map(slot)));
}

// A light that moved, changed materials, and more moves than the store remembers.
TEST(KeptMaps, DiscardOutdatedMaps) {
  Room room(Kind::rasterised, 6);
  const int slots = static_cast<int>(room.lights.size()), resolution = 32;
  cpu::MapStore kept;
  std::vector<cpu::ShadowMapDiff> changes;
  kept.reserve(slots, {resolution, slots}, {});
  render(kept, room, room.lights, changes);
  const auto expectEqualsNew = [&](const char* what) {
    cpu::MapStore fresh;
    fresh.reserve(slots, {resolution, slots}, {});
    render(fresh, room, room.lights, changes);
    render(kept, room, room.lights, changes);
    for (int slot = 0; slot < slots; ++slot)
      EXPECT_EQ(copyOf(kept.map(slot)), copyOf(fresh.map(slot))) << what;
  };
  for (shared::Vpl& light : room.lights) light.position += vec4(0.1f, 0.0f, 0.1f, 0.0f);
  render(kept, room, room.lights, changes);
  for (const cpu::ShadowMapDiff& change : changes)
    EXPECT_EQ(change.extent, cpu::ShadowMapDiff::Extent::everything);
  expectEqualsNew("moved lights");
  for (int i = 0; i < 2500; ++i) kept.castersMove(room.world, room.moveSomething());
  expectEqualsNew("many moves");
  for (Material& material : room.world.materials) material.transmission = 1.0f;
  RenderSceneChanges clear;
  clear.materials = true;
  room.rays->update(clear);
  kept.castersChange();
  expectEqualsNew("transparent materials");
}

// Lights get maps of both sizes alternately while objects move.
TEST(KeptMaps, OfTwoSizesEqualNewlyRenderedOnes) {
  for (const Kind kind : {Kind::rasterised, Kind::traced}) {
    Room room(kind, 8);
    const int slots = static_cast<int>(room.lights.size());
    const MapRoom coarse{16, slots}, fine{64, slots};
    cpu::MapStore kept;
    kept.reserve(slots, coarse, fine);
    std::vector<cpu::ShadowMapDiff> changes;
    render(kept, room, room.lights, changes);
    std::vector<MapSize> sizes(room.lights.size(), MapSize::coarse);
    for (int step = 0; step < 12; ++step) {
      kept.castersMove(room.world, room.moveSomething());
      for (const MapSize size : {MapSize::coarse, MapSize::fine}) {
        std::vector<shared::Vpl> some;
        for (const shared::Vpl& light : room.lights)
          if (room.number() % 2 != 0) some.push_back(light);
        render(kept, room, some, changes, size);
        cpu::MapStore fresh;
        fresh.reserve(slots, coarse, fine);
        std::vector<cpu::ShadowMapDiff> freshChanges;
        render(fresh, room, some, freshChanges, size);
        const int resolution = size == MapSize::coarse ? 16 : 64;
        for (size_t i = 0; i < some.size(); ++i) {
          const int slot = some[i].slot;
          MapSize& was = sizes[static_cast<size_t>(slot)];
          ASSERT_EQ(kept.resolution(slot), resolution);
          ASSERT_EQ(copyOf(kept.map(slot)), copyOf(fresh.map(slot))) << "step " << step;
          if (was != size) {
            ASSERT_EQ(changes[i].extent, cpu::ShadowMapDiff::Extent::everything);
          }
          was = size;
        }
      }
      const auto isFine = std::count(sizes.begin(), sizes.end(), MapSize::fine);
      EXPECT_EQ(kept.held(), room.lights.size());
      EXPECT_EQ(kept.bytes(), 4 * (isFine * 64 * 64 + (std::ssize(sizes) - isFine) * 16 * 16));
    }
    for (int slot = 0; slot < slots; ++slot) kept.drop(slot);
    EXPECT_EQ(kept.bytes(), 0u);
    // For each size, no more maps than reserved.
    kept.reserve(slots, coarse, {64, 1});
    render(kept, room, room.lights, changes);
    EXPECT_THROW(render(kept, room, room.lights, changes, MapSize::fine), std::length_error);
  }
}

// Every point whose look-up reads a changed texel is reported as reached by the change.
TEST(ShadowMapDiff, ReachesEveryPointThatReadsAChangedTexel) {
  constexpr int kPoints = 4000;
  for (const int resolution : {16, 64, 256}) {
    Room room(Kind::rasterised, 7);
    const int slots = static_cast<int>(room.lights.size());
    cpu::MapStore store;
    store.reserve(slots, {resolution, slots}, {});
    std::vector<cpu::ShadowMapDiff> changes;
    render(store, room, room.lights, changes);
    size_t reached = 0, asked = 0, lookedUp = 0;
    for (int step = 0; step < 6; ++step) {
      std::vector<std::vector<float>> before;
      for (int slot = 0; slot < slots; ++slot) before.push_back(copyOf(store.map(slot)));
      store.castersMove(room.world, room.moveSomething());
      render(store, room, room.lights, changes);
      std::vector<vec3> points;
      cpu::PlaceSpheres spheres;
      spheres.resize(kPoints);
      for (size_t i = 0; i < kPoints; ++i) {
        const Bounds& box = room.world.bounds;
        vec3 p, away;
        for (int c = 0; c < 3; ++c) {
          p[c] = room.number(box.min[c], box.max[c]);
          away[c] = room.number(-0.2f, 0.2f);
        }
        points.push_back(p);
        spheres.set(i, p + away, glm::length(away));
      }
      for (size_t k = 0; k < room.lights.size(); ++k) {
        if (changes[k].extent == cpu::ShadowMapDiff::Extent::everything) continue;
        const shared::Vpl& vpl = room.lights[k];
        const std::span<const float> now = store.map(static_cast<int>(k));
        std::vector<uint8_t> isReached;
        spheres.findReached(cpu::makeLightRecord(vpl, now.data(), resolution), changes[k],
                            isReached);
        for (size_t i = 0; i < kPoints; ++i) {
          const vec3 q = shared::vplToLight(vpl, points[i] - vec3(vpl.position));
          const bool isParallel = vpl.position.w == shared::kVplDirectional;
          if (!isParallel && q.z <= 0.0f) continue;
          const vec2 s =
              isParallel ? shared::directionalEncode(vpl, q) : shared::octahedralEncode(q);
          if (std::abs(s.x) >= 1.0f || std::abs(s.y) >= 1.0f) continue;
          const auto side = static_cast<size_t>(resolution);
          const vec2 texel = shared::shadowTexel(s, static_cast<float>(resolution));
          const size_t at = static_cast<size_t>(texel.y) * side + static_cast<size_t>(texel.x);
          ++asked;
          reached += isReached[i];
          if (before[k][at] == now[at]) continue;
          ++lookedUp;
          ASSERT_EQ(isReached[i], 1) << "light " << k << ", point " << i;
        }
      }
    }
    std::cout << resolution << "²: of " << asked << " points " << lookedUp
              << " look up a change, and " << reached << " are in reach\n";
    EXPECT_GT(lookedUp, 100u);
    EXPECT_LT(reached, asked / 3);
  }
}

}  // namespace
}  // namespace lamplighter
