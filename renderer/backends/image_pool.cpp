#include "renderer/backends/image_pool.h"

namespace lamplighter {
namespace {

// Pictures that are kept for being written again; more are in use at once nowhere.
constexpr size_t kMostPooled = 4;

}  // namespace

std::shared_ptr<ImagePool::Pooled> ImagePool::take(int width, int height) {
  for (const auto& image : images_)
    if (image.use_count() == 1 && image->image.width == width && image->image.height == height)
      return image;
  std::erase_if(images_, [](const auto& image) { return image.use_count() == 1; });
  auto image = std::make_shared<Pooled>();
  image->image = Image(width, height);
  if (images_.size() < kMostPooled) images_.push_back(image);
  return image;
}

}  // namespace lamplighter
