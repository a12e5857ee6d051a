// Shadow maps that are kept from edit to edit, and what of them changes.
#include "renderer/backends/cpu/shadow_maps/map_store.h"

#include <filesystem>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "renderer/scene/gltf/gltf_io.h"
#include "shaders/shared/octahedral.h"
#include "shaders/shared/vpl_shading.h"
#include "tests/support/folders.h"
#include "tests/support/lit_scene.h"
#include "tests/support/room_lights.h"
#include "tests/support/scenes.h"

namespace lamplighter {
namespace {

enum class Kind { drawn, traced };  // how maps are made, for the most part

// A room with lights of all kinds, in which things move.
class Room {
 public:
  Room(Kind kind, uint32_t seed) : random_(seed) {
    scene_ = loadGltf(test::sourceFolder() / "assets/scenes/pillar_room.gltf").scene;
    // More triangles than are drawn one by one.
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

// Only what sees what moved is rendered anew, after one move or several; it has the bits of a map
// made from nothing, and costs less.
TEST_P(KeptMaps, AreThoseMadeFromNothing) {
  const auto [kind, resolution, seed] = GetParam();
  Room room(kind, seed);
  const int slots = static_cast<int>(room.lights.size());
  cpu::MapStore kept;
  kept.reserve(slots, {resolution, slots}, {});
  std::vector<cpu::ShadowMapDiff> changes;
  render(kept, room, room.lights, changes);
  for (const cpu::ShadowMapDiff& change : changes)
    EXPECT_EQ(change.extent, cpu::ShadowMapDiff::Extent::everything);
  uint64_t rays = 0, raysAnew = 0;
  size_t parts = 0;
  for (int step = 0; step < 12; ++step) {
    kept.castersMove(room.world, room.moveSomething());
    std::vector<shared::Vpl> some;
    for (const shared::Vpl& light : room.lights)
      if (room.number() % 3 != 0) some.push_back(light);
    std::vector<std::vector<float>> before;
    for (const shared::Vpl& light : some) before.push_back(copyOf(kept.map(light.slot)));
    rays += render(kept, room, some, changes);
    cpu::MapStore anew;
    anew.reserve(slots, {resolution, slots}, {});
    std::vector<cpu::ShadowMapDiff> ofNew;
    raysAnew += render(anew, room, some, ofNew);
    for (size_t i = 0; i < some.size(); ++i) {
      const int slot = some[i].slot;
      const std::vector<float> map = copyOf(kept.map(slot));
      ASSERT_EQ(map, copyOf(anew.map(slot))) << "slot " << slot << ", step " << step;
      ASSERT_EQ(map == before[i], changes[i].extent == cpu::ShadowMapDiff::Extent::nothing);
      parts += changes[i].extent == cpu::ShadowMapDiff::Extent::part ? 1 : 0;
    }
  }
  std::cout << 100 * rays / raysAnew << "% of the rays, " << parts << " changed in part\n";
  // Those about what moved are cast in either case.
  EXPECT_LT(rays, kind == Kind::drawn ? raysAnew : raysAnew / 2);
  EXPECT_GT(parts, 20u);
}
INSTANTIATE_TEST_SUITE_P(Rooms, KeptMaps,
                         testing::Combine(testing::Values(Kind::drawn, Kind::traced),
                                          testing::Values(16, 64, 96), testing::Range(1u, 4u)));

// Maps of which no part can be told from others.
TEST(KeptMaps, OfAnyResolutionAreThoseMadeFromNothing) {
  Room room(Kind::drawn, 5);
  const int slots = static_cast<int>(room.lights.size()), resolution = 18;
  cpu::MapStore kept, anew;
  std::vector<cpu::ShadowMapDiff> changes;
  kept.reserve(slots, {resolution, slots}, {});
  render(kept, room, room.lights, changes);
  kept.castersMove(room.world, room.moveSomething());
  render(kept, room, room.lights, changes);
  anew.reserve(slots, {resolution, slots}, {});
  render(anew, room, room.lights, changes);
  for (int slot = 0; slot < slots; ++slot)
    EXPECT_EQ(copyOf(kept.map(slot)), copyOf(anew.map(slot)));
}

// A light elsewhere, materials that change, and more moves than are remembered.
TEST(KeptMaps, ForgetWhatNoLongerHolds) {
  Room room(Kind::drawn, 6);
  const int slots = static_cast<int>(room.lights.size()), resolution = 32;
  cpu::MapStore kept;
  std::vector<cpu::ShadowMapDiff> changes;
  kept.reserve(slots, {resolution, slots}, {});
  render(kept, room, room.lights, changes);
  const auto expectAsNew = [&](const char* what) {
    cpu::MapStore anew;
    anew.reserve(slots, {resolution, slots}, {});
    render(anew, room, room.lights, changes);
    render(kept, room, room.lights, changes);
    for (int slot = 0; slot < slots; ++slot)
      EXPECT_EQ(copyOf(kept.map(slot)), copyOf(anew.map(slot))) << what;
  };
  for (shared::Vpl& light : room.lights) light.position += vec4(0.1f, 0.0f, 0.1f, 0.0f);
  render(kept, room, room.lights, changes);
  for (const cpu::ShadowMapDiff& change : changes)
    EXPECT_EQ(change.extent, cpu::ShadowMapDiff::Extent::everything);
  expectAsNew("a light elsewhere");
  for (int i = 0; i < 2500; ++i) kept.castersMove(room.world, room.moveSomething());
  expectAsNew("many moves");
  for (Material& material : room.world.materials) material.transmission = 1.0f;
  RenderSceneChanges clear;
  clear.materials = true;
  room.rays->update(clear);
  kept.castersChange();
  expectAsNew("clear materials");
}

// Lights have maps of either size, turn by turn, while things move.
TEST(KeptMaps, OfTwoSizesAreThoseMadeFromNothing) {
  for (const Kind kind : {Kind::drawn, Kind::traced}) {
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
        cpu::MapStore anew;
        anew.reserve(slots, coarse, fine);
        std::vector<cpu::ShadowMapDiff> ofNew;
        render(anew, room, some, ofNew, size);
        const int resolution = size == MapSize::coarse ? 16 : 64;
        for (size_t i = 0; i < some.size(); ++i) {
          const int slot = some[i].slot;
          MapSize& was = sizes[static_cast<size_t>(slot)];
          ASSERT_EQ(kept.resolution(slot), resolution);
          ASSERT_EQ(copyOf(kept.map(slot)), copyOf(anew.map(slot))) << "step " << step;
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
    // Of each size no more are held than there is room for.
    kept.reserve(slots, coarse, {64, 1});
    render(kept, room, room.lights, changes);
    EXPECT_THROW(render(kept, room, room.lights, changes, MapSize::fine), std::length_error);
  }
}

// Whatever looks up a texel that changed is in reach of the change.
TEST(ShadowMapDiff, ReachesWhateverLooksItUp) {
  constexpr int kPoints = 4000;
  for (const int resolution : {16, 64, 256}) {
    Room room(Kind::drawn, 7);
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
