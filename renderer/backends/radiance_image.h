// The picture of a frame, in any memory.
#pragma once

#include <memory>
#include <utility>

#include "renderer/image/average_blocks.h"
#include "renderer/image/image.h"

namespace lamplighter {

// The gl backend keeps it in a texture and reads it back once, on the first call of pixels().
class RadianceImage {
 public:
  virtual ~RadianceImage() = default;
  virtual int width() const = 0;
  virtual int height() const = 0;
  virtual const Image& pixels() = 0;  // linear radiance [W/(m² sr)]
  virtual bool isInMainMemory() const { return true; }  // pixels() does not wait for a GPU
  // A copy as by averageBlocks(), in the same memory: the gl backend reads only the copy back, when
  // somebody asks for its pixels.
  virtual std::shared_ptr<RadianceImage> averaged(int block);
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

inline std::shared_ptr<RadianceImage> RadianceImage::averaged(int block) {
  return std::make_shared<HostImage>(averageBlocks(pixels(), block));
}

}  // namespace lamplighter
