// The shader passes of the low-resolution pass (shaders/shared/low_resolution.h) except its sums.
#pragma once

#include <filesystem>

#include "renderer/backends/gl/gl_scene.h"
#include "renderer/backends/gl/many_lights/sample_grid.h"
#include "renderer/gl/program.h"
#include "renderer/gl/storage_buffer.h"

namespace lamplighter::gl {

class GlLowResolution {
 public:
  GlLowResolution() : emptyVertexArray_(VertexArray::make()) {}
  // Call before drawing.
  void reload(const std::filesystem::path& shaders);

  // Copies the grid's points from the points of its picture.
  void take(const ShadingPoints& points, const SampleGrid& grid) const;

  // Call after the samples are summed. Interpolates the cells where this is possible and marks them
  // in the stencil buffer of `pixels`; `points` are its points. Other cells keep their values.
  // hardPlaces: a buffer with LightLists::hardPlaces(); hasHard: whether it contains any.
  void interpolate(const ShadingPoints& points, SumTarget& pixels, const SampleGrid& grid,
                   const GlScene& scene, const StorageBuffer<uint32_t>& hardPlaces,
                   bool hasHard) const;

 private:
  void draw(const Framebuffer& framebuffer, int width, int height) const;

  Program takeSamples_, findContrasts_, findCells_, interpolate_;
  VertexArray emptyVertexArray_;
};

}  // namespace lamplighter::gl
