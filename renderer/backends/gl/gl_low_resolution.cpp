#include "renderer/backends/gl/gl_low_resolution.h"

#include <algorithm>

#include "renderer/gl/pass_state.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/low_resolution.h"

namespace lamplighter::gl {
namespace {

Framebuffer framebufferOf(const Texture& texture) {
  Framebuffer framebuffer = Framebuffer::make();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
  return framebuffer;
}

}  // namespace

void GlLowResolution::reload(const std::filesystem::path& shaders) {
  const char* vertex = "common/full_screen.vert.glsl";
  Program findContrasts(shaders, {vertex, "passes/find_contrasts.frag.glsl"});
  Program findCells(shaders, {vertex, "passes/find_cells.frag.glsl"});
  Program interpolate(shaders, {vertex, "passes/interpolate.frag.glsl"});
  findContrasts_ = std::move(findContrasts);
  findCells_ = std::move(findCells);
  interpolate_ = std::move(interpolate);
}

bool GlLowResolution::resize(int width, int height, int block) {
  const int columns = shared::lowResolutionSamples(width, block) - 1;
  const int rows = shared::lowResolutionSamples(height, block) - 1;
  if (block <= 1 || columns < 1 || rows < 1) {
    release();
    return false;
  }
  block_ = block;
  if (cells_ && samples_.width == columns + 1 && samples_.height == rows + 1) return true;
  samples_.resize(columns + 1, rows + 1);
  samples_.addPlaces();
  contrasts_ = makeTexture2D(GL_R8UI, columns, rows);
  contrastsFramebuffer_ = framebufferOf(contrasts_);
  cells_ = makeTexture2D(GL_R8UI, columns, rows);
  cellsFramebuffer_ = framebufferOf(cells_);
  return true;
}

void GlLowResolution::release() {
  samples_ = {};
  contrasts_ = {};
  contrastsFramebuffer_ = {};
  cells_ = {};
  cellsFramebuffer_ = {};
}

void GlLowResolution::drawCells(const Framebuffer& framebuffer) const {
  const PassState state(framebuffer.name(), samples_.width - 1, samples_.height - 1);
  drawFullScreen(emptyVertexArray_.name());
}

void GlLowResolution::interpolate(SumTarget& pixels, const GlScene& scene, const Buffer& hardPlaces,
                                  bool hasHard) const {
  glBindTextureUnit(shared::kPlaces, samples_.places.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::kHardPlaceBuffer, hardPlaces.name());
  glBindTextureUnit(shared::kSamples, samples_.irradiance.name());
  findContrasts_.use();
  findContrasts_.set(0, block_);
  findContrasts_.set(1, hasHard ? 1 : 0);
  drawCells(contrastsFramebuffer_);
  glBindTextureUnit(shared::kContrasts, contrasts_.name());
  findCells_.use();
  findCells_.set(0, block_);
  findCells_.set(1, hasHard ? 1 : 0);
  findCells_.set(2, scene.scene().hasLinks ? 1 : 0);
  scene.bindLeftOut();
  drawCells(cellsFramebuffer_);
  glBindTextureUnit(shared::kCells, cells_.name());
  pixels.addStencil();
  PassState state(pixels.sums.name(), pixels.width, pixels.height);
  glClearNamedFramebufferfi(pixels.sums.name(), GL_DEPTH_STENCIL, 0, 0.0f, 0);
  state.mark();
  interpolate_.use();
  interpolate_.set(0, block_);
  drawFullScreen(emptyVertexArray_.name());
}

std::vector<uint8_t> GlLowResolution::read(int width, int height) const {
  if (!cells_) return {};
  const int columns = samples_.width - 1, rows = samples_.height - 1;
  std::vector<uint8_t> cells(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(cells_.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                    static_cast<GLsizei>(cells.size()), cells.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  std::vector<uint8_t> pixels;
  pixels.reserve(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      pixels.push_back(cells[static_cast<size_t>(std::min(y / block_, rows - 1) * columns +
                                                 std::min(x / block_, columns - 1))]);
  return pixels;
}

uint64_t GlLowResolution::bytes() const {
  const uint64_t cells =
      cells_ ? static_cast<uint64_t>(samples_.width - 1) * (samples_.height - 1) : 0;
  return samples_.bytes() + 2 * cells;
}

}  // namespace lamplighter::gl
