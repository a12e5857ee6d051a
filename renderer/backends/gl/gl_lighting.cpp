#include "renderer/backends/gl/gl_lighting.h"

#include <algorithm>

#include "renderer/gl/pass_state.h"
#include "shaders/shared/bindings.h"

namespace lamplighter::gl {
namespace {

// VPLs that one draw can sum: of one kind, with their maps in one array.
struct Batch {
  int kind = 0;
  int array = 0;
  auto operator<=>(const Batch&) const = default;
};

Batch batchOf(const shared::Vpl& vpl, int slotsAnArray) {
  const int slot = static_cast<int>(vpl.intensity.w);
  return {static_cast<int>(vpl.position.w), slot < 0 ? 0 : slot / slotsAnArray};
}

}  // namespace

GlLighting::GlLighting(const std::filesystem::path& shaders, const VplBuffer& vpls)
    : emptyVertexArray_(VertexArray::make()),
      irradianceFramebuffer_(Framebuffer::make()),
      pictureFramebuffer_(Framebuffer::make()) {
  reload(shaders, vpls);
}

void GlLighting::reload(const std::filesystem::path& shaders, const VplBuffer& vpls) {
  const char* vertex = "common/full_screen.vert.glsl";
  const char* sum = "passes/sum_vpls.frag.glsl";
  const std::string n = vpls.define();
  Program kinds[3] = {
      Program(shaders, {vertex, sum, {n, "VPL_KIND kVplCosine"}}),
      Program(shaders, {vertex, sum, {n, "VPL_KIND kVplUniform"}}),
      Program(shaders, {vertex, sum, {n, "VPL_KIND kVplDirectional", "DIRECTIONAL"}})};
  Program compose(shaders, {vertex, "passes/compose.frag.glsl"});
  std::move(std::begin(kinds), std::end(kinds), kinds_);
  compose_ = std::move(compose);
}

void GlLighting::clear(int width, int height) {
  if (width_ != width || height_ != height) {
    width_ = width;
    height_ = height;
    irradiance_ = makeTexture2D(GL_RGBA32F, width, height);
    glNamedFramebufferTexture(irradianceFramebuffer_.name(), GL_COLOR_ATTACHMENT0,
                              irradiance_.name(), 0);
    pictures_.clear();
  }
  const PassState state(irradianceFramebuffer_.name(), width_, height_);
  const float zero[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  glClearNamedFramebufferfv(irradianceFramebuffer_.name(), GL_COLOR, 0, zero);
}

void GlLighting::sum(const GlGBuffer& gbuffer, const GlShadowMaps& maps, const VplBuffer& buffer,
                     std::span<const shared::Vpl> vpls, const shared::ShadingParams& params) {
  clear(gbuffer.width(), gbuffer.height());
  // In their order within each batch: the same bits whenever the same VPLs come in the same order.
  std::vector<shared::Vpl> sorted(vpls.begin(), vpls.end());
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
    return batchOf(a, maps.slotsAnArray()) < batchOf(b, maps.slotsAnArray());
  });

  PassState state(irradianceFramebuffer_.name(), width_, height_);
  state.additive();
  gbuffer.bind();
  const auto capacity = static_cast<size_t>(buffer.capacity());
  for (size_t first = 0; first < sorted.size(); first += capacity) {
    const auto chunk = std::span(sorted).subspan(first, std::min(capacity, sorted.size() - first));
    std::vector<shared::Vpl> local(chunk.begin(), chunk.end());
    for (shared::Vpl& vpl : local) {
      if (vpl.intensity.w >= 0.0f) {
        vpl.intensity.w -=
            static_cast<float>(batchOf(vpl, maps.slotsAnArray()).array * maps.slotsAnArray());
      }
    }
    buffer.upload(local);
    for (size_t begin = 0; begin < chunk.size();) {
      const Batch batch = batchOf(chunk[begin], maps.slotsAnArray());
      size_t end = begin + 1;
      while (end < chunk.size() && batchOf(chunk[end], maps.slotsAnArray()) == batch) ++end;
      const Program& program = kinds_[batch.kind];
      program.use();
      program.set(0, static_cast<int>(begin));
      program.set(1, static_cast<int>(end));
      program.set(2, params.clampAndBias);
      glBindTextureUnit(shared::kShadowMaps,
                        maps.hasArray(batch.array) ? maps.array(batch.array) : 0);
      drawFullScreen(emptyVertexArray_.name());
      begin = end;
    }
  }
}

std::shared_ptr<RadianceTexture> GlLighting::freePicture(int width, int height) {
  for (const auto& picture : pictures_) {
    if (picture.use_count() == 1) {
      picture->forgetPixels();
      return picture;
    }
  }
  return pictures_.emplace_back(std::make_shared<RadianceTexture>(width, height));
}

std::shared_ptr<RadianceTexture> GlLighting::compose(const GlGBuffer& gbuffer, const vec3& sky) {
  auto picture = freePicture(width_, height_);
  glNamedFramebufferTexture(pictureFramebuffer_.name(), GL_COLOR_ATTACHMENT0, picture->texture(),
                            0);
  const PassState state(pictureFramebuffer_.name(), width_, height_);
  gbuffer.bind();
  glBindTextureUnit(shared::kIrradiance, irradiance_.name());
  compose_.set(0, sky);
  compose_.use();
  drawFullScreen(emptyVertexArray_.name());
  return picture;
}

uint64_t GlLighting::bytes() const {
  return (1 + pictures_.size()) * uint64_t{16} * static_cast<uint64_t>(width_) * height_;
}

}  // namespace lamplighter::gl
