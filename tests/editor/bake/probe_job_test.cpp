// Baking light probes to files.
#include "editor/bake/probe_job.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderer/base/error.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/scaled_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

Scene probedRoom() {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(5, 3, 4), test::addMaterial(scene, vec3(0.6f))));
  test::addRectangleLight(scene, vec3(0.5f, 1.4f, 0), vec2(1), vec3(10, 8, 6));
  return scene;
}

ProbeJobOptions optionsFor(const test::TemporaryFolder& folder, const char* name) {
  ProbeJobOptions o;
  o.paths.bounces = 2;
  o.samples = 16;
  o.output = folder.path();
  o.name = name;
  return o;
}

nlohmann::json textOf(const ProbeReport& report) {
  return nlohmann::json::parse(test::readText(report.files.at(0)));
}

TEST(ProbeJob, WritesNothingWhenItIsStopped) {
  const test::TemporaryFolder folder;
  int calls = 0;
  const auto report = bakeProbes(probedRoom(), optionsFor(folder, "room"), [&](int done, int all) {
    EXPECT_LT(done, all);
    ++calls;
    return false;
  });
  EXPECT_FALSE(report);
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ProbeJob, CountsProbesByState) {
  const test::TemporaryFolder folder;
  const auto report = bakeProbes(probedRoom(), optionsFor(folder, "room"), {});
  ASSERT_TRUE(report);
  const nlohmann::json j = textOf(*report);
  size_t all = 0, valid = 0;
  for (const size_t count : report->counts) all += count;
  for (const auto& probe : j["probes"]) valid += probe["valid"].get<bool>();
  EXPECT_EQ(j["probes"].size(), all);
  EXPECT_EQ(valid, report->counts[0]);
  EXPECT_GT(valid, 64u);  // more than a batch, so that it can be stopped
  EXPECT_TRUE(report->warnings.empty());
}

// Lengths of the files are those of the level; light does not depend on its unit.
TEST(ProbeJob, OfALevelInAnotherUnitHasTheSameLight) {
  const test::TemporaryFolder folder;
  const auto metres = bakeProbes(probedRoom(), optionsFor(folder, "metres"), {});
  const auto large =
      bakeProbes(test::scaledScene(probedRoom(), 1024.0f), optionsFor(folder, "large"), {});
  ASSERT_TRUE(metres && large);
  const nlohmann::json a = textOf(*metres), b = textOf(*large);
  EXPECT_EQ(large->spacing, 1024.0f * metres->spacing);
  ASSERT_EQ(a["size"], b["size"]);
  for (size_t i = 0; i < a["probes"].size(); ++i) {
    EXPECT_EQ(a["probes"][i]["coefficients"], b["probes"][i]["coefficients"]);
    for (size_t c = 0; c < 3; ++c)
      EXPECT_EQ(1024.0f * a["probes"][i]["position"][c].get<float>(),
                b["probes"][i]["position"][c].get<float>());
  }
}

TEST(ProbeJob, SaysWhyThereAreNoProbes) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(bakeProbes(Scene(), optionsFor(folder, "empty"), {}), InputError);
  Scene dark = probedRoom();
  dark.nodes.pop_back();
  ProbeJobOptions o = optionsFor(folder, "room");
  o.grid.padding = 10.0f;
  const auto report = bakeProbes(dark, o, {});
  ASSERT_TRUE(report);
  ASSERT_EQ(report->warnings.size(), 1u);
  EXPECT_NE(report->warnings[0].find("no probe has room"), std::string::npos);
}

}  // namespace
}  // namespace lamplighter
