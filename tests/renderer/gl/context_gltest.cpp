// The headless context, its debug log, and shader loading and compiling.
#include <fstream>

#include "renderer/gl/program.h"
#include "renderer/gl/shader_source.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter {
namespace {

using Context = test::GlTest;
using ShaderLoading = test::GlTest;
using test::TemporaryFolder;

TEST_F(Context, IsOpenGl45Core) {
  GLint major = 0, minor = 0, profile = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_GE(10 * major + minor, 45);
  EXPECT_NE(profile & GL_CONTEXT_CORE_PROFILE_BIT, 0);
  EXPECT_FALSE(context().renderer().empty());
}

TEST_F(Context, LogsErrors) {
  ASSERT_TRUE(context().debugLog()->errors().empty());
  glBindFramebuffer(GL_FRAMEBUFFER, 12345);  // does not exist
  EXPECT_EQ(context().debugLog()->errors().size(), 1u);
  context().debugLog()->clear();
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_INVALID_OPERATION));
}

TEST_F(Context, SeveralCanExistAndBeReleased) {
  {
    gl::HeadlessContext other(true);
    gl::Buffer buffer = gl::Buffer::make();
    EXPECT_NE(buffer.name(), 0u);
  }
  context().makeCurrent();
  GLint major = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  EXPECT_EQ(major, 4);
}

TEST_F(ShaderLoading, IncludesOnceFromTheFolderAndBesideTheFile) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "deep");
  folder.write(
      "main.glsl",
      "#include \"deep/a.h\"\n#include \"deep/b.h\"\nint inMain;\n#include \"main.glsl\"\n");
  folder.write("deep/a.h", "#include <cmath>\n#include \"b.h\"\nint inA;\n");
  folder.write("deep/b.h", "#pragma once\nint inB;\n#include \"deep/a.h\"\n");
  const gl::ShaderSource source = gl::loadShader(folder.path(), "main.glsl", {"N 3", "FLAG"});
  EXPECT_EQ(source.files, (std::vector<std::string>{"main.glsl", "deep/a.h", "deep/b.h"}));
  EXPECT_EQ(source.text,
            "#version 450 core\n#define N 3\n#define FLAG\n#line 1 0\n"
            "#line 1 1\n\n#line 1 2\n\nint inB;\n#line 4 2\n#line 3 1\nint inA;\n"
            "#line 2 0\n#line 3 0\nint inMain;\n#line 5 0\n");
}

TEST_F(ShaderLoading, NamesTheFileAndLineOfAMissingInclude) {
  const TemporaryFolder folder;
  folder.write("main.glsl", "\n#include \"gone.glsl\"\n");
  try {
    gl::loadShader(folder.path(), "main.glsl");
    FAIL() << "no exception";
  } catch (const gl::ShaderError& error) {
    EXPECT_EQ(std::string(error.what()),
              "main.glsl:2: cannot read shader " + (folder.path() / "gone.glsl").string());
  }
}

TEST_F(ShaderLoading, NamesTheFileAndLineOfACompilerError) {
  const TemporaryFolder folder;
  folder.write("broken.h", "float fine() { return 1.0; }\n\nfloat broken() { return nothing; }\n");
  folder.write("main.vert", "// a line\n#include \"broken.h\"\nvoid main() {}\n");
  try {
    const gl::Program program(folder.path(), {"main.vert", ""});
    FAIL() << "no exception";
  } catch (const gl::ShaderError& error) {
    EXPECT_NE(std::string(error.what()).find("broken.h:3:"), std::string::npos) << error.what();
  }
  context().debugLog()->clear();  // Mesa reports the compiler's message there too
}

TEST_F(ShaderLoading, NamesFilesInTheLogsOfSeveralDrivers) {
  const std::vector<std::string> files{"a.glsl", "b.h"};
  EXPECT_EQ(gl::nameFiles("1:12(3): error: x\n0(7) : error C1: y\n9:1: z\nfree text\n", files),
            "b.h:12: error: x\na.glsl:7: error C1: y\n9:1: z\nfree text");
}

}  // namespace
}  // namespace lamplighter
