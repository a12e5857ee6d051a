// The cache of transfer on disk returns what was saved, and ignores all other files.
#include "renderer/prt/transfer_cache.h"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

class TransferCacheTest : public testing::Test {
 protected:
  TransferCacheTest()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("transfer_cache_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())),
        cache_(folder_ / "some" / "where") {
    fs::remove_all(folder_);
    for (int i = 0; i < 7; ++i) {
      Transfer::Vertex& v = transfer_.vertices.emplace_back();
      for (size_t k = 0; k < kShCoefficients; ++k) {
        v.r[k] = static_cast<float>(i) + 0.1f * static_cast<float>(k);
        v.g[k] = -v.r[k];
        v.b[k] = 0.5f * v.r[k];
      }
    }
  }
  ~TransferCacheTest() override { fs::remove_all(folder_); }

  std::vector<char> read() const {
    std::ifstream in(cache_.fileOf(key_), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::vector<char>& bytes) const {
    std::ofstream(cache_.fileOf(key_), std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  bool isThere() const { return cache_.load(key_, transfer_.vertices.size()).has_value(); }

  fs::path folder_;
  TransferCache cache_;
  TransferKey key_{0x0123456789abcdefu, 42};
  Transfer transfer_;
};

TEST_F(TransferCacheTest, ReturnsWhatWasSaved) {
  EXPECT_FALSE(isThere());
  EXPECT_TRUE(cache_.save(key_, transfer_));
  EXPECT_TRUE(cache_.load(key_, 7).value() == transfer_);
  // No temporary file is left.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "some" / "where"), {}), 1);
  transfer_.vertices[3].g[4] = 17.0f;
  EXPECT_TRUE(cache_.save(key_, transfer_)) << "replaces the old file";
  EXPECT_TRUE(cache_.load(key_, 7).value() == transfer_);
}

TEST_F(TransferCacheTest, StoresNothingWithoutAFolder) {
  const TransferCache none;
  EXPECT_FALSE(none.save(key_, transfer_));
  EXPECT_FALSE(none.load(key_, 7).has_value());
}

TEST_F(TransferCacheTest, AReadOnlyFolderIsNoError) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "file") << "x";
  const TransferCache blocked(folder_ / "file" / "below");
  EXPECT_FALSE(blocked.save(key_, transfer_));
  EXPECT_FALSE(blocked.load(key_, 7).has_value());
}

TEST_F(TransferCacheTest, IgnoresAFileOfAnotherObject) {
  ASSERT_TRUE(cache_.save(key_, transfer_));
  EXPECT_FALSE(cache_.load(key_, 6).has_value());
  EXPECT_FALSE(cache_.load(key_, 8).has_value());
  EXPECT_FALSE(cache_.load(key_, std::numeric_limits<size_t>::max() / 8).has_value());
  const TransferKey other{key_[0], 43};
  fs::copy_file(cache_.fileOf(key_), cache_.fileOf(other));
  EXPECT_FALSE(cache_.load(other, 7).has_value()) << "the file of another object";
}

TEST_F(TransferCacheTest, IgnoresAFileWithAnyByteChanged) {
  ASSERT_TRUE(cache_.save(key_, transfer_));
  const std::vector<char> good = read();
  for (size_t i = 0; i < good.size(); ++i) {
    std::vector<char> bad = good;
    bad[i] = static_cast<char>(bad[i] ^ (1 << (i % 8)));
    write(bad);
    EXPECT_FALSE(isThere()) << "byte " << i;
  }
  write(good);
  EXPECT_TRUE(isThere());
}

TEST_F(TransferCacheTest, IgnoresAFileThatIsCutShortOrTooLong) {
  ASSERT_TRUE(cache_.save(key_, transfer_));
  const std::vector<char> good = read();
  for (const size_t length : {size_t{0}, size_t{1}, size_t{47}, size_t{48}, good.size() - 1}) {
    write({good.begin(), good.begin() + static_cast<ptrdiff_t>(length)});
    EXPECT_FALSE(isThere()) << length;
  }
  std::vector<char> longer = good;
  longer.push_back(0);
  write(longer);
  EXPECT_FALSE(isThere());
}

TEST_F(TransferCacheTest, IgnoresNanValuesAndFolders) {
  transfer_.vertices[2].b[24] = std::numeric_limits<float>::quiet_NaN();
  ASSERT_TRUE(cache_.save(key_, transfer_));
  EXPECT_FALSE(isThere());
  fs::remove(cache_.fileOf(key_));
  fs::create_directories(cache_.fileOf(key_));
  EXPECT_FALSE(isThere());
  EXPECT_FALSE(cache_.save(key_, transfer_));
}

TEST(TransferKey, DependsOnExactlyTheInputsOfTransfer) {
  Scene scene;
  const int red = test::addMaterial(scene, vec3(1, 0, 0));
  const NodeId id = test::addMesh(scene, test::sphereMesh(0.5f, 8, 0.1f, red));
  const auto keyOf = [&](const TransferOptions& options = {}) {
    const RenderScene render = test::renderSceneOf(scene);
    return transferKey(ownSceneOf(render, 0, ownSpaceOf(render.objects[0]).value()), options);
  };
  const TransferKey first = keyOf();
  scene.find(id)->local.translation = vec3(1, 2, 3);
  scene.find(id)->local.rotation = glm::normalize(quat(0.1f, 0.5f, -0.2f, 0.7f));
  scene.materials[static_cast<size_t>(red)].emissive = vec3(3.0f);
  EXPECT_EQ(keyOf(), first);
  EXPECT_NE(keyOf({512, 2}), first);
  EXPECT_NE(keyOf({256, 3}), first);
  scene.materials[static_cast<size_t>(red)].baseColor.g = 0.5f;
  EXPECT_NE(keyOf(), first);
  scene.materials[static_cast<size_t>(red)].baseColor.g = 0.0f;
  EXPECT_EQ(keyOf(), first);
  scene.find(id)->local.scale = vec3(1, 2, 1);
  EXPECT_NE(keyOf(), first);
  scene.find(id)->local.scale = vec3(1);
  auto mesh = std::make_shared<Mesh>(*scene.meshes[0]);
  std::swap(mesh->primitives[0].indices[0], mesh->primitives[0].indices[1]);
  scene.meshes[0] = mesh;
  EXPECT_NE(keyOf(), first);
}

}  // namespace
}  // namespace lamplighter
