// The file of what texels see, read by the reader of the documentation.
#include "renderer/bake/visibility_file.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "docs/reference/visibility_reader.h"
#include "renderer/base/random.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

class VisibilityFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    file_ = fs::temp_directory_path() / ("lamplighter_visibility_" + std::string(info->name()));
    const int white = test::addMaterial(scene_, vec3(0.7f));
    test::addMesh(scene_, test::roomMesh(vec3(4.0f, 3.0f, 4.0f), white));
    test::addMesh(scene_, test::boxMesh(vec3(1.0f), white), vec3(0.3f, -1.0f, 0.2f));
    Material curtain;
    curtain.doubleSided = true;
    scene_.materials.push_back(curtain);
    test::addMesh(scene_, test::squareMesh(0.8f, static_cast<int>(scene_.materials.size()) - 1),
                  vec3(-1.0f, 0.5f, -1.0f));
    scene_.nodes[0].name = "room";
    scene_.nodes[1].name = "box";
    scene_.nodes[2].name = "Vorhang ü";
  }
  void TearDown() override { fs::remove(file_); }

  // In the unit; the level itself stays as it is.
  SurfaceVisibility found(const DepthMapLayout& map, float unit = 1.0f) {
    update(render_, scene_, SceneChanges::all());
    if (unit != 1.0f) setUnit(render_, scene_, unit);
    const RayCaster rays(render_);
    TexelRadiosityOptions options;
    options.texel = 0.3f / unit;
    options.map = map;
    return findVisibility(render_, rays, options);
  }
  void write(const std::vector<uint8_t>& bytes) const {
    std::ofstream(file_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  // What the reader says about the bytes; empty: nothing.
  std::string problemOf(const std::vector<uint8_t>& bytes) const {
    write(bytes);
    try {
      VisibilityReader reader(file_.string());
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  // Compares answers about points of other texels, moved by up to half a texel, and in the room.
  void expectSameAnswers(const SurfaceVisibility& visibility) const {
    const VisibilityReader reader(file_.string());
    const auto count = static_cast<uint32_t>(visibility.texels.size());
    ASSERT_EQ(reader.texels.size(), count);
    int seen = 0, hidden = 0;
    for (uint32_t i = 0; i < 200'000; ++i) {
      const auto random = [&](uint32_t set) {
        return static_cast<float>(hash4(i, 0, 0, set) >> 8) / 8388608.0f - 1.0f;
      };
      const uint32_t from = hash4(i, 0, 0, 1) % count, to = hash4(i, 0, 0, 2) % count;
      const SurfaceTexel& other = visibility.texels[to];
      const vec3 point =
          i % 4 == 0 ? vec3(2, 1.5f, 2) * vec3(random(3), random(4), random(5)) / render_.unit
                     : other.spot.position + random(3) * other.half[0] + random(4) * other.half[1];
      const vec3 metres = render_.unit * point;
      const bool expected = visibility.depths.sees(visibility.texels[from], from, point);
      ASSERT_EQ(reader.sees(from, {metres.x, metres.y, metres.z}), expected)
          << from << " sees " << metres.x << ' ' << metres.y << ' ' << metres.z;
      ++(expected ? seen : hidden);
    }
    EXPECT_GT(seen, 40'000);
    EXPECT_GT(hidden, 40'000);
  }

  Scene scene_;
  RenderScene render_;
  fs::path file_;
};

TEST_F(VisibilityFile, GivesTheAnswersOfTheDepthsToItsReader) {
  for (const DepthMapLayout map :
       {DepthMapLayout{DepthMapKind::cube, 16}, DepthMapLayout{DepthMapKind::octahedral, 48}}) {
    const SurfaceVisibility visibility = found(map);
    write(visibilityFile(scene_, render_, visibility));
    expectSameAnswers(visibility);
  }
}

TEST_F(VisibilityFile, IsInMetresWhateverTheUnitOfTheRenderer) {
  const DepthMapLayout map{DepthMapKind::octahedral, 32};
  const std::vector<uint8_t> metres = visibilityFile(scene_, render_, found(map));
  const SurfaceVisibility visibility = found(map, 8.0f);
  write(visibilityFile(scene_, render_, visibility));
  expectSameAnswers(visibility);
  float radius = 0.0f;
  for (const VisibilityReader::Texel& t : VisibilityReader(file_.string()).texels)
    radius = std::max(radius, std::abs(t.position[0]));
  EXPECT_NEAR(radius, 2.0f, 0.01f);
}

TEST_F(VisibilityFile, HasTheTexelsOfEachNodeAndBothSidesOfACurtain) {
  const SurfaceVisibility visibility = found({DepthMapKind::octahedral, 16});
  write(visibilityFile(scene_, render_, visibility));
  const VisibilityReader reader(file_.string());
  EXPECT_EQ(reader.nodes, (std::vector<std::string>{"room", "box", "Vorhang ü"}));
  std::array<double, 3> area{};
  std::array<double, 2> curtain{};
  size_t inside = 0;
  for (size_t t = 0; t < reader.texels.size(); ++t) {
    const VisibilityReader::Texel& texel = reader.texels[t];
    area.at(texel.node) += static_cast<double>(texel.area);
    if (texel.node == 2) curtain[texel.flags & 1u] += static_cast<double>(texel.area);
    inside += (texel.flags & 2u) != 0 ? 1 : 0;
    const vec3 normal(texel.normal[0], texel.normal[1], texel.normal[2]);
    EXPECT_EQ(normal, visibility.texels[t].spot.geometricNormal);
  }
  EXPECT_NEAR(area[0], 2.0 * (12 + 12 + 16), 0.1);
  EXPECT_NEAR(area[1], 6.0, 0.01);
  EXPECT_NEAR(curtain[0], 0.64, 0.001);
  EXPECT_NEAR(curtain[1], 0.64, 0.001);
  EXPECT_GT(inside, 4u) << "under the box";
}

TEST_F(VisibilityFile, IsRefusedInWordsWhenDamaged) {
  const std::vector<uint8_t> bytes =
      visibilityFile(scene_, render_, found({DepthMapKind::octahedral, 16}));
  EXPECT_EQ(problemOf(bytes), "");
  for (const size_t size :
       {size_t{0}, size_t{10}, size_t{47}, size_t{48}, bytes.size() / 2, bytes.size() - 1}) {
    const std::string problem = problemOf({bytes.begin(), bytes.begin() + static_cast<long>(size)});
    EXPECT_TRUE(problem.find("ends too early") != std::string::npos ||
                problem.find("is damaged") != std::string::npos)
        << size << ": " << problem;
  }
  for (uint32_t i = 0; i < 50; ++i) {
    std::vector<uint8_t> damaged = bytes;
    damaged[16 + hash4(i, 0, 0, 1) % (bytes.size() - 16)] ^=
        static_cast<uint8_t>(1 + hash4(i, 0, 0, 2) % 255);
    EXPECT_NE(problemOf(damaged), "");
  }
  EXPECT_NE(problemOf(std::vector<uint8_t>(100, 7)).find("another kind of file"),
            std::string::npos);
  std::vector<uint8_t> newer = bytes;
  ++newer[16];
  EXPECT_NE(problemOf(newer).find("another version"), std::string::npos);
  fs::remove(file_);
  EXPECT_THROW(VisibilityReader(file_.string()), std::runtime_error);
}

}  // namespace
}  // namespace lamplighter
