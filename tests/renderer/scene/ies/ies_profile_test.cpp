// IES files: closed forms of their photometry, and malformed files.
#include "renderer/scene/ies/ies_profile.h"

#include <gmock/gmock.h>

#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/render_scene.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A file with the given angles and candela, ordered by horizontal angle.
std::string ies(int type, const std::string& vertical, const std::string& horizontal,
                const std::string& candela, int rows, int columns,
                const std::string& multiplier = "1",
                const std::string& head = "IESNA:LM-63-1995\n[TEST] one\nTILT=NONE\n") {
  return head + "1 1000 " + multiplier + " " + std::to_string(rows) + " " +
         std::to_string(columns) + " " + std::to_string(type) + " 2 0 0 0\n1.0 1.0 60\n" +
         vertical + "\n" + horizontal + "\n" + candela + "\n";
}

vec3 typeC(float vertical, float horizontal) {
  const float v = glm::radians(vertical), h = glm::radians(horizontal);
  return {std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), -std::cos(v)};
}
vec3 typeB(float vertical, float horizontal) {
  const float v = glm::radians(vertical), h = glm::radians(horizontal);
  return {std::sin(h), std::cos(h) * std::sin(v), -std::cos(h) * std::cos(v)};
}

TEST(IesProfile, AUniformOneGivesFourPi) {
  const auto p = parseIes(ies(1, "0 90 180", "0", "50 50 50", 3, 1, "2"), "even.ies");
  EXPECT_FLOAT_EQ(p->peak, 100.0f);
  EXPECT_NEAR(p->solidAngle, 4.0f * kPi, 1e-3f);
  EXPECT_FLOAT_EQ(p->at({0.6f, 0.0f, 0.8f}), 1.0f);
}

// cos θ below the horizon: ∫ = π. Linear interpolation between steps of 5° gives slightly less.
TEST(IesProfile, ALambertianOneGivesPi) {
  std::string vertical, candela;
  for (int v = 0; v <= 90; v += 5) {
    vertical += std::to_string(v) + " ";
    candela += std::to_string(300.0 * std::cos(v * 3.14159265358979 / 180.0)) + " ";
  }
  const auto p = parseIes(ies(1, vertical, "0", candela, 19, 1), "lambert.ies");
  EXPECT_NEAR(p->peak * p->solidAngle, 300.0f * kPi, 2.0f);
  EXPECT_NEAR(p->at(typeC(60, 123)), 0.5f, 1e-3f);
  EXPECT_EQ(p->at(typeC(91, 0)), 0.0f);  // beyond the last angle
}

TEST(IesProfile, InterpolatesBetweenAngles) {
  const auto p =
      parseIes(ies(1, "0 90", "0 90 180 270 360", "10 0 20 0 30 0 40 0 10 0", 2, 5), "turn.ies");
  EXPECT_NEAR(p->at(typeC(45, 90)) * p->peak, 10.0f, 1e-4f);
  EXPECT_NEAR(p->at(typeC(45, 45)) * p->peak, 7.5f, 1e-3f);
  EXPECT_NEAR(p->at(typeC(45, 315)) * p->peak, 12.5f, 1e-3f);
}

TEST(IesProfile, MirrorsHalvesAndQuarters) {
  const auto quarter = parseIes(ies(1, "0 180", "0 90", "1 1 3 3", 2, 2), "quarter.ies");
  for (const float h : {30.0f, 150.0f, 210.0f, 330.0f})
    EXPECT_NEAR(quarter->at(typeC(90, h)) * 3.0f, 1.0f + 2.0f * 30.0f / 90.0f, 1e-3f) << h;
  const auto half = parseIes(ies(1, "0 180", "0 180", "1 1 3 3", 2, 2), "half.ies");
  EXPECT_NEAR(half->at(typeC(90, 240)) * 3.0f, 1.0f + 2.0f * 120.0f / 180.0f, 1e-3f);
  const auto turned = parseIes(ies(1, "0 180", "90 270", "1 1 3 3", 2, 2), "turned.ies");
  EXPECT_NEAR(turned->at(typeC(90, 0)) * 3.0f, 2.0f, 1e-3f);
  EXPECT_NEAR(turned->at(typeC(90, 300)) * 3.0f, 1.0f + 2.0f * 150.0f / 180.0f, 1e-3f);
  EXPECT_NEAR(turned->at(typeC(90, 60)) * 3.0f, 1.0f + 2.0f * 30.0f / 180.0f, 1e-3f);
}

TEST(IesProfile, TypeBHasAHorizontalPole) {
  // A beam along the aim, 10° high and 40° wide.
  const auto p = parseIes(ies(2, "-90 -10 0 10 90", "-90 -40 0 40 90",
                              "0 0 0 0 0  0 0 0 0 0  0 0 100 0 0  0 0 0 0 0  0 0 0 0 0", 5, 5),
                          "flood.ies");
  EXPECT_TRUE(p->isTypeB);
  EXPECT_NEAR(p->at({0, 0, -1}), 1.0f, 1e-4f);
  EXPECT_NEAR(p->at(typeB(5, 0)), 0.5f, 1e-3f);
  EXPECT_NEAR(p->at(typeB(0, 20)), 0.5f, 1e-3f);
  EXPECT_NEAR(p->at(typeB(-5, 20)), 0.25f, 1e-3f);
  EXPECT_EQ(p->at({0, 1, 0}), 0.0f);
  EXPECT_EQ(p->at({0, 0, 1}), 0.0f);
  // One half is mirrored.
  const auto mirrored =
      parseIes(ies(2, "0 10 90", "0 40 90", "100 0 0 0 0 0 0 0 0", 3, 3), "m.ies");
  EXPECT_NEAR(mirrored->at(typeB(-5, -20)), 0.25f, 1e-3f);
}

TEST(IesProfile, ReadsEveryVersion) {
  const std::string rest = "0 90", h = "0", c = "7 0";
  for (const char* head : {"TILT=NONE\n", "IESNA91\n[MANUFAC] x\nTILT=NONE\r\n",
                           "IESNA:LM-63-2002\n[OTHER]\nTILT=NONE\n",
                           "some lamp of 1986\nTILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n"}) {
    const auto p = parseIes(ies(1, rest, h, c, 2, 1, "1", head), "x.ies");
    EXPECT_FLOAT_EQ(p->peak, 7.0f) << head;
  }
  // Numbers may be split over lines at any place, and separated by commas.
  const auto p = parseIes("TILT=NONE\n1,1000,1\n2 1 1\n2 0 0 0 1\n1 60 0\n90 0 +7\n.5e1", "x.ies");
  EXPECT_NEAR(p->at(typeC(90, 0)), 5.0f / 7.0f, 1e-5f);
}

// The factors depend on the angle from straight down, with linear interpolation.
TEST(IesProfile, TiltFactorsFollowTheAimsAngle) {
  const std::string head = "IESNA:LM-63-2002\nTILT=INCLUDE\n3\n3\n0 45 90\n1 0.8 0.5\n";
  const auto p = parseIes(ies(1, "0 90", "0", "7 7", 2, 1, "1", head), "tilted.ies");
  const auto aimed = [](float degrees, float about = 0.0f) {
    const float a = glm::radians(degrees), b = glm::radians(about);
    return vec3(std::sin(a) * std::cos(b), -std::cos(a), std::sin(a) * std::sin(b));
  };
  EXPECT_FLOAT_EQ(p->atTilt(aimed(0)), 1.0f);
  EXPECT_NEAR(p->atTilt(aimed(22.5f, 33)), 0.9f, 1e-4f);
  EXPECT_NEAR(p->atTilt(aimed(45, 200)), 0.8f, 1e-4f);
  EXPECT_NEAR(p->atTilt(aimed(90)), 0.5f, 1e-4f);
  EXPECT_FLOAT_EQ(p->atTilt(aimed(180)), 0.5f);  // beyond the last angle
  const auto plain = parseIes(ies(1, "0 90", "0", "7 7", 2, 1), "plain.ies");
  EXPECT_EQ(plain->atTilt(aimed(70)), 1.0f);
}

// When the lamp is rotated by an edit, the tilt factor changes its brightness.
TEST(IesProfile, TheRendererAppliesTheTiltFactor) {
  const std::string head = "TILT=INCLUDE\n1\n2\n0 90\n1 0.5\n";
  Scene scene;
  const NodeId id = test::addNode(scene, "lamp");
  PunctualLight light{PunctualKind::point, vec3(8.0f)};
  light.profile = parseIes(ies(1, "0 90", "0", "7 7", 2, 1, "1", head), "tilted.ies");
  scene.find(id)->punctual = light;
  scene.find(id)->local.rotation = glm::angleAxis(-0.5f * kPi, vec3(1, 0, 0));  // straight down
  RenderScene live = test::renderSceneOf(scene);
  EXPECT_NEAR(live.punctuals[0].light.intensity.g, 8.0f, 1e-4f);
  const Scene before = scene;
  scene.find(id)->local.rotation = quat(1, 0, 0, 0);
  update(live, scene, compare(before, scene));
  EXPECT_NEAR(live.punctuals[0].light.intensity.g, 4.0f, 1e-4f);
}

// The lobes by which VPLs approximate typical luminaires: the error over all directions, and that
// no flux is lost.
TEST(IesProfile, LobesApproximateTheProfile) {
  struct Kind {
    const char* name;
    float (*at)(float vertical, float horizontal);  // degrees
    double mostError;
  };
  const auto cosine = [](float degrees) { return std::max(std::cos(glm::radians(degrees)), 0.0f); };
  static const auto kCosine = cosine;
  static constexpr float kWide = 1.0f;
  const Kind kinds[] = {
      {"even", [](float, float) { return kWide; }, 1e-3},
      {"down", [](float v, float) { return kCosine(v); }, 0.05},
      {"beam", [](float v, float) { return std::pow(kCosine(v), 40.0f); }, 0.05},
      {"batwing",
       [](float v, float) {
         return kCosine(v) * (0.3f + std::pow(std::sin(glm::radians(v)), 2.0f) * 2.0f);
       },
       0.10},
      {"up and down",
       [](float v, float) { return v < 90.0f ? kCosine(v) : 0.5f * kCosine(180.0f - v); }, 0.05},
      {"wall washer",
       [](float v, float h) { return kCosine(v) * (1.0f + 0.8f * std::cos(glm::radians(h))); },
       0.12},
  };
  for (const Kind& kind : kinds) {
    std::string vertical, horizontal, candela;
    for (int v = 0; v <= 180; v += 5) vertical += std::to_string(v) + " ";
    for (int h = 0; h <= 360; h += 15) {
      horizontal += std::to_string(h) + " ";
      for (int v = 0; v <= 180; v += 5)
        candela +=
            std::to_string(1000.0f * kind.at(static_cast<float>(v), static_cast<float>(h))) + " ";
    }
    const auto p = parseIes(ies(1, vertical, horizontal, candela, 37, 25), "kind.ies");
    ASSERT_LE(p->lobes.size(), kMostLobes);
    double wrong = 0.0, all = 0.0, flux = 0.0, wanted = 0.0;
    for (float v = 1.0f; v < 180.0f; v += 2.0f) {
      for (float h = 1.0f; h < 360.0f; h += 4.0f) {
        const vec3 d = typeC(v, h);
        const double weight = std::sin(glm::radians(v));
        double sum = 0.0;
        for (const SpotLobe& lobe : p->lobes) {
          EXPECT_GT(lobe.intensity, 0.0f);
          sum += lobe.at(d);
        }
        const double here = p->at(d);
        wrong += weight * (sum - here) * (sum - here);
        all += weight * here * here;
        flux += weight * sum;
        wanted += weight * here;
      }
    }
    RecordProperty(kind.name, std::to_string(std::sqrt(wrong / all)));
    EXPECT_LT(std::sqrt(wrong / all), kind.mostError) << kind.name;
    EXPECT_NEAR(flux / wanted, 1.0, 0.01) << kind.name;
  }
}

TEST(IesProfile, BadFilesGiveOneClearLine) {
  const std::string good = ies(1, "0 90", "0", "7 0", 2, 1);
  std::vector<std::string> bad = {
      "", "hello", "TILT=NONE\n", "TILT=lamp.tlt\n1 2 3", ies(3, "0 90", "0", "7 0", 2, 1),
      ies(1, "0 90", "0", "7 -1", 2, 1), ies(1, "0 90", "0", "0 0", 2, 1),
      ies(1, "90 0", "0", "7 0", 2, 1), ies(1, "0 90", "0", "7", 2, 1),
      ies(1, "0 90", "0", "7 x", 2, 1), ies(1, "0 90", "0 33", "7 0 7 0", 2, 2),
      ies(1, "0 190", "0", "7 0", 2, 1), ies(1, "0 90", "0", "7 nan", 2, 1),
      ies(1, "0 90", "0", "7 1e300", 2, 1), ies(1, "0 90", "0", "7 0", 2, 1, "-1"),
      ies(1, "0 90", "0", "7 0", -2, 1), ies(1, "0 90", "0", "7 0", 2, 0),
      // Counts of a billion values in a file of a hundred bytes.
      ies(1, "0 90", "0", "7 0", 100000, 100000), "TILT=INCLUDE\n1 99999 0 1 2",
      "TILT=INCLUDE\n4 1 0 1\n", "TILT=INCLUDE\n1 2 90 0 1 1\n", "TILT=INCLUDE\n1 1 0 -1\n",
      "TILT=INCLUDE\n1 1 0 0\n", std::string(100, '\0')};
  for (size_t i = 0; i + 12 < good.size(); ++i) bad.push_back(good.substr(0, i));
  for (const std::string& text : bad) {
    try {
      parseIes(text, "bad.ies");
      ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& e) {
      const std::string what = e.what();
      EXPECT_THAT(what, testing::StartsWith("bad.ies: "));
      EXPECT_EQ(what.find('\n'), std::string::npos);
    }
  }
  EXPECT_THROW(readIes("/nowhere/gone.ies"), InputError);
}

TEST(IesProfile, IsSavedBesideTheScene) {
  const test::TemporaryFolder folder, other;
  Scene scene;
  test::addMesh(scene, test::squareMesh(1.0f));
  const NodeId id = test::addNode(scene, "bulb");
  const auto profile = parseIes(ies(1, "0 90", "0", "7 0", 2, 1), "a lamp.ies");
  scene.find(id)->punctual = PunctualLight{PunctualKind::point, vec3(2)};
  scene.find(id)->punctual->profile = profile;
  const NodeId second = test::addNode(scene, "bulb 2");
  scene.find(second)->punctual = scene.find(id)->punctual;
  saveGltf(scene, folder.path() / "s.gltf");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a lamp.ies"));
  const Scene loaded = loadGltf(folder.path() / "s.gltf").scene;
  ASSERT_TRUE(loaded.nodes[1].punctual && loaded.nodes[1].punctual->profile);
  EXPECT_EQ(*loaded.nodes[1].punctual->profile, *profile);
  EXPECT_EQ(loaded.nodes[2].punctual->profile, loaded.nodes[1].punctual->profile);
  // When the scene is saved to another folder, the file is copied once.
  saveGltf(loaded, other.path() / "s.glb");
  EXPECT_EQ(loadGltf(other.path() / "s.glb").scene.nodes[1].punctual, loaded.nodes[1].punctual);
  // If the file is missing, there is a warning, and the light has no profile.
  std::filesystem::remove(folder.path() / "a lamp.ies");
  const LoadedScene without = loadGltf(folder.path() / "s.gltf");
  EXPECT_FALSE(without.scene.nodes[1].punctual->profile);
  ASSERT_EQ(without.warnings.size(), 1u);
  EXPECT_THAT(without.warnings[0], testing::HasSubstr("lamp.ies"));
}

}  // namespace
}  // namespace lamplighter
