// What the cpu backend provides to every method, and how methods add kernels.
#include "renderer/base/error.h"
#include "tests/renderer/backends/backend_checks.h"

namespace lamplighter {
namespace {

TEST(CpuBackend, ComposesAnyIrradiance) { test::expectComposesAnyIrradiance(makeCpuBackend()); }

TEST(CpuBackend, GBufferEqualsRayHits) { test::expectHostGBufferEqualsRayHits(makeCpuBackend()); }

// Counts the calls from the backend.
class CountingKernels : public MethodKernels {
 public:
  int scenes = 0, rebuilt = 0, gbuffers = 0;
  void takeScene(const RenderScene&, const RenderSceneChanges& changes, const RayCaster&) override {
    ++scenes;
    rebuilt += changes.rebuilt ? 1 : 0;
  }
  void takeGBuffer() override { ++gbuffers; }
  BackendCounts counts() const override { return {7, 1000}; }
};

TEST(MethodKernels, AreCreatedOnDemandAndNotifiedOfChanges) {
  test::LitScene lit(test::randomBoxes(3, 1));
  int made = 0;
  lit.backend->offer<CountingKernels>([&] {
    ++made;
    return std::make_unique<CountingKernels>();
  });
  lit.backend->renderGBuffer(test::lookAt(vec3(0, 3, 7), vec3(0), 16, 16), vec2(0.0f));
  EXPECT_EQ(lit.backend->kernelsInUse<CountingKernels>(), nullptr);
  const BackendCounts before = lit.backend->counts();

  auto& kernels = lit.backend->kernels<CountingKernels>("counting");
  EXPECT_EQ(&lit.backend->kernels<CountingKernels>("counting"), &kernels);
  EXPECT_EQ(lit.backend->kernelsInUse<CountingKernels>(), &kernels);
  EXPECT_EQ(made, 1);
  EXPECT_EQ(kernels.scenes, 1);  // the current scene, reported as completely new
  EXPECT_EQ(kernels.rebuilt, 1);
  EXPECT_EQ(kernels.gbuffers, 1);
  EXPECT_EQ(lit.backend->counts().rays, before.rays + 7);
  EXPECT_EQ(lit.backend->counts().memoryBytes, before.memoryBytes + 1000);

  lit.backend->setScene(lit.render, {}, *lit.rays);
  lit.backend->renderGBuffer(test::lookAt(vec3(0, 3, 7), vec3(0), 16, 16), vec2(0.0f));
  EXPECT_EQ(kernels.scenes, 2);
  EXPECT_EQ(kernels.rebuilt, 1);
  EXPECT_EQ(kernels.gbuffers, 2);
}

TEST(MethodKernels, MissingOnesGiveAnErrorThatNamesTheMethod) {
  const auto backend = makeCpuBackend();
  try {
    backend->kernels<CountingKernels>("my_method");
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("my_method does not run on the backend cpu"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace lamplighter
