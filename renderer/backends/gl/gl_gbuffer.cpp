#include "renderer/backends/gl/gl_gbuffer.h"

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/gl/pass_state.h"
#include "renderer/gl/radiance_texture.h"
#include "shaders/shared/bindings.h"

namespace lamplighter::gl {
namespace {

// World to clip space. Row 0 of the texture is the top of the picture, and the sample of pixel (x,
// y) is at (x, y) + 0.5 + jitter.
mat4 rasterMatrix(const View& view, vec2 jitter) {
  mat4 adjust(1.0f);
  adjust[1][1] = -1.0f;
  // Shifts x and y by w times these values, after the flip, so y points down as in the jitter.
  mat4 shift(1.0f);
  shift[3][0] = -2.0f * jitter.x / static_cast<float>(view.width);
  shift[3][1] = -2.0f * jitter.y / static_cast<float>(view.height);
  return shift * adjust * view.worldToClip();
}

}  // namespace

GlGBuffer::GlGBuffer(const std::filesystem::path& shaders)
    : emptyVertexArray_(VertexArray::make()), framebuffer_(Framebuffer::make()) {
  constexpr GLenum kTargets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2,
                                 GL_COLOR_ATTACHMENT3, GL_COLOR_ATTACHMENT4};
  glNamedFramebufferDrawBuffers(framebuffer_.name(), 5, kTargets);
  reload(shaders);
}

void GlGBuffer::reload(const std::filesystem::path& shaders) {
  std::map<std::pair<bool, bool>, Program> programs;
  Program normals(shaders, {"common/full_screen.vert.glsl", "passes/normals.frag.glsl"});
  shaders_ = shaders;
  // Compiles one now, so that an error in the file is reported immediately.
  programs_.swap(programs);
  try {
    programFor({});
  } catch (...) {
    programs_.swap(programs);
    throw;
  }
  normals_ = std::move(normals);
}

const Program& GlGBuffer::programFor(const GlScene::Drawn& drawn) {
  Program& program = programs_[{drawn.textured, drawn.masked}];
  if (!program) {
    std::vector<std::string> defines;
    if (drawn.textured) defines.push_back("TEXTURED");
    if (drawn.masked) defines.push_back("ALPHA_MASK");
    program = Program(shaders_, {"passes/gbuffer.vert.glsl", "passes/gbuffer.frag.glsl", defines});
  }
  return program;
}

void GlGBuffer::resize(int width, int height) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (std::max(width, height) > limit) {
    throw InputError("OpenGL",
                     "this driver supports at most " + std::to_string(limit) + " pixels per side",
                     "render a smaller one or use --backend cpu");
  }
  width_ = width;
  height_ = height;
  points_.resize(width, height);
  albedo_ = makeTexture2D(GL_RGBA16, width, height);
  emission_ = makeTexture2D(GL_RGBA32F, width, height);
  gloss_ = makeTexture2D(GL_RG16, width, height);
  depth_ = makeTexture2D(GL_DEPTH_COMPONENT32F, width, height);
  const auto attach = [&](int index, const Texture& texture) {
    glNamedFramebufferTexture(framebuffer_.name(),
                              GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index), texture.name(), 0);
  };
  attach(shared::kGPosition, points_.position);
  attach(shared::kGNormals, points_.normals);
  attach(shared::kGAlbedo, albedo_);
  attach(shared::kGEmission, emission_);
  attach(shared::kGlossTarget, gloss_);
  glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
}

void GlGBuffer::render(const GlScene& scene, const View& view, vec2 jitter) {
  if (width_ != view.width || height_ != view.height) resize(view.width, view.height);
  const float zero[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  PassState state(framebuffer_.name(), width_, height_);
  state.reversedDepth();
  for (const int i : {shared::kGPosition, shared::kGAlbedo})
    glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, i, zero);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, zero);

  const mat4 worldToClip = rasterMatrix(view, jitter);
  frustum_ = Frustum(worldToClip);
  view_ = view;
  jitter_ = jitter;
  glBindVertexArray(scene.vertexArray());
  scene.bindStorage();
  const Program* inUse = nullptr;
  int material = kNone;
  for (const GlScene::Drawn& d : scene.drawn()) {
    const RenderObject& o = scene.scene().objects[d.object];
    if (!frustum_.mayMeet(o.bounds)) continue;
    const Program& program = programFor(d);
    if (&program != inUse) {
      program.use();
      program.set(0, worldToClip);
      program.set(1, view.eye);
      inUse = &program;
    }
    state.cullBackFaces(d.culled);
    if (d.material != material) scene.bindMaterial(material = d.material);
    glDrawElementsInstancedBaseInstance(
        GL_TRIANGLES, static_cast<GLsizei>(o.indexCount), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(o.firstIndex * sizeof(uint32_t)), 1, d.object);
  }
}

void GlGBuffer::bind() const {
  points_.bind();
  glBindTextureUnit(shared::kGAlbedo, albedo_.name());
  glBindTextureUnit(shared::kGEmission, emission_.name());
  glBindTextureUnit(shared::kGGloss, gloss_.name());
}

Image GlGBuffer::readNormals(Waits& waits) const {
  const Texture vectors = makeTexture2D(GL_RGBA32F, width_, height_);
  const Framebuffer framebuffer = Framebuffer::make();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, vectors.name(), 0);
  {
    const PassState state(framebuffer.name(), width_, height_);
    bind();
    normals_.use();
    drawFullScreen(emptyVertexArray_.name());
  }
  return readBack(waits, vectors.name(), width_, height_);
}

Image GlGBuffer::readAlbedo(Waits& waits) const {
  return readBack(waits, albedo_.name(), width_, height_);
}

uint64_t GlGBuffer::bytes() const {
  return ShadingPoints::bytes(width_, height_) +
         uint64_t{16 + 8 + 4 + 4} * static_cast<uint64_t>(width_) * height_;
}

}  // namespace lamplighter::gl
