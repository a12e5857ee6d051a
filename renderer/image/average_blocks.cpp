#include "renderer/image/average_blocks.h"

namespace lamplighter {

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

}  // namespace lamplighter
