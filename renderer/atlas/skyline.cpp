#include "renderer/atlas/skyline.h"

#include <algorithm>

namespace lamplighter {

std::optional<glm::ivec2> Skyline::place(glm::ivec2 size) {
  std::optional<glm::ivec2> best;
  for (size_t i = 0; i < spans_.size() && spans_[i].x + size.x <= side_; ++i) {
    int y = 0, covered = 0;
    for (size_t k = i; covered < size.x; ++k) {
      y = std::max(y, spans_[k].y);
      covered += spans_[k].width;
    }
    if (y + size.y <= side_ && (!best || y < best->y)) best = glm::ivec2(spans_[i].x, y);
  }
  if (!best) return best;
  // Inserts the new span and keeps the uncovered parts of the spans below it.
  std::vector<Span> next;
  const int end = best->x + size.x;
  for (const Span& s : spans_) {
    const int right = s.x + s.width;
    if (s.x == best->x) next.push_back({best->x, best->y + size.y, size.x});
    if (right <= best->x || s.x >= end) {
      next.push_back(s);
    } else if (right > end) {
      next.push_back({end, s.y, right - end});
    }
  }
  spans_ = std::move(next);
  return best;
}

}  // namespace lamplighter
