// Tables for sampling directions of a sky picture by radiance. In the frame of the picture, without
// rotation, at scale 1 (shaders/shared/sky.h).
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/base/alias_table.h"
#include "renderer/base/cdf.h"
#include "renderer/base/math.h"
#include "renderer/image/image.h"

namespace lamplighter {

class SkyMap {
 public:
  SkyMap() = default;
  explicit SkyMap(const Image& equirectangular);

  // ∫ L dω over all directions without the suns [W/m²].
  vec3 irradiance() const { return irradiance_; }

  struct Light {
    vec3 towards{0.0f, 1.0f, 0.0f};  // unit
    vec3 irradiance{0.0f};           // perpendicular to that direction, if this is the only sample
                                     // [W/m²]
  };
  // A direction of the sky without suns. All samples have the same luminance, and the mean of their
  // colours is irradiance(). The picture is treated as cells of at least 0.7° with their mean
  // radiance.
  Light sample(vec2 u) const;

  // Spots within 2° of their brightest pixel that give more than 2% of the total light. Each is
  // sampled as a separate light. Brightest first.
  struct Sun {
    Light mean;                    // mean direction, weighted by radiance, and the total irradiance
    std::vector<vec3> towards;     // directions of its pixels
    std::vector<vec2> halfSize;    // half the angular size of its pixels along azimuth and
                                   // elevation [rad]
    AliasTable choice;             // selects a pixel by its irradiance
    vec3 direction(vec2 u) const;  // samples a direction within the sun by radiance
  };
  const std::vector<Sun>& suns() const { return suns_; }

  // For unbiased sampling of the interpolated picture including the suns: a direction and its
  // density [1/sr], which is positive wherever the radiance is.
  struct Direction {
    vec3 towards{0.0f, 1.0f, 0.0f};
    float pdf = 0.0f;
  };
  Direction sampleDensity(vec2 u) const;
  float density(const vec3& towards) const;

 private:
  float cellSolidAngle(int y) const;
  vec3 directionIn(const GridCdf::Cell& cell) const;
  void findSuns(const Image& image, std::vector<uint8_t>& isSun);

  int width_ = 0, height_ = 0;  // size of the grid of cells
  int factor_ = 1;              // width and height of a cell in pixels
  vec2 pixels_{1.0f};           // size of the picture in pixels
  vec3 irradiance_{0.0f};
  std::vector<vec3> cells_;  // mean radiance without suns
  GridCdf light_, density_;
  std::vector<Sun> suns_;
};

}  // namespace lamplighter
