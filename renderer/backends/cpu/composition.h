// The cpu backend's pictures: light on surfaces, and the memory that they lie in.
#pragma once

#include <memory>
#include <vector>

#include "renderer/backends/cpu/gbuffer.h"
#include "renderer/backends/cpu/picture_light.h"
#include "renderer/backends/kernels.h"

namespace lamplighter::cpu {

// The sky where a view's pixels, shifted by `jitter` from their middles, meet nothing.
struct Background {
  const Sky& sky;
  const View& view;
  vec2 jitter{0.0f};
  vec3 at(int x, int y) const;
};

// Le + ρ/π · E of each pixel, the sky where nothing is hit. `white`: with ρ = 1. The image has the
// G-buffer's size.
void compose(const GBuffer& gbuffer, const PictureLight& light, const Background& background,
             bool white, Image& out);

// Pictures that nobody holds any more are written again: fresh memory is slow.
class ImagePool {
 public:
  struct Pooled final : RadianceImage {
    int width() const override { return image.width; }
    int height() const override { return image.height; }
    const Image& pixels() override { return image; }
    Image image;
  };
  std::shared_ptr<Pooled> take(int width, int height);

 private:
  std::vector<std::shared_ptr<Pooled>> images_;
};

}  // namespace lamplighter::cpu
