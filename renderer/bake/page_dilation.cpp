#include "renderer/bake/page_dilation.h"

#include <algorithm>

namespace lamplighter {
namespace {
constexpr int kRings = 8;
}

void fillUnknown(Image& page) {
  for (int ring = 0; ring < kRings; ++ring) {
    const Image before = page;
    bool isWhole = true;
    for (int y = 0; y < page.height; ++y) {
      for (int x = 0; x < page.width; ++x) {
        if (before.at(x, y).r >= 0.0f) continue;
        vec3 sum(0.0f);
        float count = 0.0f;
        for (int py = std::max(y - 1, 0); py <= std::min(y + 1, page.height - 1); ++py) {
          for (int px = std::max(x - 1, 0); px <= std::min(x + 1, page.width - 1); ++px) {
            if (before.at(px, py).r < 0.0f) continue;
            sum += before.at(px, py);
            count += 1.0f;
          }
        }
        isWhole = isWhole && count > 0.0f;
        if (count > 0.0f) page.at(x, y) = sum / count;
      }
    }
    if (isWhole) return;
  }
  for (vec3& p : page.pixels)
    if (p.r < 0.0f) p = vec3(0.0f);
}

}  // namespace lamplighter
