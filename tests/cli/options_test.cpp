// Parsing of the flags of the subcommands, without running the program.
#include "editor/cli/options.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "editor/cli/subcommands.h"
#include "editor/document/write_file.h"
#include "renderer/base/error.h"
#include "renderer/registry/registry.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::cli {
namespace {

namespace fs = std::filesystem;

std::string errorOf(const std::function<void()>& run) {
  try {
    run();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ParseSize, TakesWidthAndHeight) {
  EXPECT_EQ(parseSize("640x360"), std::pair(640, 360));
  EXPECT_EQ(parseSize("1x16384"), std::pair(1, 16384));
}

TEST(ParseSize, RefusesEverythingElse) {
  for (const char* text : {"", "x", "640", "640x", "x360", "640X360", "640x360x2", "640 x360",
                           "0x1", "1x0", "-4x4", "16385x1", "4.5x4", "99999999999x1", "1e3x10"}) {
    EXPECT_NE(errorOf([&] { parseSize(text); }).find("is not a size"), std::string::npos) << text;
  }
}

TEST(Parameters, EachCanBeSetToItsLimitsButNotBeyond) {
  for (const MethodInfo& method : lamplighter::methods()) {
    for (const ParameterSpec& p : method.parameters) {
      Settings settings;
      setFromAssignment(settings, method, p.name + "=" + Settings::format(p.defaultValue));
      ASSERT_TRUE(settings.has(p.name)) << method.name;
      EXPECT_EQ(settings.values().at(p.name), p.defaultValue) << p.name;
      if (std::holds_alternative<int>(p.defaultValue)) {
        for (const double limit : {p.minimum, p.maximum}) {
          const int value = static_cast<int>(limit);
          setParameter(settings, method, p.name, std::to_string(value));
          EXPECT_EQ(settings.integer(p), value) << p.name;
        }
        EXPECT_NE(errorOf([&] {
                    setParameter(settings, method, p.name,
                                 std::to_string(static_cast<int64_t>(p.maximum) + 1));
                  }),
                  "")
            << p.name;
      }
      EXPECT_NE(errorOf([&] { setParameter(settings, method, p.name, "no such value"); }), "")
          << p.name;
      EXPECT_NE(errorOf([&] { setParameter(settings, method, p.name, ""); }), "") << p.name;
    }
  }
}

TEST(Parameters, AnUnknownNameListsTheKnownNames) {
  for (const MethodInfo& method : lamplighter::methods()) {
    Settings settings;
    const std::string error = errorOf([&] { setFromAssignment(settings, method, "colour=red"); });
    EXPECT_NE(error.find("'colour'"), std::string::npos);
    for (const ParameterSpec& p : method.parameters)
      EXPECT_NE(error.find(p.name), std::string::npos) << p.name;
  }
}

TEST(Parameters, AnAssignmentHasAnEqualsSign) {
  Settings settings;
  const MethodInfo& method = lamplighter::methods().front();
  EXPECT_NE(errorOf([&] { setFromAssignment(settings, method, "seed"); }).find("name=value"),
            std::string::npos);
  EXPECT_NE(errorOf([&] { setFromAssignment(settings, method, "=3"); }), "");
}

NodeId addCamera(Scene& scene, const std::string& name, const vec3& at) {
  const NodeId id = test::addNode(scene, name, kNoNode, at);
  scene.find(id)->camera = static_cast<int>(scene.cameras.size());
  scene.cameras.push_back(Camera{name + " lens", 0.7f, 0.0f, 0.01f, 0.0f});
  return id;
}

TEST(ChooseView, TakesCamerasByNameAndByNumber) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(2.0f));
  addCamera(scene, "hall", vec3(1, 2, 3));
  addCamera(scene, "door", vec3(4, 5, 6));
  const auto eye = [&](const char* camera) { return chooseView(scene, camera, 8, 6).eye; };
  EXPECT_EQ(eye(""), vec3(1, 2, 3));
  EXPECT_EQ(eye("0"), vec3(1, 2, 3));
  EXPECT_EQ(eye("1"), vec3(4, 5, 6));
  EXPECT_EQ(eye("door"), vec3(4, 5, 6));
  EXPECT_EQ(eye("door lens"), vec3(4, 5, 6));
  for (const char* none : {"2", "-1", "cellar", "1x"}) {
    const std::string error = errorOf([&] { eye(none); });
    EXPECT_NE(error.find("'hall', 'door'"), std::string::npos) << error;
  }
}

TEST(ChooseView, ASceneWithoutCamerasIsShownWhole) {
  Scene scene;
  test::addMesh(scene, test::boxMesh(vec3(4, 1, 2)), vec3(10, 0, 0));
  const View view = chooseView(scene, "", 64, 48);
  for (const float x : {8.0f, 12.0f}) {
    for (const float y : {-0.5f, 0.5f}) {
      for (const float z : {-1.0f, 1.0f}) {
        const vec3 p = view.project(vec3(x, y, z));
        EXPECT_TRUE(p.x >= 0 && p.x <= 64 && p.y >= 0 && p.y <= 48 && p.z > 0)
            << p.x << " " << p.y << " " << p.z;
      }
    }
  }
  EXPECT_NE(errorOf([&] { chooseView(scene, "0", 64, 48); }).find("it has none"),
            std::string::npos);
}

TEST(RequireWritable, ChecksInAdvanceAndLeavesNoFile) {
  const fs::path folder = fs::path(testing::TempDir()) / "lamplighter_writable";
  fs::remove_all(folder);
  fs::create_directories(folder / "folder.png");
  EXPECT_EQ(errorOf([&] { requireWritable(folder / "a.png", {".exr", ".png"}); }), "");
  EXPECT_EQ(errorOf([&] { requireWritable(folder / "a", {}); }), "");
  EXPECT_NE(errorOf([&] {
              requireWritable(folder / "a.jpg", {".exr", ".png"});
            }).find(".exr or .png"),
            std::string::npos);
  EXPECT_NE(errorOf([&] { requireWritable(folder / ".png", {".png"}); }), "");
  EXPECT_NE(errorOf([&] { requireWritable(folder / "folder.png", {".png"}); }), "");
  EXPECT_NE(errorOf([&] { requireWritable(folder / "none" / "a.png", {".png"}); }), "");
  EXPECT_NE(
      errorOf([&] { requireWritable(folder / std::string(300, 'a').append(".png"), {".png"}); }),
      "");
  EXPECT_NE(errorOf([] { requireWritable("/proc/a.png", {".png"}); }), "");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  fs::remove_all(folder);
}

TEST(WriteText, ReplacesTheWholeFile) {
  const fs::path file = fs::path(testing::TempDir()) / "lamplighter_text.json";
  writeFile(file, "a longer text");
  writeFile(file, "short");
  std::ifstream in(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "short");
  fs::remove(file);
}

TEST(Exposure, IsANumberOrAuto) {
  const Image image(4, 4, vec3(0.72f));
  EXPECT_EQ(exposureOf("-1.5", image), -1.5f);
  EXPECT_EQ(exposureOf("auto", image), -2.0f);  // 0.18 / 0.72 = 2⁻²
  for (const char* bad : {"", "bright", "1EV", "nan", "inf", "40"})
    EXPECT_NE(errorOf([&] { exposureOf(bad, image); }), "") << bad;
}

}  // namespace
}  // namespace lamplighter::cli
