#include "renderer/image/average_blocks.h"

namespace lamplighter {
namespace {

Image zeroOrOne(const Image& mask) {
  Image out = mask;
  for (vec3& p : out.pixels) p = vec3(p.r > 0.5f ? 1.0f : 0.0f);
  return out;
}

}  // namespace

Image averageBlocks(const Image& picture, int block) {
  block = std::min({std::max(block, 1), picture.width, picture.height});
  if (block <= 1) return picture;
  Image blocks(blocksOf(picture.width, block), blocksOf(picture.height, block));
  const float share = 1.0f / static_cast<float>(block * block);
  for (int y = 0; y < blocks.height; ++y) {
    for (int x = 0; x < blocks.width; ++x) {
      vec3 sum(0.0f);
      for (int j = 0; j < block; ++j)
        for (int i = 0; i < block; ++i) sum += picture.at(x * block + i, y * block + j);
      blocks.at(x, y) = share * sum;
    }
  }
  return blocks;
}

Image averageBlocks(const Image& picture, int block, const Image* mask) {
  if (!mask || block <= 1) return averageBlocks(picture, block);
  const Image counts = zeroOrOne(*mask);
  Image counted = picture;
  // A pixel that does not count may be infinite.
  for (size_t i = 0; i < counted.pixels.size(); ++i)
    if (counts.pixels[i].r == 0.0f) counted.pixels[i] = vec3(0.0f);
  Image blocks = averageBlocks(counted, block);
  const Image shares = averageBlocks(counts, block);
  for (size_t i = 0; i < blocks.pixels.size(); ++i)
    if (shares.pixels[i].r > 0.0f) blocks.pixels[i] /= shares.pixels[i].r;
  return blocks;
}

Image blockMask(const Image& mask, int block) {
  Image out = averageBlocks(zeroOrOne(mask), block);
  for (vec3& p : out.pixels) p = vec3(p.r >= 0.5f ? 1.0f : 0.0f);
  return out;
}

}  // namespace lamplighter
