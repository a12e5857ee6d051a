#include "tests/support/images.h"

namespace lamplighter::test {

double differingShare(const Image& a, const Image& b, float absolute, float relative) {
  if (a.width != b.width || a.height != b.height) return 1.0;
  size_t count = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const vec3 d = glm::abs(a.pixels[i] - b.pixels[i]);
    const vec3 limit = absolute + relative * glm::abs(b.pixels[i]);
    count += !(d.r <= limit.r && d.g <= limit.g && d.b <= limit.b);
  }
  return static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

}  // namespace lamplighter::test
