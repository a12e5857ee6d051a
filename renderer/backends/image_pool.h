// Pictures that nobody holds any more are written again: fresh memory is slow.
#pragma once

#include <memory>
#include <vector>

#include "renderer/backends/kernels.h"

namespace lamplighter {

class ImagePool {
 public:
  struct Pooled final : RadianceImage {
    int width() const override { return image.width; }
    int height() const override { return image.height; }
    const Image& pixels() override { return image; }
    Image image;
  };
  // Of that size, with whatever it held.
  std::shared_ptr<Pooled> take(int width, int height);

 private:
  std::vector<std::shared_ptr<Pooled>> images_;
};

}  // namespace lamplighter
