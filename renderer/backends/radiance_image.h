// The picture of a frame, in any memory.
#pragma once

#include <utility>

#include "renderer/image/image.h"

namespace lamplighter {

// The gl backend keeps it in a texture and reads it back once, on the first call of pixels().
class RadianceImage {
 public:
  virtual ~RadianceImage() = default;
  virtual int width() const = 0;
  virtual int height() const = 0;
  virtual const Image& pixels() = 0;  // linear radiance [W/(m² sr)]
};

// A picture in main memory.
class HostImage final : public RadianceImage {
 public:
  explicit HostImage(Image image) : image_(std::move(image)) {}
  int width() const override { return image_.width; }
  int height() const override { return image_.height; }
  const Image& pixels() override { return image_; }

 private:
  Image image_;
};

}  // namespace lamplighter
