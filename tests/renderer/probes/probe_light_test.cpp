// Light at probes against closed forms, quadrature and irradiance by the path tracer.
#include "renderer/probes/probe_light.h"

#include <gtest/gtest.h>

#include "renderer/base/threads.h"
#include "renderer/frame/world.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/scenes/skies.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

// Directions spread over the sphere in rings.
std::vector<vec3> directions(int rings) {
  std::vector<vec3> out;
  for (int i = 0; i < rings; ++i) {
    const float y = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(rings);
    const float r = std::sqrt(1.0f - y * y);
    for (int k = 0; k < 2 * rings; ++k) {
      const float angle = kPi * (static_cast<float>(k) + 0.5f) / static_cast<float>(rings);
      out.emplace_back(r * std::cos(angle), y, r * std::sin(angle));
    }
  }
  return out;
}

// Irradiance by bands 0 to 2 of unit irradiance from one direction, over the cosine with the
// normal.
double kernel(double c) { return 0.25 + 0.5 * c + 5.0 / 32.0 * (3.0 * c * c - 1.0); }

struct Lit {
  RenderScene render;
  RayCaster rays;
  ProbeReference reference;

  explicit Lit(const Scene& scene, int bounces = 0)
      : render(test::renderSceneOf(scene)),
        rays(render),
        reference(render, rays, {.bounces = bounces}) {}
  ProbeSh at(const vec3& place, uint32_t samples = 1024) const {
    return reference.light(place, samples);
  }
};

TEST(ProbeLight, OfAConstantSkyIsItsMeanAlone) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(0.01f), vec3(0, -50, 0));
  scene.sky = vec3(2.0f, 1.0f, 0.5f);
  const ProbeSh sh = Lit(scene).at(vec3(0, 1, 0), 4096);
  EXPECT_NEAR(sh[0].r, 2.0f * std::sqrt(4.0f * kPi), 1e-4f);
  EXPECT_NEAR(sh[0].b, 0.5f * std::sqrt(4.0f * kPi), 1e-4f);
  for (size_t i = 1; i < kProbeCoefficients; ++i) EXPECT_NEAR(sh[i].g, 0.0f, 3e-3f) << i;
  for (const vec3& n : directions(5))
    EXPECT_NEAR(irradianceFrom(sh, n).r / (2.0f * kPi), 1.0f, 3e-3f);
}

TEST(ProbeLight, OfPunctualLightsIsExact) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(20.0f, test::addMaterial(scene, vec3(0.0f))));
  Node& point = *scene.find(test::addNode(scene, "point", kNoNode, vec3(3, 5, 1)));
  point.punctual = PunctualLight{.intensity = vec3(40, 20, 10)};
  const vec3 place(1, 2, -1);
  const vec3 d = vec3(3, 5, 1) - place;
  const ProbeSh sh = Lit(scene).at(place, 1);
  for (const vec3& n : directions(6)) {
    const double c = static_cast<double>(glm::dot(n, glm::normalize(d)));
    const double open = 40.0 / static_cast<double>(glm::dot(d, d));
    EXPECT_NEAR(static_cast<double>(irradianceFrom(sh, n).r), open * kernel(c), 1e-5 * open);
    EXPECT_NEAR(static_cast<double>(irradianceFrom(sh, n).b), open / 4.0 * kernel(c), 1e-5 * open);
    // The bound that probe_light.h states.
    EXPECT_LE(std::abs(kernel(c) - std::max(c, 0.0)), 0.1);
  }

  point.punctual->kind = PunctualKind::directional;  // aims along −Z
  const ProbeSh sun = Lit(scene).at(place, 1);
  EXPECT_NEAR(irradianceFrom(sun, vec3(0, 0, 1)).r, 40.0f * 1.0625f, 1e-3f);
  EXPECT_NEAR(irradianceFrom(sun, vec3(0, 0, -1)).r, 40.0f * 0.0625f, 1e-3f);
  test::addMesh(scene, test::boxMesh(vec3(1.0f)), place + vec3(0, 0, 2));
  EXPECT_EQ(Lit(scene).reference.punctualLight(place), ProbeSh{}) << "behind a box";
}

// The square of a lamp by quadrature, through the same bands.
TEST(ProbeLight, OfAnAreaLightIsTheIntegralOverIt) {
  Scene scene;
  test::addRectangleLight(scene, vec3(0.3f, 2, -0.2f), vec2(1.0f, 0.6f), vec3(9, 6, 3));
  for (const vec3& place : {vec3(0), vec3(1, 1, 0.5f), vec3(0.2f, 1.7f, 0)}) {
    const ProbeSh sh = Lit(scene).at(place, 4096);
    double greatest = 0.0;
    for (const bool checks : {false, true}) {
      for (const vec3& n : directions(4)) {
        constexpr int kSide = 100;
        double expected = 0.0;
        for (int i = 0; i < kSide * kSide; ++i) {
          const float u = (static_cast<float>(i % kSide) + 0.5f) / kSide;
          const float v = (static_cast<float>(i / kSide) + 0.5f) / kSide;
          const vec3 d = vec3(-0.2f + u, 2, -0.5f + 0.6f * v) - place;
          const double d2 = static_cast<double>(glm::dot(d, d));
          const vec3 w = glm::normalize(d);
          expected += 9.0 * 0.6 / (kSide * kSide) * static_cast<double>(w.y) / d2 *
                      kernel(static_cast<double>(glm::dot(w, n)));
        }
        greatest = std::max(greatest, expected);
        if (checks) {
          EXPECT_NEAR(static_cast<double>(irradianceFrom(sh, n).r), expected, 0.01 * greatest)
              << place.x;
        }
      }
    }
  }
}

TEST(ProbeLight, OfSkiesHasTheirIrradiance) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(0.01f), vec3(0, -50, 0));
  for (const Sky& sky : {test::gradientSky(), test::cloudySky(), test::sunnySky()}) {
    scene.sky = sky;
    const ProbeSh sh = Lit(scene).at(vec3(0), 4096);
    // The same coefficients by quadrature, uniform in height and azimuth.
    ProbeSh expected{}, ring{};
    const std::vector<vec3> all = directions(1000);
    for (size_t i = 0; i < all.size(); ++i) {
      addLight(ring, all[i], sky.radianceFrom(all[i]));
      if ((i + 1) % 2000 != 0) continue;  // sums of few, so that rounding does not add up
      for (size_t c = 0; c < kProbeCoefficients; ++c)
        expected[c] += ring[c] * (4.0f * kPi / static_cast<float>(all.size()));
      ring = {};
    }
    for (size_t i = 0; i < kProbeCoefficients; ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sh[i][c], expected[i][c], 0.01f * expected[0][c]) << i;
  }
  // A smooth sky is shown by three bands.
  scene.sky = test::gradientSky();
  const ProbeSh sh = Lit(scene).at(vec3(0), 4096);
  for (const vec3& n : directions(4))
    EXPECT_NEAR(irradianceFrom(sh, n).g / test::irradianceOn(scene.sky, n).g, 1.0f, 0.03f);
}

// A closed room of 6 × 3 × 4 m with two boxes and walls of several colours.
Scene room() {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(6, 3, 4), test::addMaterial(scene, vec3(0.6f))));
  const int red = test::addMaterial(scene, vec3(0.7f, 0.1f, 0.1f));
  test::addMesh(scene, test::boxMesh(vec3(1, 1.2f, 1), red), vec3(-1.5f, -0.9f, 0.6f));
  const int blue = test::addMaterial(scene, vec3(0.1f, 0.3f, 0.8f));
  test::addMesh(scene, test::boxMesh(vec3(0.8f, 2, 0.8f), blue), vec3(1.4f, -0.5f, -0.9f));
  return scene;
}

struct Difference {
  double whole = 0.0;  // mean |difference| of irradiance relative to its mean
  double bands = 0.0;  // the same against the bands 0 to 2 of the reference's irradiance
};

// Of the light at these places.
Difference differenceFromReference(const RenderScene& render, const RayCaster& rays,
                                   const std::vector<vec3>& places, uint32_t samples) {
  const ProbeReference reference(render, rays, {.bounces = 4});
  const LightSet lights(render);
  const std::vector<vec3> normals = directions(12);
  double all = 0.0, whole = 0.0, bands = 0.0;
  for (const vec3& place : places) {
    const ProbeSh sh = reference.light(place, samples);
    std::vector<vec3> irradiance;
    ProbeSh projected{};  // of irradiance over the sphere of normals
    for (size_t i = 0; i < normals.size(); ++i) {
      vec3 sum(0.0f);
      for (uint32_t k = 0; k < 512; ++k)
        sum += traceIrradiance(render, rays, lights, {place, normals[i], normals[i]},
                               static_cast<uint32_t>(i), k, {.bounces = 4, .seed = 5});
      irradiance.push_back(sum / 512.0f);
      addLight(projected, normals[i],
               irradiance.back() * (4.0f * kPi / static_cast<float>(normals.size())));
    }
    for (size_t i = 0; i < normals.size(); ++i) {
      const auto basis = probeBasis(normals[i]);
      const vec3 found = irradianceFrom(sh, normals[i]);
      vec3 banded(0.0f);
      for (size_t c = 0; c < kProbeCoefficients; ++c) banded += basis[c] * projected[c];
      for (int c = 0; c < 3; ++c) {
        all += static_cast<double>(irradiance[i][c]);
        whole += static_cast<double>(std::abs(found[c] - irradiance[i][c]));
        bands += static_cast<double>(std::abs(found[c] - banded[c]));
      }
    }
  }
  return {whole / all, bands / all};
}

Difference differenceInRoom(const Scene& scene) {
  const Lit lit(scene);
  return differenceFromReference(
      lit.render, lit.rays,
      {vec3(0, 0, 0), vec3(-2.5f, -1, -1.5f), vec3(2.3f, 0.8f, 1.2f), vec3(-1.5f, 0.2f, 0.6f)},
      1024);
}

void record(const Difference& found) {
  testing::Test::RecordProperty("share_whole", std::to_string(found.whole));
  testing::Test::RecordProperty("share_bands", std::to_string(found.bands));
}

TEST(ProbeLight, IsTheReferenceOnTheNormalsOfASphereInARoomWithWideLight) {
  Scene scene = room();
  test::addRectangleLight(scene, vec3(0, 1.45f, 0), vec2(5.5f, 3.6f), vec3(4, 3, 2));
  const Difference found = differenceInRoom(scene);
  record(found);
  EXPECT_LT(found.whole, 0.03);
  EXPECT_LT(found.bands, 0.015);
}

// A lamp of few directions has bands above the second, which irradiance keeps in part.
TEST(ProbeLight, IsTheReferenceInItsBandsInARoomWithASmallLamp) {
  Scene scene = room();
  test::addRectangleLight(scene, vec3(0.5f, 1.4f, 0.2f), vec2(0.5f, 0.3f), vec3(90, 70, 50));
  const Difference found = differenceInRoom(scene);
  record(found);
  EXPECT_LT(found.bands, 0.03);
  EXPECT_LT(found.whole, 0.10);
}

class ProbesOfLevel : public testing::TestWithParam<const char*> {};

TEST_P(ProbesOfLevel, HaveTheLightOfTheReference) {
  const std::filesystem::path file = test::sharedScenes() / GetParam();
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "there is no " << file;
  const LoadedScene loaded = loadGltf(file);
  World world;
  world.update(loaded.scene, SceneChanges::all());
  const ProbeGrid grid = placeProbes(world.scene(), *world.rays(), {.most = 4096});
  std::vector<vec3> valid, places;
  for (const Probe& p : grid.probes)
    if (p.isValid()) valid.push_back(p.position);
  for (size_t i = 0; i < 6; ++i) places.push_back(valid.at((2 * i + 1) * valid.size() / 12));
  const Difference found = differenceFromReference(world.scene(), *world.rays(), places, 16384);
  record(found);
  EXPECT_LT(found.bands, 0.03);
  // Light of one direction alone has 12.3% outside of these bands, any other less.
  EXPECT_LT(found.whole, 0.123 + 0.03);
}
INSTANTIATE_TEST_SUITE_P(Some, ProbesOfLevel,
                         testing::Values("cornell-box/cornell-box.glb",
                                         "living-room/living-room.gltf",
                                         "modern-hall/modern-hall.glb", "bathroom/bathroom.glb",
                                         "kenney-fps-level/kenney-fps-level.gltf",
                                         "zdm2-map/zdm2.glb"),
                         [](const auto& file) { return test::testNameOf(file.param); });

TEST(ProbeLight, OfPartsAddsUpToTheWhole) {
  Scene scene = room();
  test::addRectangleLight(scene, vec3(0, 1.4f, 0), vec2(1), vec3(10));
  const Lit lit(scene, 2);
  ProbeSh parts{}, whole{};
  lit.reference.addSamples(vec3(0), 0, 16, parts);
  lit.reference.addSamples(vec3(0), 16, 48, parts);
  lit.reference.addSamples(vec3(0), 0, 64, whole);
  EXPECT_EQ(parts, whole);
}

TEST(ProbeLight, IsTheSameWithAnyNumberOfThreadsAndStops) {
  Scene scene = room();
  test::addRectangleLight(scene, vec3(0, 1.4f, 0), vec2(1), vec3(10));
  const Lit lit(scene, 2);
  const auto find = [&](int threads, const ProbeProgress& progress) {
    const ThreadLimit limit(threads);
    const ProbeGrid grid = placeProbes(lit.render, lit.rays, {.spacing = 0.6f});
    return probeLight(grid, lit.reference.source(16), progress);
  };
  int calls = 0, last = 0;
  const auto one = find(1, [&](int done, int all) {
    EXPECT_GT(done, last);
    EXPECT_LE(done, all);
    last = done;
    return ++calls > 0;
  });
  EXPECT_GT(calls, 1);
  EXPECT_EQ(one, find(2, {}));
  EXPECT_TRUE(find(2, [](int, int) { return false; }).empty());
}

TEST(ProbeLight, IsFilledInFromNeighbours) {
  ProbeGrid grid = probeNodes({vec3(0), vec3(4, 0, 0)}, {});
  ASSERT_EQ(grid.size, glm::ivec3(5, 1, 1));
  std::vector<ProbeSh> light(5);
  grid.probes[0].state = grid.probes[4].state = ProbeState::valid;
  light[0][0] = vec3(1);
  light[4][0] = vec3(3);
  light[2][0] = vec3(100);  // not valid: does not count
  fillInvalid(grid, light);
  EXPECT_EQ(light[1][0], vec3(1));
  EXPECT_EQ(light[2][0], vec3(2));
  EXPECT_EQ(light[3][0], vec3(3));
  for (Probe& p : grid.probes) p.state = ProbeState::inside;
  fillInvalid(grid, light);
  EXPECT_EQ(light, std::vector<ProbeSh>(5));
}

TEST(ProbeLight, IsInterpolatedBetweenValidProbes) {
  ProbeGrid grid = probeNodes({vec3(-2, 0, 1), vec3(0, 1, 2)}, {.spacing = 1.0f});
  ASSERT_EQ(grid.size, glm::ivec3(3, 2, 2));
  std::vector<ProbeSh> light(grid.probes.size());
  for (size_t i = 0; i < light.size(); ++i) {
    grid.probes[i].state = ProbeState::valid;
    const vec3 p = grid.placeOf(grid.nodeAt(i));
    light[i][4] = vec3(2.0f * p.x - p.y + 3.0f * p.z);  // linear in the place
  }
  const auto at = [&](const vec3& p) { return interpolatedLight(grid, light, p).value()[4].r; };
  EXPECT_FLOAT_EQ(at(vec3(-1.3f, 0.2f, 1.6f)), 2.0f * -1.3f - 0.2f + 3.0f * 1.6f);
  EXPECT_FLOAT_EQ(at(vec3(-2, 0, 1)), -1.0f);
  EXPECT_FLOAT_EQ(at(vec3(9, 9, 9)), 5.0f) << "the last node";
  for (size_t i = 0; i < light.size(); ++i)
    if (i % 3 != 0) grid.probes[i].state = ProbeState::inside;
  EXPECT_FLOAT_EQ(at(vec3(-1.1f, 0, 1)), -1.0f) << "the only valid one of two";
  EXPECT_FALSE(interpolatedLight(grid, light, vec3(-0.5f, 0.5f, 1.5f)).has_value());
  EXPECT_FALSE(interpolatedLight({}, {}, vec3(0)).has_value());
}

// A slab in the dark: a lamp in a closed box beside it lights nothing.
TEST(ProbeLight, BesideALevelWithoutLightIsMarked) {
  Scene scene;
  test::addMesh(scene, test::boxMesh(vec3(8, 1, 8)));
  test::addMesh(scene, test::roomMesh(vec3(3)), vec3(0, 2.5f, 0));
  test::addMesh(scene, test::boxMesh(vec3(3.4f)), vec3(0, 2.5f, 0));
  Node& lamp = *scene.find(test::addNode(scene, "lamp", kNoNode, vec3(0.1f, 2.7f, 0)));
  lamp.punctual = PunctualLight{};
  const auto counts = [](const Scene& s) {
    const Lit lit(s, 1);
    ProbeGrid grid = placeProbes(lit.render, lit.rays, {});
    const size_t before = grid.count(ProbeState::valid);
    markUnlit(lit.render, probeLight(grid, lit.reference.source(32), {}), grid);
    return std::array{before, grid.count(ProbeState::valid), grid.count(ProbeState::dark)};
  };
  const auto [before, valid, dark] = counts(scene);
  EXPECT_GT(dark, 100u);
  EXPECT_GE(valid, 27u) << "those in the box";
  EXPECT_EQ(before, valid + dark);
  scene.sky = vec3(1.0f);
  EXPECT_EQ(counts(scene)[2], 0u);
}

}  // namespace
}  // namespace lamplighter
