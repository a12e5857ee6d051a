#include "renderer/backends/gl/many_lights/gl_low_resolution.h"

#include "renderer/gl/pass_state.h"
#include "shaders/shared/bindings.h"

namespace lamplighter::gl {

void GlLowResolution::reload(const std::filesystem::path& shaders) {
  const char* vertex = "common/full_screen.vert.glsl";
  Program takeSamples(shaders, {vertex, "passes/take_samples.frag.glsl"});
  Program findContrasts(shaders, {vertex, "passes/find_contrasts.frag.glsl"});
  Program findCells(shaders, {vertex, "passes/find_cells.frag.glsl"});
  Program interpolate(shaders, {vertex, "passes/interpolate.frag.glsl"});
  takeSamples_ = std::move(takeSamples);
  findContrasts_ = std::move(findContrasts);
  findCells_ = std::move(findCells);
  interpolate_ = std::move(interpolate);
}

void GlLowResolution::draw(const Framebuffer& framebuffer, int width, int height) const {
  const PassState state(framebuffer.name(), width, height);
  drawFullScreen(emptyVertexArray_.name());
}

void GlLowResolution::take(const ShadingPoints& points, const SampleGrid& grid) const {
  points.bind();
  takeSamples_.use();
  takeSamples_.set(0, grid.block);
  draw(grid.pointsFramebuffer, grid.sums.width, grid.sums.height);
}

void GlLowResolution::interpolate(const ShadingPoints& points, SumTarget& pixels,
                                  const SampleGrid& grid, const GlScene& scene,
                                  const StorageBuffer<uint32_t>& hardPlaces, bool hasHard) const {
  points.bind();
  glBindTextureUnit(shared::kPlaces, grid.sums.places.name());
  glBindTextureUnit(shared::kSamples, grid.sums.irradiance.name());
  findContrasts_.use();
  findContrasts_.set(0, grid.block);
  findContrasts_.set(1, hasHard ? 1 : 0);
  draw(grid.contrastsFramebuffer, grid.columns(), grid.rows());

  glBindTextureUnit(shared::kContrasts, grid.contrasts.name());
  hardPlaces.bind(shared::kHardPlaceBuffer);
  scene.bindLeftOut();
  findCells_.use();
  findCells_.set(0, grid.block);
  findCells_.set(1, hasHard ? 1 : 0);
  findCells_.set(2, scene.scene().hasLinks ? 1 : 0);
  draw(grid.cellsFramebuffer, grid.columns(), grid.rows());

  glBindTextureUnit(shared::kCells, grid.cells.name());
  pixels.addStencil();
  PassState state(pixels.sums.name(), pixels.width, pixels.height);
  glClearNamedFramebufferfi(pixels.sums.name(), GL_DEPTH_STENCIL, 0, 0.0f, 0);
  state.mark();
  interpolate_.use();
  interpolate_.set(0, grid.block);
  drawFullScreen(emptyVertexArray_.name());
}

}  // namespace lamplighter::gl
