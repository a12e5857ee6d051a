// Where light is summed: for all pixels of a picture, or for the samples of its low-resolution
// pass.
#pragma once

#include "renderer/gl/objects.h"

namespace lamplighter::gl {

struct SumTarget {
  int width = 0, height = 0;
  Texture irradiance;  // RGBA32F, so that hundreds of additions do not lose small values
  Texture places;      // R32UI: shaders/shared/patches.h
  Texture stencil;     // 1: an interpolated pixel
  Framebuffer sums;    // writes irradiance
  Framebuffer begin;   // writes irradiance and places

  // Allocates the irradiance texture of this size; does nothing if it has this size.
  void resize(int newWidth, int newHeight);
  // Allocate the optional textures.
  void addPlaces();
  void addStencil();
  void dropPlaces() { places = {}, begin = {}, dropStencil(); }
  void dropStencil();
  uint64_t bytes() const;
};

}  // namespace lamplighter::gl
