// Where the light of a sky's picture comes from: tables to choose directions by. In the picture's
// own frame, unturned, at scale 1 (shaders/shared/sky.h).
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/base/alias_table.h"
#include "renderer/base/math.h"
#include "renderer/image/image.h"

namespace lamplighter {

// Chooses a cell of a grid by weight, by inverting the cumulative distribution of its rows and then
// that within the row: neighbouring numbers give neighbouring cells, so that low-discrepancy points
// stay evenly spread.
class GridChoice {
 public:
  GridChoice() = default;
  GridChoice(int width, int height, const std::vector<float>& weights);  // ≥ 0, finite, row by row

  struct Cell {
    int x = 0, y = 0;
    vec2 within{0.0f};  // what is left of u, uniform in [0, 1)²
    float probability = 0.0f;
  };
  bool empty() const { return rows_.empty(); }  // also when all weights were 0
  Cell sample(vec2 u) const;
  float probability(int x, int y) const;

 private:
  int width_ = 0;
  std::vector<float> rows_, cells_;  // cumulative, begin with 0; width + 1 entries for each row
};

class SkyMap {
 public:
  SkyMap() = default;
  explicit SkyMap(const Image& equirectangular);

  // ∫ L dω over all directions, the suns left out [W/m²].
  vec3 irradiance() const { return irradiance_; }

  struct Light {
    vec3 towards{0.0f, 1.0f, 0.0f};  // unit
    vec3 irradiance{0.0f};           // across that direction, were this the only sample [W/m²]
  };
  // A direction of all but the suns. All samples have the same luminance and their colours add up
  // to irradiance(): the picture is taken as cells of 0.7° at least with their mean.
  Light sample(vec2 u) const;

  // Spots of at most 2° about their brightest pixel that give more than 2% of all light: each is
  // best a light of its own. The brightest first.
  struct Sun {
    Light mean;                    // mean direction, weighted by radiance, and all of its light
    std::vector<vec3> towards;     // of its pixels
    std::vector<vec2> halfSize;    // of those: half their angles along azimuth and elevation [rad]
    AliasTable choice;             // of a pixel by its light
    vec3 direction(vec2 u) const;  // a place on it, by its light
  };
  const std::vector<Sun>& suns() const { return suns_; }

  // For unbiased sampling of the interpolated picture, suns and all: a direction and its density
  // [1/sr], which is nowhere 0 where there is light.
  struct Direction {
    vec3 towards{0.0f, 1.0f, 0.0f};
    float pdf = 0.0f;
  };
  Direction sampleDensity(vec2 u) const;
  float density(const vec3& towards) const;

 private:
  float cellSolidAngle(int y) const;
  vec3 directionIn(const GridChoice::Cell& cell) const;
  void findSuns(const Image& image, std::vector<uint8_t>& isSun);

  int width_ = 0, height_ = 0;  // of the grid of cells
  int factor_ = 1;              // pixels a side of a cell
  vec2 pixels_{1.0f};           // of the picture
  vec3 irradiance_{0.0f};
  std::vector<vec3> cells_;  // mean radiance without the suns
  GridChoice light_, density_;
  std::vector<Sun> suns_;
};

}  // namespace lamplighter
