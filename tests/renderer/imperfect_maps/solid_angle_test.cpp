// Solid angles of triangles: closed meshes, special places, and the version for 8 triangles.
#include "renderer/imperfect_maps/solid_angle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/base/random.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

float random(uint32_t i, uint32_t dimension) { return toUnitFloat(hash4(i, dimension, 7, 0)); }
vec3 randomPlace(uint32_t i, uint32_t dimension) {
  return {random(i, dimension) - 0.5f, random(i, dimension + 1) - 0.5f,
          random(i, dimension + 2) - 0.5f};
}

struct Sums {
  double plain = 0.0, withSign = 0.0;
};

Sums sumsAround(const vec3& at, const Mesh& mesh) {
  const Primitive& p = mesh.primitives[0];
  Sums sums;
  for (size_t i = 0; i < p.indices.size(); i += 3) {
    const vec3 &a = p.positions[p.indices[i]], &b = p.positions[p.indices[i + 1]],
               &c = p.positions[p.indices[i + 2]];
    sums.plain += static_cast<double>(solidAngle(at, a, b, c));
    sums.withSign += static_cast<double>(signedSolidAngle(at, a, b, c));
  }
  return sums;
}

constexpr double kSphere = 4.0 * 3.14159265358979323846;

TEST(SolidAngle, OfAClosedMeshIsTheSphereInsideAndNothingOutside) {
  const auto box = test::boxMesh(vec3(1.0f, 2.0f, 0.5f));
  const auto ball = test::sphereMesh(1.0f, 12, 0.2f);
  for (uint32_t i = 0; i < 50; ++i) {
    const Sums inBox = sumsAround(0.9f * randomPlace(i, 0) * vec3(1.0f, 2.0f, 0.5f), *box);
    EXPECT_NEAR(inBox.plain, kSphere, 1e-5);
    EXPECT_NEAR(inBox.withSign, kSphere, 1e-5);
    // Bumps hide each other, so that only the sum with signs is that of the sphere.
    EXPECT_NEAR(sumsAround(randomPlace(i, 3), *ball).withSign, kSphere, 1e-4);
    const vec3 outside = (2.0f + random(i, 6)) * glm::normalize(randomPlace(i, 7));
    EXPECT_NEAR(sumsAround(outside, *box).withSign, 0.0, 1e-5);
    EXPECT_NEAR(sumsAround(outside, *ball).withSign, 0.0, 1e-4);
    EXPECT_GT(sumsAround(outside, *ball).plain, 0.1);
  }
}

TEST(SolidAngle, OfSmallTrianglesIsProjectedAreaOverSquaredDistance) {
  const vec3 a(100.0f, 0.0f, 0.0f), b(100.0f, 0.01f, 0.0f), c(100.0f, 0.0f, 0.01f);
  const float expected = 0.5f * 0.01f * 0.01f / (100.0f * 100.0f);
  EXPECT_NEAR(solidAngle(vec3(0.0f), a, b, c), expected, 1e-4f * expected);
  const Floats8 wideAngle =
      solidAngle8(broadcast(vec3(0.0f)), broadcast(a), broadcast(b), broadcast(c));
  EXPECT_NEAR(hn::GetLane(wideAngle), expected, 1e-4f * expected);
}

// The octant of a cube's corner, and the side of the cube that is seen from a point within it.
TEST(SolidAngle, OfSpecialPlaces) {
  const vec3 a(1.0f, 0.0f, 0.0f), b(0.0f, 1.0f, 0.0f), c(0.0f, 0.0f, 1.0f);
  const auto expectBoth = [](const vec3& at, const vec3& p, const vec3& q, const vec3& r,
                             float expected) {
    EXPECT_NEAR(solidAngle(at, p, q, r), expected, 1e-6f);
    EXPECT_NEAR(hn::GetLane(solidAngle8(broadcast(at), broadcast(p), broadcast(q), broadcast(r))),
                expected, 2e-6f);
  };
  expectBoth(vec3(0.0f), a, b, c, 0.5f * kPi);
  EXPECT_NEAR(signedSolidAngle(vec3(0.0f), a, b, c), 0.5f * kPi, 1e-6f);
  EXPECT_NEAR(signedSolidAngle(vec3(0.0f), a, c, b), -0.5f * kPi, 1e-6f);
  expectBoth(vec3(0.25f, 0.25f, 0.0f), vec3(0.0f), a, b, 2.0f * kPi);  // within
  expectBoth(vec3(2.0f, 3.0f, 0.0f), vec3(0.0f), a, b, 0.0f);          // in its plane
  expectBoth(vec3(0.0f), vec3(0.0f), a, b, 0.0f);                      // a corner
  expectBoth(vec3(0.5f, 0.0f, 0.0f), vec3(0.0f), a, b, 0.0f);          // an edge
  expectBoth(vec3(0.5f, 0.0f, 0.0f), vec3(0.0f), a, 2.0f * a, 0.0f);   // without area
  expectBoth(a, a, a, a, 0.0f);
}

TEST(SolidAngle, EightAreEqualToOneByOne) {
  for (uint32_t i = 0; i < 1000; ++i) {
    alignas(32) float lanes[4][3][8], out[8];
    vec3 place[4][8];
    for (uint32_t p = 0; p < 4; ++p) {
      for (uint32_t lane = 0; lane < 8; ++lane) {
        // From triangles around the point to small ones that are far away.
        const float size = p == 0 ? 0.0f : std::exp2(-static_cast<float>(lane));
        const vec3 at = vec3(1.0f, 0.5f, 0.2f) + size * randomPlace(8 * i + lane, 3 * p);
        place[p][lane] = p == 0 ? randomPlace(8 * i + lane, 20) : at;
        for (int axis = 0; axis < 3; ++axis) lanes[p][axis][lane] = place[p][lane][axis];
      }
    }
    const auto load = [&](size_t p) {
      return SimdVec3<Floats8>{hn::Load(kTag, lanes[p][0]), hn::Load(kTag, lanes[p][1]),
                               hn::Load(kTag, lanes[p][2])};
    };
    hn::Store(solidAngle8(load(0), load(1), load(2), load(3)), kTag, out);
    for (uint32_t lane = 0; lane < 8; ++lane) {
      const float expected =
          solidAngle(place[0][lane], place[1][lane], place[2][lane], place[3][lane]);
      EXPECT_NEAR(out[lane], expected, 1e-6f * expected + 2e-6f) << i << ", " << lane;
    }
  }
}

}  // namespace
}  // namespace lamplighter
