// Where light is summed: for all pixels of a picture, or for the samples of its low-resolution
// pass.
#pragma once

#include "renderer/gl/objects.h"

namespace lamplighter::gl {

struct SumTarget {
  int width = 0, height = 0;
  Texture irradiance;  // RGBA32F: hundreds of additions must not lose the small ones
  Texture places;      // R32UI: shaders/shared/patches.h
  Texture stencil;     // 1: a pixel that is interpolated
  Framebuffer sums;    // irradiance
  Framebuffer begin;   // irradiance and places

  // Of the size, with irradiance alone; nothing where it has it.
  void resize(int newWidth, int newHeight);
  // What else it is to have.
  void addPlaces();
  void addStencil();
  void dropPlaces() { places = {}, begin = {}, dropStencil(); }
  void dropStencil();
  uint64_t bytes() const;
};

}  // namespace lamplighter::gl
