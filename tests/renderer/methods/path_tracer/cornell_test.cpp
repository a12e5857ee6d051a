// The path tracer against pictures of the Cornell box from an independent renderer. The noise of
// those pictures is 0.13% (direct light), 0.74% (one bounce) and 0.59% (five bounces) of the mean,
// see noise.csv in their folder. To keep the number of paths small, three things are compared: the
// brightness of the whole picture; means over blocks of 16×16 pixels, where the noise of both is
// small; and the pixels, whose difference is corrected for noise, which is known from two halves
// with different seeds.
#include <cmath>
#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/folders.h"
#include "tests/support/scenes/scene_files.h"

namespace lamplighter {
namespace {

const std::filesystem::path kReferences = test::sharedFolder() / "references";

Image pathTraced(const Scene& scene, const View& view, int bounces, int samples, int seed) {
  Settings settings;
  settings.set("bounces", bounces);
  settings.set("seed", seed);
  settings.set("samples_per_pixel", samples);
  settings.set("samples_per_frame", samples);
  FrameRenderer renderer(makeCpuBackend());
  const GiOutput out = renderer.render({scene, SceneChanges::all(), view, "reference", settings});
  EXPECT_TRUE(out.settled);
  return out.radiance->pixels();
}

// The mean over the masked pixels of each block of 16×16 pixels. `covered` receives 1 where the
// mask contains at least half of the block.
Image blockMeans(const Image& image, const Image& mask, Image& covered) {
  constexpr int kSide = 16;
  Image out(image.width / kSide, image.height / kSide);
  covered = out;
  for (int by = 0; by < out.height; ++by) {
    for (int bx = 0; bx < out.width; ++bx) {
      glm::dvec3 sum(0.0);
      int n = 0;
      for (int i = 0; i < kSide * kSide; ++i) {
        const int x = kSide * bx + i % kSide, y = kSide * by + i / kSide;
        if (mask.at(x, y).r <= 0.5f) continue;
        sum += glm::dvec3(image.at(x, y));
        ++n;
      }
      if (n > 0) out.at(bx, by) = vec3(sum / static_cast<double>(n));
      covered.at(bx, by) = vec3(2 * n >= kSide * kSide ? 1.0f : 0.0f);
    }
  }
  return out;
}

struct Case {
  const char* scene;
  int bounces;
  int samples;   // per pixel, in each half
  double noise;  // of the independent picture, relative to its mean
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << ", " << c.samples; }

class ReferenceCornell : public testing::TestWithParam<Case> {};

TEST_P(ReferenceCornell, AgreesWithTheIndependentPicture) {
  if (!std::filesystem::exists(kReferences)) GTEST_SKIP() << "no " << kReferences;
  const Case& c = GetParam();
  const std::string name = c.scene;
  const Scene scene = loadGltf(kReferences / "scenes" / (name + ".gltf")).scene;
  const View view = test::viewOf(scene, 512, 384);
  const Image first = pathTraced(scene, view, c.bounces, c.samples, 1);
  const Image second = pathTraced(scene, view, c.bounces, c.samples, 2);
  Image both = first;
  for (size_t i = 0; i < both.pixels.size(); ++i)
    both.pixels[i] = 0.5f * (first.pixels[i] + second.pixels[i]);

  const Image reference =
      readImage(kReferences / "refs" / (name + "_b" + std::to_string(c.bounces) + ".exr"));
  const Image mask = readImage(kReferences / "refs" / (name + "_mask.exr"));
  const Metrics pixels = compareImages(both, reference, &mask);
  EXPECT_LT(std::abs(pixels.bias - 1.0), 0.005);

  Image covered;
  const Image ours = blockMeans(both, mask, covered), theirs = blockMeans(reference, mask, covered);
  const double blocks = compareImages(ours, theirs, &covered).relRmse;
  EXPECT_LT(blocks, 0.01);

  // The difference of the halves is twice the noise of their mean.
  const double own = 0.5 * compareImages(first, second, &mask).relRmse;
  const double rest = pixels.relRmse * pixels.relRmse - own * own - c.noise * c.noise;
  EXPECT_LT(rest, 0.01 * 0.01);
  RecordProperty("bias", std::to_string(pixels.bias));
  RecordProperty("relRmse", std::to_string(pixels.relRmse));
  RecordProperty("ownNoise", std::to_string(own));
  RecordProperty("relRmseOfBlocks", std::to_string(blocks));
}

INSTANTIATE_TEST_SUITE_P(
    Bounces, ReferenceCornell,
    testing::Values(Case{"cornell", 0, 8, 0.00127}, Case{"cornell", 1, 16, 0.00735},
                    Case{"cornell", 5, 16, 0.00589}, Case{"cornell_lightmoved", 1, 16, 0.00976}),
    [](const auto& c) {
      return std::string(c.param.scene) + "_b" + std::to_string(c.param.bounces);
    });

}  // namespace
}  // namespace lamplighter
