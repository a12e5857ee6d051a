// Topologies of meshes: shared by instances, kept on disk by content, and never read from a file
// that is damaged or of another mesh.
#include "renderer/patches/mesh_topologies.h"

#include <chrono>
#include <fstream>
#include <iterator>
#include <numeric>

#include <gtest/gtest.h>

#include "renderer/patches/topology_file.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

// Everything in a topology, as words.
std::vector<uint64_t> wordsOf(const MeshTopology& t) {
  std::vector<uint64_t> words;
  for (const uint8_t byte : bytesOf(t)) words.push_back(byte);
  for (int c = 0; c < 3; ++c) words.push_back(std::bit_cast<uint32_t>(t.shape.scale[c]));
  words.push_back(t.shape.mirrored);
  words.push_back(static_cast<uint64_t>(t.shape.kind));
  words.insert(words.end(), t.flat.begin(), t.flat.end());
  t.occluders.visit(
      [&](const Bounds& b) {
        for (int c = 0; c < 3; ++c)
          words.insert(words.end(),
                       {std::bit_cast<uint32_t>(b.min[c]), std::bit_cast<uint32_t>(b.max[c])});
        return true;
      },
      [&](uint32_t i) {
        words.push_back(i);
        return true;
      });
  return words;
}

class MeshTopologiesTest : public testing::Test {
 protected:
  MeshTopologiesTest()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("mesh_topologies_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    // A box on a sphere of 2,944 triangles, so that there are charts and clusters.
    auto both = std::make_shared<Mesh>(*test::sphereMesh(3.0f, 32));
    Primitive& p = both->primitives.front();
    const auto box = test::boxMesh(vec3(2, 1, 3));
    for (const uint32_t i : box->primitives.front().indices)
      p.indices.push_back(i + static_cast<uint32_t>(p.positions.size()));
    const auto& corners = box->primitives.front();
    for (size_t i = 0; i < corners.positions.size(); ++i) {
      p.positions.push_back(corners.positions[i] + vec3(0, 4, 0));
      p.normals.push_back(corners.normals[i]);
    }
    p.uv0.clear();
    first_ = test::addMesh(scene_, both);
    second_ = test::addMesh(scene_, both, vec3(9, 0, 0));
    scene_.find(second_)->local.rotation = glm::normalize(quat(0.1f, 0.5f, -0.2f, 0.7f));
    test::addMesh(scene_, test::boxMesh(vec3(1, 2, 3)), vec3(0, 9, 0));
    build();
  }
  ~MeshTopologiesTest() override { fs::remove_all(folder_); }

  void build() {
    render_ = test::renderSceneOf(scene_);
    objects_.resize(render_.objects.size());
    std::iota(objects_.begin(), objects_.end(), 0u);
  }
  size_t files() const {
    std::error_code none;
    return static_cast<size_t>(
        std::distance(fs::directory_iterator(folder_, none), fs::directory_iterator()));
  }

  fs::path folder_;
  Scene scene_;
  NodeId first_ = 0, second_ = 0;
  RenderScene render_;
  std::vector<uint32_t> objects_;
};

TEST_F(MeshTopologiesTest, InstancesShareOneUntilTheirShapeDiffers) {
  MeshTopologies topologies;
  const auto found = topologies.find(render_, objects_);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_NE(found[0], found[2]);
  EXPECT_EQ(topologies.computed(), 2u);
  EXPECT_FALSE(found[0]->charts.empty());
  EXPECT_GT(found[0]->clusters.size(), 1u);
  EXPECT_EQ(topologies.find(render_, objects_), found);
  EXPECT_EQ(topologies.computed(), 2u) << "they are held";
  for (const uint32_t i : objects_)
    EXPECT_EQ(wordsOf(*found[i]), wordsOf(findTopology(render_, i)));
  scene_.find(second_)->local.scale = vec3(0.5f);
  build();
  const auto others = topologies.find(render_, objects_);
  EXPECT_EQ(others[0], found[0]);
  EXPECT_NE(others[1], found[0]);
  EXPECT_EQ(topologies.computed(), 3u);
}

TEST_F(MeshTopologiesTest, EveryInputChangesTheKey) {
  const ContentKey key = MeshTopologies::keyOf(render_, 0);
  EXPECT_EQ(MeshTopologies::keyOf(render_, 1), key) << "places do not";
  EXPECT_NE(MeshTopologies::keyOf(render_, 2), key);
  for (float TopologyLimits::*limit :
       {&TopologyLimits::large, &TopologyLimits::rough, &TopologyLimits::largeRough,
        &TopologyLimits::smallestCluster}) {
    TopologyLimits other;
    other.*limit *= 2.0f;
    EXPECT_NE(MeshTopologies::keyOf(render_, 0, other), key);
  }
  RenderScene other = render_;
  other.objects[0].kind = MeshKind::complex;
  EXPECT_NE(MeshTopologies::keyOf(other, 0), key);
  other = render_;
  std::swap(other.indices[other.objects[0].firstIndex],
            other.indices[other.objects[0].firstIndex + 1]);
  EXPECT_NE(MeshTopologies::keyOf(other, 0), key);
  other = render_;
  other.localPositions[other.objects[0].firstVertex + 7].z += 1e-6f;
  EXPECT_NE(MeshTopologies::keyOf(other, 0), key);
}

TEST_F(MeshTopologiesTest, AFileHasTheBitsOfTheComputationAndADamagedOneIsReplaced) {
  fs::path file;
  std::vector<uint64_t> expected;
  {
    MeshTopologies topologies(folder_);
    expected = wordsOf(*topologies.find(render_, objects_)[0]);
    file = topologies.fileOf(MeshTopologies::keyOf(render_, 0));
    EXPECT_EQ(topologies.computed(), 2u);
    EXPECT_EQ(files(), 1u) << "the small mesh has none";
  }
  const auto find = [&](size_t computed) {
    MeshTopologies topologies(folder_);
    EXPECT_EQ(wordsOf(*topologies.find(render_, objects_)[0]), expected);
    EXPECT_EQ(topologies.computed(), computed);
  };
  find(1);
  std::ifstream in(file, std::ios::binary);
  std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  for (const size_t at : {size_t{3}, size_t{20}, size_t{50}, bytes.size() - 1}) {
    std::vector<char> bad = bytes;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    std::ofstream(file, std::ios::binary)
        .write(bad.data(), static_cast<std::streamsize>(bad.size()));
    find(2);
    find(1);
  }
}

TEST_F(MeshTopologiesTest, BytesOfAnotherMeshAreNoTopology) {
  const MeshTopology topology = findTopology(render_, 0);
  const std::vector<uint8_t> bytes = bytesOf(topology);
  ASSERT_TRUE(topologyOf(bytes, render_, 0).has_value());
  EXPECT_EQ(wordsOf(*topologyOf(bytes, render_, 0)), wordsOf(topology));
  EXPECT_FALSE(topologyOf(bytes, render_, 2).has_value());
  for (size_t length = 0; length < bytes.size(); length += 13)
    EXPECT_FALSE(topologyOf(std::span(bytes).first(length), render_, 0).has_value());
  const auto isRefused = [&](const std::function<void(MeshTopology&)>& damage) {
    MeshTopology damaged = topology;
    damage(damaged);
    return !topologyOf(bytesOf(damaged), render_, 0).has_value();
  };
  EXPECT_TRUE(isRefused([](MeshTopology& t) { t.loose[1] = t.loose[0]; }));
  EXPECT_TRUE(isRefused([](MeshTopology& t) { t.loose.pop_back(); }));
  EXPECT_TRUE(isRefused([](MeshTopology& t) { t.charts[0].triangles[0] = 1u << 30; }));
  EXPECT_TRUE(isRefused([](MeshTopology& t) { t.charts[0].outline[0] = 1u << 30; }));
  EXPECT_TRUE(isRefused([](MeshTopology& t) { t.charts[0].longestEdge[1] = 1u << 30; }));
  EXPECT_TRUE(isRefused([](MeshTopology& t) { t.charts[0].seed = 1u << 30; }));
  EXPECT_TRUE(isRefused([](MeshTopology& t) { t.clusters[0].firstChild = 0; }));
  EXPECT_TRUE(isRefused([](MeshTopology& t) { t.clusters[0].firstChild = -7; }));
  EXPECT_TRUE(isRefused([](MeshTopology& t) { t.clusters[1].count += 16; }));
  EXPECT_TRUE(isRefused([](MeshTopology& t) { t.clusters.push_back({0, 16, kNone}); }));
}

TEST_F(MeshTopologiesTest, WhatPassesAndWhatHasNoFolderLeavesNoFile) {
  MeshTopologies topologies(folder_);
  topologies.find(render_, objects_, true);
  EXPECT_EQ(topologies.computed(), 2u);
  EXPECT_FALSE(fs::exists(folder_));
  MeshTopologies without;
  without.find(render_, objects_);
  EXPECT_FALSE(fs::exists(without.fileOf(MeshTopologies::keyOf(render_, 0))));
}

TEST_F(MeshTopologiesTest, TheOldestFilesOfAKindAreDeletedFirst) {
  const ContentCache cache(folder_, {"one", 1}), other(folder_, {"two", 1});
  const std::vector<uint8_t> bytes(1000);
  other.save({9, 9}, bytes);
  for (uint64_t i = 0; i < 5; ++i) {
    cache.save({i, 0}, bytes);
    // File 3 is the oldest, then 4, 0, 1, 2.
    fs::last_write_time(cache.fileOf({i, 0}),
                        fs::file_time_type() + std::chrono::hours((i + 2) % 5));
  }
  cache.keepWithin(3500);  // three files with their headers
  for (uint64_t i = 0; i < 5; ++i) EXPECT_EQ(cache.load({i, 0}).has_value(), i < 3) << i;
  EXPECT_TRUE(other.load({9, 9}).has_value());
  cache.keepWithin(0);
  EXPECT_EQ(files(), 1u);
  ContentCache("", {"one", 1}).keepWithin(0);
}

}  // namespace
}  // namespace lamplighter
