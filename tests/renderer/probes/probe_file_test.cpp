// The files of probes, read back by other programs' libraries.
#include "renderer/probes/probe_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderer/base/error.h"

namespace lamplighter {
namespace {

struct Probes {
  ProbeGrid grid = probeNodes({vec3(0.2f, -0.9f, 1.0f), vec3(2.7f, 0.0f, 2.5f)}, {.spacing = 0.5f});
  std::vector<ProbeSh> light;

  Probes() {
    light.resize(grid.probes.size());
    for (size_t i = 0; i < light.size(); ++i) {
      Probe& p = grid.probes[i];
      p.state = static_cast<ProbeState>(i % static_cast<size_t>(kProbeStates));
      p.position += vec3(0.01f, -0.03f, 0.1f) * static_cast<float>(i % 4);
      for (size_t c = 0; c < kProbeCoefficients; ++c)
        light[i][c] = vec3(1.0f / 3.0f, -0.7f, 1e-5f) * static_cast<float>(i + 100 * c);
    }
  }
};

TEST(ProbeFile, TextHasAllNumbersExactly) {
  const Probes probes;
  const auto j = nlohmann::json::parse(
      probeText(probes.grid, probes.light, {"a \"b\".exr", 4.0f, 0.125f, 64, 3}));
  const ProbeGrid& grid = probes.grid;
  EXPECT_EQ(j["volume"], "a \"b\".exr");
  EXPECT_EQ(j["size"], (std::vector<int>{grid.size.x, grid.size.y, grid.size.z}));
  EXPECT_EQ(j["spacing"].get<float>(), 2.0f);  // in metres
  EXPECT_EQ(j["padding"].get<float>(), 0.5f);
  EXPECT_EQ(j["samples"], 64);
  EXPECT_EQ(j["bounces"], 3);
  EXPECT_NEAR(j["cosine"][8].get<float>(), kPi / 4.0f, 1e-6f);
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(j["origin"][static_cast<size_t>(c)].get<float>(), 4.0f * grid.placeOf({0, 0, 0})[c]);
  ASSERT_EQ(j["probes"].size(), grid.probes.size());
  for (size_t i = 0; i < grid.probes.size(); ++i) {
    const auto& p = j["probes"][i];
    EXPECT_EQ(p["valid"].get<bool>(), i % 5 == 0);
    EXPECT_EQ(p["state"], nameOf(grid.probes[i].state));
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(p["position"][static_cast<size_t>(c)].get<float>(),
                4.0f * grid.probes[i].position[c]);
    ASSERT_EQ(p["coefficients"].size(), 27u);
    for (size_t c = 0; c < 27; ++c)
      EXPECT_EQ(p["coefficients"][c].get<float>(), probes.light[i][c / 3][static_cast<int>(c % 3)]);
  }
}

TEST(ProbeFile, VolumeHasTheSameNumbers) {
  const Probes probes;
  const glm::ivec3 size = probes.grid.size;
  std::vector<uint8_t> bytes = probeVolume(probes.grid, probes.light);
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  const auto in = OIIO::ImageInput::open("probes.exr", nullptr, &memory);
  ASSERT_TRUE(in) << OIIO::geterror();
  ASSERT_EQ(in->spec().width, 9 * size.x);
  ASSERT_EQ(in->spec().height, size.y * size.z);
  ASSERT_EQ(in->spec().nchannels, 4);
  EXPECT_EQ(in->spec().channelnames, (std::vector<std::string>{"R", "G", "B", "A"}));
  std::vector<float> data(static_cast<size_t>(9 * size.x * size.y * size.z * 4));
  ASSERT_TRUE(in->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, data.data()));
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const size_t i = probes.grid.indexOf({x, y, z});
        for (int c = 0; c < 9; ++c) {
          const float* pixel =
              &data[4 * static_cast<size_t>((z * size.y + y) * 9 * size.x + c * size.x + x)];
          const vec3 expected = probes.light[i][static_cast<size_t>(c)];
          EXPECT_EQ(vec3(pixel[0], pixel[1], pixel[2]), expected);
          EXPECT_EQ(pixel[3], i % 5 == 0 ? 1.0f : 0.0f);
        }
      }
}

TEST(ProbeFile, RefusesLightThatIsNotFinite) {
  Probes probes;
  probes.light[3][2].y = std::numeric_limits<float>::infinity();
  EXPECT_THROW(probeText(probes.grid, probes.light, {}), InputError);
}

}  // namespace
}  // namespace lamplighter
