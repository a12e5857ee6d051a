// Structs shared by GLSL and C++ have the same memory layout on both sides, in uniform and storage
// blocks. The layout of each member is queried from the GLSL compiler.
#include <cstddef>

#include "renderer/gl/program.h"
#include "renderer/gl/shader_source.h"
#include "shaders/shared/material.h"
#include "shaders/shared/patches.h"
#include "shaders/shared/vpl.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/folders.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter {
namespace {

struct Member {
  const char* name;
  size_t offset;
};

class StructLayout : public test::GlTest {
 protected:
  // Declares an array of two structs in a block of each layout, so that the stride is checked as
  // well.
  void expectLayout(const std::string& header, const std::string& type, size_t size,
                    const std::vector<Member>& members) {
    const test::TemporaryFolder folder;
    std::filesystem::copy(gl::defaultShaderFolder(), folder.path(),
                          std::filesystem::copy_options::recursive);
    folder.write("layout.vert.glsl",
                 "#include \"" + header + "\"\n" + "layout(std140, binding = 0) uniform U { " +
                     type + " u[2]; };\n" + "layout(std430, binding = 0) readonly buffer S { " +
                     type + " s[2]; };\n" + "void main() { gl_Position = vec4(u[gl_VertexID]." +
                     members[0].name + " + s[gl_VertexID]." + members[0].name + "); }\n");
    const gl::Program program(folder.path(), {"layout.vert.glsl", ""});
    for (int i = 0; i < 2; ++i) {
      for (const Member& m : members) {
        const std::string element = "[" + std::to_string(i) + "]." + m.name;
        const size_t expected = static_cast<size_t>(i) * size + m.offset;
        EXPECT_EQ(offset(program, GL_UNIFORM, "u" + element), expected) << type << element;
        // For an array in a storage block, only the first element has names; the stride gives the
        // rest.
        if (i == 0) {
          EXPECT_EQ(offset(program, GL_BUFFER_VARIABLE, "s" + element), expected)
              << type << element;
        }
      }
    }
    const GLenum property = GL_TOP_LEVEL_ARRAY_STRIDE;
    GLint stride = 0;
    glGetProgramResourceiv(
        program.name(), GL_BUFFER_VARIABLE,
        index(program, GL_BUFFER_VARIABLE, std::string("s[0].") + members[0].name), 1, &property, 1,
        nullptr, &stride);
    EXPECT_EQ(static_cast<size_t>(stride), size) << type;
  }

 private:
  static GLuint index(const gl::Program& program, GLenum interface, const std::string& name) {
    const GLuint i = glGetProgramResourceIndex(program.name(), interface, name.c_str());
    EXPECT_NE(i, GL_INVALID_INDEX) << name;
    return i;
  }
  static size_t offset(const gl::Program& program, GLenum interface, const std::string& name) {
    const GLenum property = GL_OFFSET;
    GLint value = -1;
    glGetProgramResourceiv(program.name(), interface, index(program, interface, name), 1, &property,
                           1, nullptr, &value);
    return static_cast<size_t>(value);
  }
};

#define MEMBER(type, name) \
  Member { #name, offsetof(type, name) }

TEST_F(StructLayout, OfVpl) {
  using shared::Vpl;
  expectLayout("shared/vpl.h", "Vpl", sizeof(Vpl),
               {MEMBER(Vpl, position), MEMBER(Vpl, normal), MEMBER(Vpl, tangent),
                MEMBER(Vpl, intensity), MEMBER(Vpl, slot), MEMBER(Vpl, footprint)});
}

TEST_F(StructLayout, OfShadingParams) {
  using shared::ShadingParams;
  expectLayout("shared/vpl.h", "ShadingParams", sizeof(ShadingParams),
               {MEMBER(ShadingParams, clampAndBias), MEMBER(ShadingParams, block),
                MEMBER(ShadingParams, speculars)});
}

TEST_F(StructLayout, OfSurfaceMaterial) {
  using shared::SurfaceMaterial;
  expectLayout("shared/material.h", "SurfaceMaterial", sizeof(SurfaceMaterial),
               {MEMBER(SurfaceMaterial, baseColor), MEMBER(SurfaceMaterial, emissive),
                MEMBER(SurfaceMaterial, options), MEMBER(SurfaceMaterial, baseColorLookup.u),
                MEMBER(SurfaceMaterial, baseColorLookup.v), MEMBER(SurfaceMaterial, normalLookup.u),
                MEMBER(SurfaceMaterial, normalLookup.v), MEMBER(SurfaceMaterial, emissiveLookup.u),
                MEMBER(SurfaceMaterial, emissiveLookup.v), MEMBER(SurfaceMaterial, glossLookup.u),
                MEMBER(SurfaceMaterial, glossLookup.v)});
}

TEST_F(StructLayout, OfPatchChart) {
  using shared::PatchChart;
  expectLayout(
      "shared/patches.h", "PatchChart", sizeof(PatchChart),
      {MEMBER(PatchChart, origin), MEMBER(PatchChart, tangent), MEMBER(PatchChart, bitangent)});
}

TEST_F(StructLayout, OfPatchNode) {
  using shared::PatchNode;
  expectLayout("shared/patches.h", "PatchNode", sizeof(PatchNode), {MEMBER(PatchNode, branch)});
}

TEST_F(StructLayout, OfPatchTile) {
  using shared::PatchTile;
  expectLayout("shared/patches.h", "PatchTile", sizeof(PatchTile),
               {MEMBER(PatchTile, frame), MEMBER(PatchTile, texels)});
}

// A struct that is added to shaders/shared must be added to this file.
TEST(SharedStructs, AreAllTestedHere) {
  int structs = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(test::sourceFolder() / "shaders/shared")) {
    const std::string text = test::readText(file.path());
    for (size_t at = text.find("\nstruct "); at != std::string::npos;
         at = text.find("\nstruct ", at + 1)) {
      ++structs;
    }
  }
  // Vpl, ShadingParams, Lobe (local to brdf.h), TextureLookup (a member of SurfaceMaterial),
  // SurfaceMaterial, PatchNode, PatchChart, PatchTile.
  EXPECT_EQ(structs, 8);
}

}  // namespace
}  // namespace lamplighter
