// The command line as other programs use it.
#include <filesystem>
#include <fstream>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "renderer/image/image_io.h"
#include "renderer/image/tone_map.h"
#include "renderer/registry/registry.h"
#include "tests/support/folders.h"
#include "tests/support/process.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::lines;
using test::ProcessResult;
using test::runLamplighter;

const std::string kScene = (test::sourceFolder() / "assets/scenes/cornell_style.gltf").string();

class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("lamplighter_cli_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string text(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  static void expectOneError(const ProcessResult& r, const std::string& part) {
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(lines(r.err), 1) << r.err;
    EXPECT_TRUE(r.err.starts_with("error: ")) << r.err;
    EXPECT_NE(r.err.find(part), std::string::npos) << r.err;
  }

  fs::path folder_;
};

TEST_F(CommandLine, TheSkyCanBeReplaced) {
  const std::string scene = file("dark.gltf");
  std::ofstream(scene) << R"({"asset":{"version":"2.0"}})";  // only the sky is visible
  const auto mean = [&](const std::vector<std::string>& more) {
    std::vector<std::string> call{"render", scene, "-o",    file("a.exr"), "--size",    "16x8",
                                  "--vpls", "8",   "--set", "antialias=1", "--backend", "cpu"};
    call.insert(call.end(), more.begin(), more.end());
    const ProcessResult r = runLamplighter(call);
    EXPECT_EQ(r.code, 0) << r.err;
    const Image image = readImage(file("a.exr"));
    vec3 sum(0.0f);
    for (const vec3& p : image.pixels) sum += p / static_cast<float>(image.pixels.size());
    return sum;
  };
  EXPECT_NEAR(mean({"--sky", "0.25,0.5,0.75"}).g, 0.5f, 1e-5f);
  EXPECT_NEAR(mean({"--sky", "none"}).g, 0.0f, 1e-5f);
  EXPECT_NEAR(mean({"--sky", "gradient:0.5,0.5,0.5/0.5,0.5,0.5/0.5,0.5,0.5"}).b, 0.5f, 1e-5f);
  writeExr(Image(8, 4, vec3(0.3f)), file("sky.exr"));
  EXPECT_NEAR(mean({"--sky", file("sky.exr"), "--sky-scale", "2"}).r, 0.6f, 1e-4f);

  const auto bad = [&](const std::vector<std::string>& more, const std::string& part) {
    std::vector<std::string> call{"render", scene, "-o", file("a.exr")};
    call.insert(call.end(), more.begin(), more.end());
    expectOneError(runLamplighter(call), part);
  };
  bad({"--sky", "1,2"}, "is not a radiance");
  bad({"--sky", "1,2,-3"}, "is not a radiance");
  bad({"--sky", "gradient:1,2,3"}, "is not a gradient");
  bad({"--sky", file("gone.exr")}, "does not exist");
  bad({"--sky", scene}, "no known image format");
  bad({"--sky", "1,1,1", "--sky-rotation", "90"}, "the sky is not a picture");
  bad({"--sky", file("sky.exr"), "--sky-scale", "-1"}, "--sky-scale");
}

TEST_F(CommandLine, BadUseIsOneLineAndCode2) {
  expectOneError(runLamplighter({"render"}), "SCENE");
  expectOneError(runLamplighter({"render", kScene}), "--output");
  expectOneError(runLamplighter({"render", kScene, "-o", file("a.jpg")}), ".exr or .png");
  expectOneError(runLamplighter({"render", kScene, "-o", file("none/a.png")}),
                 "folder does not exist");
  expectOneError(runLamplighter({"render", kScene, "-o", file("a.png"), "--size", "12"}),
                 "is not a size");
  expectOneError(runLamplighter({"render", kScene, "-o", file("a.png"), "--size", "0x5"}),
                 "is not a size");
  expectOneError(runLamplighter({"render", kScene, "-o", file("a.png"), "--method", "magic"}),
                 "magic");
  expectOneError(runLamplighter({"render", kScene, "-o", file("a.png"), "--camera", "nobody"}),
                 "nobody");
  expectOneError(runLamplighter({"render", kScene, "-o", file("a.png"), "--set", "colour=red"}),
                 "colour");
  expectOneError(runLamplighter({"render", kScene, "-o", file("a.png"), "--set", "vpls"}),
                 "name=value");
  expectOneError(runLamplighter({"render", kScene, "-o", file("a.png"), "--vpls", "many"}), "many");
  expectOneError(runLamplighter({"render", kScene, "-o", file("a.png"), "--backend", "abacus"}),
                 "backend");
  expectOneError(runLamplighter({"info", file("absent.gltf")}), "absent.gltf");
  expectOneError(runLamplighter({"compare", file("a.exr"), file("b.exr")}), "a.exr");
  expectOneError(runLamplighter({"--frobnicate"}), "--frobnicate");
  expectOneError(runLamplighter({"replay", file("absent.jsonl"), "--headless"}), "absent.jsonl");
  EXPECT_TRUE(fs::is_empty(folder_)) << "nothing may be half-written";
}

#ifndef __SANITIZE_ADDRESS__  // which reserves more memory than the limit

// Limits the memory of the programs that are started during its lifetime.
class MemoryLimit {
 public:
  explicit MemoryLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_AS, &before_);
    const rlimit now{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_AS, &now);
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

TEST_F(CommandLine, LackOfMemoryIsOneLine) {
  const MemoryLimit limit(rlim_t{1500} << 20);
  const std::vector<std::string> large{"--size", "16384x16384", "--backend", "cpu"};
  std::vector<std::string> call{"render", kScene, "-o", file("a.png")};
  call.insert(call.end(), large.begin(), large.end());
  expectOneError(runLamplighter(call), "out of memory");
  EXPECT_TRUE(fs::is_empty(folder_)) << "nothing may be half-written";

  std::ofstream(file("actions.txt")) << "app.screenshot " << file("a.png") << '\n';
  call = {"script", file("actions.txt"), kScene};
  call.insert(call.end(), large.begin(), large.end());
  expectOneError(runLamplighter(call), "out of memory");
  EXPECT_FALSE(fs::exists(file("a.png")));
}

#endif

TEST_F(CommandLine, HelpAndVersionWork) {
  for (const char* sub : {"info", "render", "methods", "compare", "replay"}) {
    const ProcessResult r = runLamplighter({sub, "--help"});
    EXPECT_EQ(r.code, 0);
    EXPECT_NE(r.out.find("Usage"), std::string::npos) << sub;
  }
  EXPECT_EQ(runLamplighter({"--version"}).code, 0);
}

TEST_F(CommandLine, AnErrorNamesTheHelpOfItsSubcommand) {
  expectOneError(runLamplighter({"render", kScene, "-o", file("a.png"), "--frobnicate"}),
                 "'lamplighter render --help'");
  expectOneError(runLamplighter({"render", kScene, "-o"}), "--output");
}

TEST_F(CommandLine, EveryFlagIsInTheDocs) {
  std::ifstream in(test::sourceFolder() / "docs/reference/cli.md");
  const std::string docs{std::istreambuf_iterator<char>(in), {}};
  for (const char* sub : {"info", "render", "methods", "actions", "settings", "compare", "converge",
                          "tiles", "tonemap", "replay"}) {
    const std::string help = runLamplighter({sub, "--help"}).out;
    EXPECT_NE(help.find("Example: lamplighter " + std::string(sub)), std::string::npos) << sub;
    const size_t from = docs.find("\n## " + std::string(sub) + "\n");
    ASSERT_NE(from, std::string::npos) << sub;
    const std::string section = docs.substr(from, docs.find("\n## ", from + 1) - from);
    const std::regex flag("--[a-z][a-z-]*");
    for (std::sregex_iterator i(help.begin(), help.end(), flag), end; i != end; ++i) {
      if (i->str() == "--help") continue;
      EXPECT_NE(section.find(i->str()), std::string::npos) << sub << " " << i->str();
    }
  }
}

TEST_F(CommandLine, InfoWritesCountsAsJson) {
  const ProcessResult r = runLamplighter({"info", kScene, "--json"});
  ASSERT_EQ(r.code, 0) << r.err;
  const json j = json::parse(r.out);
  EXPECT_GT(j["triangles"].get<int>(), 10);
  EXPECT_GE(j["lights"].size(), 1u);
  EXPECT_GE(j["cameras"].size(), 1u);
  EXPECT_EQ(j["light_counts"], json::parse(R"({"rectangle": 1})"));
  EXPECT_EQ(j["cameras"][0]["name"], "camera");
  EXPECT_EQ(j["extensions"], json::parse(R"(["EXT_lights_area"])"));
  EXPECT_TRUE(j["warnings"].empty());
  EXPECT_EQ(runLamplighter({"info", kScene}).code, 0);
}

TEST_F(CommandLine, MethodsListEveryParameter) {
  const json j = json::parse(runLamplighter({"methods", "--json"}).out);
  ASSERT_GE(j.size(), 2u);
  for (const json& m : j) {
    EXPECT_FALSE(m["citation"].get<std::string>().empty());
    for (const json& p : m["parameters"]) {
      EXPECT_FALSE(p["help"].get<std::string>().empty()) << p["name"];
      EXPECT_TRUE(p.contains("default"));
    }
  }
}

TEST_F(CommandLine, TheTableOfParametersIsUpToDate) {
  std::ifstream in(test::sourceFolder() / "docs/reference/parameters.md");
  const std::string written{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(runLamplighter({"methods", "--markdown"}).out, written)
      << "run: lamplighter methods --markdown > docs/reference/parameters.md";
}

TEST_F(CommandLine, EveryActionSaysWhatItDoesAndTheTableIsUpToDate) {
  const json j = json::parse(runLamplighter({"actions", "--json"}).out);
  ASSERT_GE(j.size(), 50u);
  std::map<std::string, std::string> ofKey;
  for (const json& a : j) {
    EXPECT_FALSE(a["label"].get<std::string>().empty()) << a["name"];
    EXPECT_FALSE(a["help"].get<std::string>().empty()) << a["name"];
    const std::string key = a["shortcut"];
    if (key.empty()) continue;
    EXPECT_TRUE(ofKey.emplace(key, a["name"]).second)
        << key << " is " << ofKey[key] << " and " << a["name"];
  }
  std::ifstream in(test::sourceFolder() / "docs/reference/actions.md");
  const std::string written{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(runLamplighter({"actions", "--markdown"}).out, written)
      << "run: lamplighter actions --markdown > docs/reference/actions.md";
}

// The committed manual equals the output of the program.
TEST_F(CommandLine, ManualIsUpToDate) {
  const std::pair<const char*, const char*> kinds[] = {{"--markdown", "docs/reference/flags.md"},
                                                       {"--man", "docs/reference/lamplighter.1"}};
  for (const auto& [kind, path] : kinds) {
    std::ifstream in(test::sourceFolder() / path);
    const std::string written{std::istreambuf_iterator<char>(in), {}};
    const std::string now = runLamplighter({"manual", kind}).out;
    EXPECT_EQ(now, written) << "run: lamplighter manual " << kind << " > " << path;
    for (const char* command : {"info", "render", "bake", "replay", "script"})
      EXPECT_NE(now.find(command), std::string::npos) << command;
  }
}

TEST_F(CommandLine, RendersEveryMethodToExrAndPng) {
  for (const char* method : {"many_lights", "reference"}) {
    for (const char* ending : {".exr", ".png"}) {
      const std::string out = file(std::string(method) + ending);
      const ProcessResult r = runLamplighter({"render", kScene, "-o", out, "--method", method,
                                              "--size", "48x32", "--backend", "cpu", "--bounces",
                                              "1", "--spp", "2", "--stats", file("stats.json")});
      ASSERT_EQ(r.code, 0) << r.err;
      EXPECT_EQ(r.err.find("error"), std::string::npos);
      const Image image = readImage(out);
      EXPECT_EQ(image.width, 48);
      EXPECT_EQ(image.height, 32);
      vec3 sum(0.0f);
      for (const vec3& p : image.pixels) sum += p;
      EXPECT_GT(sum.r + sum.g + sum.b, 1.0f);
      const json stats = json::parse(text("stats.json"));
      EXPECT_EQ(stats["backend"], "cpu");
      EXPECT_TRUE(stats["settled"].get<bool>());
      EXPECT_FALSE(stats["stages"].empty());
    }
  }
}

TEST_F(CommandLine, SetChangesADeclaredParameter) {
  for (const auto& [assignment, wanted] : {std::pair{"vpls=17", 17}, std::pair{"vpls=40", 40}}) {
    ASSERT_EQ(
        runLamplighter({"render", kScene, "-o", file("a.exr"), "--size", "16x16", "--backend",
                        "cpu", "--bounces", "0", "--set", assignment, "--stats", file("s.json")})
            .code,
        0);
    EXPECT_EQ(json::parse(text("s.json"))["vpls"], wanted);
  }
}

TEST_F(CommandLine, EachShortcutFlagSetsTheParameterOfItsName) {
  // --set is before the scene, which shows that it takes only one word. With light samples alone
  // each of these parameters matters.
  const auto pixels = [&](const std::string& flag, const std::string& assignment) {
    const ProcessResult r =
        runLamplighter({"render", "--set", assignment, kScene, "-o", file("a.exr"), "--size",
                        "24x16", "--backend", "cpu", "--set", "indirect=samples", flag});
    EXPECT_EQ(r.code, 0) << r.err;
    return readImage(file("a.exr")).pixels;
  };
  const auto plain = pixels("--vpls=60", "bounces=2");
  const auto differs = [&](const std::vector<vec3>& other) { return other != plain; };
  for (const auto& [flag, assignment] :
       {std::pair{"--vpls=50", "vpls=50"}, std::pair{"--bounces=0", "bounces=0"},
        std::pair{"--direct-share=0.2", "direct_share=0.2"}, std::pair{"--seed=7", "seed=7"},
        std::pair{"--spp=3", "antialias=3"}}) {
    const bool isVpls = std::string(flag).starts_with("--vpls");
    const auto byFlag = pixels(flag, isVpls ? "bounces=2" : "vpls=60");
    const auto byAssignment = pixels(isVpls ? "--bounces=2" : "--vpls=60", assignment);
    EXPECT_TRUE(differs(byFlag)) << flag;
    EXPECT_TRUE(byFlag == byAssignment) << flag;
  }
}

TEST_F(CommandLine, CamerasAreChosenByNameAndNumber) {
  const auto pixels = [&](std::vector<std::string> flags) {
    std::vector<std::string> words{"render",    kScene,  "-o",        file("a.exr"),
                                   "--size",    "24x16", "--backend", "cpu",
                                   "--bounces", "0",     "--vpls",    "8"};
    words.insert(words.end(), flags.begin(), flags.end());
    EXPECT_EQ(runLamplighter(words).code, 0);
    return readImage(file("a.exr")).pixels;
  };
  EXPECT_EQ(pixels({"--camera", "camera"}), pixels({"--camera", "0"}));
}

TEST_F(CommandLine, PngIsTheToneMappedExr) {
  for (const char* ending : {".exr", ".png"}) {
    ASSERT_EQ(runLamplighter({"render", kScene, "-o", file(std::string("a") + ending), "--size",
                              "24x16", "--backend", "cpu", "--vpls", "16", "--exposure", "-1"})
                  .code,
              0);
  }
  writePng(toneMap(readImage(file("a.exr")), -1.0f), file("b.png"));
  EXPECT_EQ(readImage(file("a.png")).pixels, readImage(file("b.png")).pixels);
  ASSERT_EQ(
      runLamplighter({"tonemap", file("a.exr"), "-o", file("c.png"), "--exposure", "-1"}).code, 0);
  EXPECT_EQ(text("c.png"), text("b.png"));
}

TEST_F(CommandLine, StatisticsHaveTheDocumentedNames) {
  ASSERT_EQ(
      runLamplighter({"render", kScene, "-o", file("a.png"), "--size", "24x16", "--backend", "cpu",
                      "--vpls", "16", "--set", "technique=visibility", "--stats", file("s.json")})
          .code,
      0);
  const json j = json::parse(text("s.json"));
  for (const char* key :
       {"vpls", "shadow_maps", "rays", "light_pixels", "map_look_ups", "visibility_tests",
        "memory_bytes", "peak_memory_bytes", "frames", "width", "height"}) {
    EXPECT_GT(j[key].get<double>(), 0.0) << key;
  }
  for (const StatisticSpec& spec : findMethod("many_lights").statistics)
    EXPECT_TRUE(j.contains(spec.name)) << spec.name;
  for (const char* stage : {"shadow maps", "light sums", "g-buffer"})
    EXPECT_GT(j["stages"][stage].get<double>(), 0.0) << stage;
  EXPECT_GT(j["seconds"]["total"].get<double>(), 0.0);
  EXPECT_FALSE(j["device"].get<std::string>().empty());
}

TEST_F(CommandLine, FullDisksAreErrors) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  expectOneError(test::runLamplighter({"methods"}, "/dev/full"), "standard output");
}

TEST_F(CommandLine, TheSameBitsAtAnyNumberOfThreads) {
  for (const char* method : {"many_lights", "reference"}) {
    for (const char* threads : {"1", "2", "5"}) {
      ASSERT_EQ(runLamplighter({"render", kScene, "-o", file(std::string(threads) + ".exr"),
                                "--method", method, "--size", "40x30", "--backend", "cpu", "--spp",
                                "2", "--threads", threads})
                    .code,
                0);
    }
    EXPECT_EQ(readImage(file("1.exr")).pixels, readImage(file("2.exr")).pixels) << method;
    EXPECT_EQ(readImage(file("1.exr")).pixels, readImage(file("5.exr")).pixels) << method;
  }
}

TEST_F(CommandLine, CompareMeasuresAndChecks) {
  writeExr(Image(8, 8, vec3(1.1f)), file("a.exr"));
  writeExr(Image(8, 8, vec3(1.0f)), file("b.exr"));
  writeExr(Image(4, 8, vec3(1.0f)), file("small.exr"));
  const ProcessResult r = runLamplighter(
      {"compare", file("a.exr"), file("b.exr"), "--json", "--heatmap", file("h.png")});
  ASSERT_EQ(r.code, 0) << r.err;
  const json j = json::parse(r.out);
  EXPECT_NEAR(j["relRMSE"].get<double>(), 0.1, 1e-6);
  EXPECT_NEAR(j["bias"].get<double>(), 1.1, 1e-6);
  EXPECT_TRUE(fs::exists(file("h.png")));
  EXPECT_EQ(runLamplighter({"compare", file("a.exr"), file("b.exr"), "--max-relrmse", "0.2"}).code,
            0);
  EXPECT_EQ(runLamplighter({"compare", file("a.exr"), file("b.exr"), "--max-relrmse", "0.05"}).code,
            1);
  expectOneError(runLamplighter({"compare", file("a.exr"), file("small.exr")}),
                 "cannot be compared");
}

TEST_F(CommandLine, WithoutADisplayTheEditorReportsAnError) {
  expectOneError(runLamplighter({kScene}), "display");
}

}  // namespace
}  // namespace lamplighter
