#include "ui/platform/read_pixels.h"

#include <cstring>
#include <vector>

#include <epoxy/gl.h>

namespace lamplighter {

Image8 readPixels(glm::ivec2 size) {
  Image8 image(size.x, size.y);
  std::vector<uint8_t> rows(image.pixels.size());
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
  const size_t pitch = size_t{4} * static_cast<size_t>(size.x);
  for (int y = 0; y < size.y; ++y)
    std::memcpy(image.at(0, y), &rows[static_cast<size_t>(size.y - 1 - y) * pitch], pitch);
  for (size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
  return image;
}

}  // namespace lamplighter
