// The low-resolution pass (shaders/shared/low_resolution.h): the samples, and which pixels take
// their light from them.
#pragma once

#include <filesystem>
#include <vector>

#include "renderer/backends/gl/gl_scene.h"
#include "renderer/backends/gl/sum_target.h"
#include "renderer/gl/program.h"

namespace lamplighter::gl {

class GlLowResolution {
 public:
  GlLowResolution() : emptyVertexArray_(VertexArray::make()) {}
  // Before anything is drawn.
  void reload(const std::filesystem::path& shaders);

  // Makes room for the samples of a picture. Returns whether it has any cells: else all of its
  // pixels are to be summed.
  bool resize(int width, int height, int block);
  void release();
  SumTarget& samples() { return samples_; }

  // Once the samples are summed, with the G-buffer bound: the cells that may be, marked in the
  // stencil buffer of `pixels`. The others are left as they are. hardPlaces: a buffer with
  // LightLists::hardPlaces(), hasHard: whether it has any.
  void interpolate(SumTarget& pixels, const GlScene& scene, const Buffer& hardPlaces,
                   bool hasHard) const;

  // By pixel of a picture of that size whether it is interpolated (1); empty: there are no cells.
  std::vector<uint8_t> read(int width, int height) const;

  uint64_t bytes() const;

 private:
  // Draws into a texture of cells.
  void drawCells(const Framebuffer& framebuffer) const;

  Program findContrasts_, findCells_, interpolate_;
  VertexArray emptyVertexArray_;
  SumTarget samples_;
  Texture contrasts_, cells_;  // R8UI
  Framebuffer contrastsFramebuffer_, cellsFramebuffer_;
  int block_ = 1;
};

}  // namespace lamplighter::gl
