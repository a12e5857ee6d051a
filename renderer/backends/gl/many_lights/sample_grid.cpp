#include "renderer/backends/gl/many_lights/sample_grid.h"

#include <algorithm>

#include "shaders/shared/low_resolution.h"

namespace lamplighter::gl {
namespace {

Framebuffer framebufferOf(const Texture& texture) {
  Framebuffer framebuffer = Framebuffer::make();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
  return framebuffer;
}

}  // namespace

bool SampleGrid::resize(int width, int height, int newBlock) {
  const int newColumns = shared::lowResolutionSamples(width, newBlock) - 1;
  const int newRows = shared::lowResolutionSamples(height, newBlock) - 1;
  if (newBlock <= 1 || newColumns < 1 || newRows < 1) {
    *this = {};
    return false;
  }
  block = newBlock;
  if (cells && columns() == newColumns && rows() == newRows) return true;
  sums.resize(newColumns + 1, newRows + 1);
  sums.addPlaces();
  points.resize(sums.width, sums.height);
  pointsFramebuffer = framebufferOf(points.position);
  glNamedFramebufferTexture(pointsFramebuffer.name(), GL_COLOR_ATTACHMENT1, points.normals.name(),
                            0);
  constexpr GLenum kTargets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferDrawBuffers(pointsFramebuffer.name(), 2, kTargets);
  contrasts = makeTexture2D(GL_R8UI, newColumns, newRows);
  contrastsFramebuffer = framebufferOf(contrasts);
  cells = makeTexture2D(GL_R8UI, newColumns, newRows);
  cellsFramebuffer = framebufferOf(cells);
  return true;
}

std::vector<uint8_t> SampleGrid::read(Waits& waits, int width, int height) const {
  if (!cells) return {};
  std::vector<uint8_t> values(static_cast<size_t>(columns()) * static_cast<size_t>(rows()));
  waits.readTexture(cells.name(), GL_RED_INTEGER, GL_UNSIGNED_BYTE, values.size(), values.data());
  std::vector<uint8_t> pixels;
  pixels.reserve(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      pixels.push_back(values[static_cast<size_t>(std::min(y / block, rows() - 1) * columns() +
                                                  std::min(x / block, columns() - 1))]);
  return pixels;
}

uint64_t SampleGrid::bytes() const {
  if (!cells) return 0;
  const uint64_t each = static_cast<uint64_t>(columns()) * static_cast<uint64_t>(rows());
  return sums.bytes() + ShadingPoints::bytes(sums.width, sums.height) + 2 * each;
}

}  // namespace lamplighter::gl
