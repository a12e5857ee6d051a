// The passes of the low-resolution pass (shaders/shared/low_resolution.h) about its sums.
#pragma once

#include <filesystem>

#include "renderer/backends/gl/gl_scene.h"
#include "renderer/backends/gl/sample_grid.h"
#include "renderer/gl/program.h"

namespace lamplighter::gl {

class GlLowResolution {
 public:
  GlLowResolution() : emptyVertexArray_(VertexArray::make()) {}
  // Before anything is drawn.
  void reload(const std::filesystem::path& shaders);

  // The grid's points, from those of the picture that it is of.
  void take(const ShadingPoints& points, const SampleGrid& grid) const;

  // Once the samples are summed: cells that may be, marked in the stencil buffer of `pixels`, whose
  // points these are. The others are left as they are. hardPlaces: a buffer with
  // LightLists::hardPlaces(), hasHard: whether it has any.
  void interpolate(const ShadingPoints& points, SumTarget& pixels, const SampleGrid& grid,
                   const GlScene& scene, const Buffer& hardPlaces, bool hasHard) const;

 private:
  void draw(const Framebuffer& framebuffer, int width, int height) const;

  Program takeSamples_, findContrasts_, findCells_, interpolate_;
  VertexArray emptyVertexArray_;
};

}  // namespace lamplighter::gl
