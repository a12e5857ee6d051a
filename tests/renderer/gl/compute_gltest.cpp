// Compute shaders, storage buffers, images and queries.
#include "renderer/gl/pass_state.h"
#include "renderer/gl/program.h"
#include "renderer/gl/query.h"
#include "renderer/gl/radiance_texture.h"
#include "renderer/gl/shader_source.h"
#include "renderer/gl/storage_buffer.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter {
namespace {

using Compute = test::GlTest;

TEST_F(Compute, WritesImagesAndCountsInWholeWorkGroups) {
  constexpr int kWidth = 21, kHeight = 10;  // not multiples of the work group size
  const gl::ComputeProgram program(gl::defaultShaderFolder(),
                                   "../tests/renderer/gl/compute.comp.glsl", {"FACTOR 2.0"});
  std::vector<vec4> values(kWidth * kHeight);
  for (size_t i = 0; i < values.size(); ++i) values[i] = vec4(static_cast<float>(i));
  gl::StorageBuffer<vec4> colours;
  gl::StorageBuffer<uint32_t> count;
  colours.set(values);
  count.resize(1);
  count.clear();
  const gl::Texture image = gl::makeTexture2D(GL_RGBA32F, kWidth, kHeight);
  const gl::Texture hits = gl::makeTexture2D(GL_R32UI, 2, 1);
  glClearTexImage(hits.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  colours.bind(0);
  count.bind(1);
  gl::bindImage(0, image, GL_RGBA32F, GL_WRITE_ONLY);
  gl::bindImage(1, hits, GL_R32UI, GL_READ_WRITE);
  program.dispatch({kWidth, kHeight, 1}, GL_TEXTURE_UPDATE_BARRIER_BIT);
  gl::Waits waits;
  const Image pixels = gl::readBack(waits, image.name(), kWidth, kHeight);
  EXPECT_EQ(waits.count(), 1u);
  for (size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(pixels.pixels[i], 2.0f * vec3(static_cast<float>(i)));
  EXPECT_EQ(test::read(count)[0], static_cast<uint32_t>(kWidth * kHeight));
  uint32_t columns[2];
  glGetTextureImage(hits.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, sizeof(columns), columns);
  EXPECT_EQ(columns[0], 11u * kHeight);
  EXPECT_EQ(columns[1], 10u * kHeight);

  program.dispatch({0, kHeight, 1}, GL_SHADER_STORAGE_BARRIER_BIT);  // an empty dispatch
  EXPECT_EQ(test::read(count)[0], static_cast<uint32_t>(kWidth * kHeight));
  EXPECT_THROW(program.dispatch({1, 1, ~0u}, 0), InputError);
}

TEST_F(Compute, ReportsErrorsWithTheFile) {
  const test::TemporaryFolder folder;
  folder.write("broken.comp.glsl", "layout(local_size_x = 1) in;\nvoid main() { nothing(); }\n");
  try {
    const gl::ComputeProgram program(folder.path(), "broken.comp.glsl");
    FAIL() << "no exception";
  } catch (const gl::ShaderError& error) {
    EXPECT_NE(std::string(error.what()).find("broken.comp.glsl:2:"), std::string::npos)
        << error.what();
  }
  context().debugLog()->clear();  // Mesa reports the compiler's message there too
}

TEST_F(Compute, StorageBuffersAreUpdatedInPart) {
  gl::StorageBuffer<uint32_t> buffer;
  EXPECT_EQ(buffer.size(), 0u);
  buffer.set({});
  EXPECT_TRUE(test::read(buffer).empty());
  buffer.set(std::vector<uint32_t>{1, 2, 3, 4});
  buffer.update(1, std::vector<uint32_t>{7, 8});
  EXPECT_EQ(test::read(buffer), (std::vector<uint32_t>{1, 7, 8, 4}));
  buffer.set(std::vector<uint32_t>{5, 6, 7, 8});
  EXPECT_EQ(test::read(buffer), (std::vector<uint32_t>{5, 6, 7, 8}));
  buffer.resize(2);
  buffer.clear();
  EXPECT_EQ(test::read(buffer), (std::vector<uint32_t>{0, 0}));
  EXPECT_EQ(buffer.bytes(), 8u);
}

TEST_F(Compute, TooLargeStorageBuffersAreRefused) {
  gl::StorageBuffer<vec4> buffer;
  try {
    buffer.resize(gl::mostStorageBytes() / sizeof(vec4) + 1);
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("shaders can access"), std::string::npos);
  }
  EXPECT_EQ(buffer.size(), 0u);
}

TEST_F(Compute, QueriesGiveTheirResultsLater) {
  const gl::Program program(gl::defaultShaderFolder(),
                            {"common/full_screen.vert.glsl", "passes/display.frag.glsl"});
  const gl::Texture target = gl::makeTexture2D(GL_RGBA8, 16, 9);
  const gl::VertexArray empty = gl::VertexArray::make();
  const gl::Framebuffer framebuffer = gl::Framebuffer::make();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, target.name(), 0);
  gl::Query samples(GL_SAMPLES_PASSED), primitives(GL_PRIMITIVES_GENERATED), time(GL_TIME_ELAPSED);
  EXPECT_FALSE(samples.ready());
  EXPECT_EQ(samples.result(), 0u);
  const auto draw = [&](int width, int height) {
    const gl::PassState state(framebuffer.name(), width, height);
    const gl::Query::Scope ofSamples(samples), ofPrimitives(primitives), ofTime(time);
    program.use();
    gl::drawFullScreen(empty.name());
  };
  for (int frame = 1; frame <= 3; ++frame) draw(frame, 2);  // three queries in flight
  glFinish();
  EXPECT_TRUE(samples.ready());
  EXPECT_EQ(samples.result(), 6u);  // the newest
  EXPECT_FALSE(samples.ready());
  EXPECT_TRUE(primitives.ready());
  EXPECT_EQ(primitives.result(), 1u);
  EXPECT_TRUE(time.ready());  // the value itself is meaningless on llvmpipe
  draw(16, 9);
  glFinish();
  EXPECT_EQ(samples.result(), 144u);
}

}  // namespace
}  // namespace lamplighter
