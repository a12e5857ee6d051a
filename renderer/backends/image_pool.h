// Reuses pictures that nobody holds any more, because fresh memory is slow.
#pragma once

#include <memory>
#include <vector>

#include "renderer/backends/radiance_image.h"

namespace lamplighter {

class ImagePool {
 public:
  struct Pooled final : RadianceImage {
    int width() const override { return image.width; }
    int height() const override { return image.height; }
    const Image& pixels() override { return image; }
    Image image;
  };
  // A picture of that size with undefined content.
  std::shared_ptr<Pooled> take(int width, int height);

 private:
  std::vector<std::shared_ptr<Pooled>> images_;
};

}  // namespace lamplighter
