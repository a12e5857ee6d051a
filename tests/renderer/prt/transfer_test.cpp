// Precomputed transfer against closed forms.
#include "renderer/prt/transfer.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "renderer/base/threads.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using test::addMaterial;
using test::addMesh;

// The scene in object space of the only object of a scene.
RenderScene ownSceneOf(const Scene& scene) {
  const RenderScene render = test::renderSceneOf(scene);
  return ownSceneOf(render, 0, ownSpaceOf(render.objects[0]).value());
}

// Irradiance under radiance 1 from all directions.
vec3 underSky(const Transfer::Vertex& v) {
  const float constant = std::sqrt(4.0f * kPi);
  return constant * vec3(v.r[0], v.g[0], v.b[0]);
}

TEST(Transfer, OfASphereEqualsThatOfItsTangentPlanes) {
  Scene scene;
  addMesh(scene, test::sphereMesh(0.7f, 24));
  const RenderScene own = ownSceneOf(scene);
  const Transfer transfer = computeTransfer(own, {256, 2}).value();
  ASSERT_EQ(transfer.vertices.size(), own.positions.size());
  for (size_t v = 0; v < own.positions.size(); ++v) {
    const ShVector expected = cosineTransfer(own.normals[v]);
    for (size_t i = 0; i < kShCoefficients; ++i) {
      EXPECT_NEAR(transfer.vertices[v].r[i], expected[i], 1e-5f);
      EXPECT_NEAR(transfer.vertices[v].b[i], expected[i], 1e-5f);
    }
  }
}

TEST(Transfer, OfAClosedRoomIsZero) {
  Scene scene;
  const int white = addMaterial(scene, vec3(1.0f));
  addMesh(scene, test::roomMesh(vec3(4, 3, 5), white));
  const Transfer transfer = computeTransfer(ownSceneOf(scene), {256, 4}).value();
  for (const Transfer::Vertex& v : transfer.vertices)
    for (size_t i = 0; i < kShCoefficients; ++i) EXPECT_NEAR(v.g[i], 0.0f, 1e-5f);
}

// Two finely divided squares at a right angle. A point on the common edge sees half of the sky: the
// form factor of an infinite wall through the point is 1/2.
std::shared_ptr<const Mesh> cornerMesh(int material) {
  auto mesh = std::make_shared<Mesh>();
  Primitive& p = mesh->primitives.emplace_back();
  p.material = material;
  constexpr uint32_t kCuts = 16;
  for (int wall = 0; wall < 2; ++wall) {
    const auto first = static_cast<uint32_t>(p.positions.size());
    for (uint32_t i = 0; i <= kCuts; ++i) {
      for (uint32_t j = 0; j <= kCuts; ++j) {
        const float away = static_cast<float>(i) / kCuts, along = static_cast<float>(j) / kCuts;
        p.positions.push_back(wall == 0 ? vec3(away, 0.0f, along) : vec3(0.0f, away, along));
        p.normals.push_back(wall == 0 ? vec3(0, 1, 0) : vec3(1, 0, 0));
      }
    }
    for (uint32_t i = 0; i < kCuts; ++i) {
      for (uint32_t j = 0; j < kCuts; ++j) {
        const uint32_t a = first + i * (kCuts + 1) + j, b = a + 1, c = a + kCuts + 1, d = c + 1;
        if (wall == 0)
          p.indices.insert(p.indices.end(), {a, b, d, a, d, c});
        else
          p.indices.insert(p.indices.end(), {a, d, b, a, c, d});
      }
    }
  }
  return mesh;
}

TEST(Transfer, InACornerIsReducedByTheOtherWall) {
  Scene scene;
  addMesh(scene, cornerMesh(addMaterial(scene, vec3(0.0f))));
  const RenderScene own = ownSceneOf(scene);
  const Transfer transfer = computeTransfer(own, {1024, 0}).value();
  for (size_t v = 0; v < own.positions.size() / 2; ++v) {
    // A wall of height 1 and length 1 from z = 0 to 1, seen from (x, 0, z) on the floor. The
    // point's own z divides it into two walls of lengths w, each with the form factor 1/2π
    // [atan(w/x) − x/√(x² + 1) atan(w/√(x² + 1))].
    const vec3& p = own.positions[v];
    if (p.x == 0.0f && (p.z == 0.0f || p.z == 1.0f)) continue;  // undefined: between 3/4 and 1
    const auto part = [&](float w) {
      const float s = std::sqrt(p.x * p.x + 1.0f);
      return (std::atan2(w, p.x) - p.x / s * std::atan(w / s)) / (2.0f * kPi);
    };
    const float wall = part(p.z) + part(1.0f - p.z);
    EXPECT_NEAR(underSky(transfer.vertices[v]).g / kPi, 1.0f - wall, 0.012f) << p.x << ", " << p.z;
  }
}

TEST(Transfer, OfAWhiteCornerGrowsWithBouncesAndConservesEnergy) {
  Scene scene;
  addMesh(scene, cornerMesh(addMaterial(scene, vec3(1.0f, 0.5f, 0.0f))));
  const RenderScene own = ownSceneOf(scene);
  const Transfer shadows = computeTransfer(own, {256, 0}).value();
  const Transfer one = computeTransfer(own, {256, 1}).value();
  const Transfer many = computeTransfer(own, {256, 8}).value();
  for (size_t v = 0; v < own.positions.size(); ++v) {
    const vec3 none = underSky(shadows.vertices[v]), once = underSky(one.vertices[v]),
               all = underSky(many.vertices[v]);
    EXPECT_EQ(all.b, none.b) << "a black surface reflects nothing";
    const float hidden = 1.0f - none.g / kPi;
    EXPECT_GE(once.r, none.r);
    EXPECT_GE(all.r, once.r);
    EXPECT_LE(all.r, kPi * 1.001f);
    EXPECT_NEAR(2.0f * (once.g - none.g), once.r - none.r, 1e-4f)
        << "half the albedo reflects half the light";
    // The hidden part of the sky is covered by the other wall, which receives at least half of the
    // sky's light.
    EXPECT_GE(once.r - none.r, 0.49f * kPi * hidden - 1e-4f);
  }
}

TEST(Transfer, DoesNotDependOnThePlacementOfTheObject) {
  Scene scene;
  const NodeId id = addMesh(scene, test::sphereMesh(0.5f, 12, 0.2f));
  const auto transferOf = [](const Scene& s) {
    return computeTransfer(ownSceneOf(s), {64, 1}).value();
  };
  const Transfer first = transferOf(scene);
  scene.find(id)->local.translation = vec3(3, -1, 8);
  scene.find(id)->local.rotation = glm::normalize(quat(0.3f, 0.5f, -0.2f, 0.7f));
  EXPECT_TRUE(transferOf(scene) == first);
  scene.find(id)->local.scale = vec3(2.5f);
  EXPECT_TRUE(transferOf(scene) == first);
  scene.find(id)->local.scale = vec3(2.5f, 1.0f, 1.0f);
  EXPECT_FALSE(transferOf(scene) == first);
}

TEST(Transfer, OwnSpaceContainsThePlacementOfTheObject) {
  Scene scene;
  const NodeId id = addMesh(scene, test::sphereMesh(0.5f, 12, 0.2f));
  for (const vec3& scale : {vec3(1.7f), vec3(0.5f, 2.0f, 1.0f), vec3(-1.0f, 1.0f, 2.0f)}) {
    Node& node = *scene.find(id);
    node.local.translation = vec3(3, -1, 8);
    node.local.rotation = glm::normalize(quat(0.3f, 0.5f, -0.2f, 0.7f));
    node.local.scale = scale;
    const RenderScene render = test::renderSceneOf(scene);
    const OwnSpace space = ownSpaceOf(render.objects[0]).value();
    EXPECT_NEAR(glm::determinant(space.rotation), 1.0f, 1e-5f);
    const RenderScene own = ownSceneOf(render, 0, space);
    for (size_t i = 0; i < own.positions.size(); ++i) {
      const vec3 p = space.scale * (space.rotation * own.positions[i]) + space.translation;
      EXPECT_LT(glm::distance(p, render.positions[i]), 1e-3f);
      EXPECT_GT(glm::dot(space.rotation * own.normals[i], render.normals[i]), 0.9999f);
    }
  }
}

TEST(Transfer, AFlattenedObjectHasNone) {
  Scene scene;
  const NodeId id = addMesh(scene, test::sphereMesh(0.5f, 8));
  scene.find(id)->local.scale = vec3(1, 0, 1);
  const RenderScene render = test::renderSceneOf(scene);
  EXPECT_FALSE(ownSpaceOf(render.objects[0]).has_value());
}

TEST(Transfer, HasTheSameBitsAtAnyNumberOfThreads) {
  Scene scene;
  addMesh(scene, test::sphereMesh(0.5f, 16, 0.2f));
  const RenderScene own = ownSceneOf(scene);
  std::optional<Transfer> one, many;
  {
    const ThreadLimit limit(1);
    one = computeTransfer(own, {64, 2});
  }
  {
    const ThreadLimit limit(4);
    many = computeTransfer(own, {64, 2});
  }
  EXPECT_TRUE(one.value() == many.value());
}

TEST(Transfer, ReportsItsProgressAndCanBeCancelled) {
  Scene scene;
  addMesh(scene, test::sphereMesh(0.5f, 16));
  const RenderScene own = ownSceneOf(scene);
  TransferProgress progress;
  EXPECT_TRUE(computeTransfer(own, {8, 2}, &progress).has_value());
  EXPECT_EQ(progress.done, progress.total);
  EXPECT_EQ(progress.total, 3 * own.positions.size());
  TransferProgress cancelled;
  cancelled.isCancelled = true;
  EXPECT_FALSE(computeTransfer(own, {8, 2}, &cancelled).has_value());
  EXPECT_EQ(cancelled.done, 0u);
}

}  // namespace
}  // namespace lamplighter
