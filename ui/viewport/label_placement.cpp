#include "ui/viewport/label_placement.h"

#include <algorithm>

namespace lamplighter {
namespace {

bool overlap(const Rect& a, const Rect& b) {
  return !b.empty() && a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y &&
         b.min.y < a.max.y;
}

Rect at(const Rect& r, vec2 low) { return {low, low + r.size()}; }

Rect within(const Rect& r, const Rect& area) {
  return at(r, glm::max(glm::min(r.min, area.max - r.size()), area.min));
}

}  // namespace

Rect clearPlace(const Rect& label, const Rect& area, const std::vector<Rect>& covered) {
  const Rect wanted = within(label, area);
  // Candidate positions: beside the edge of one panel or, in a corner between two panels, beside an
  // edge of each.
  std::vector<float> xs{wanted.min.x}, ys{wanted.min.y};
  for (const Rect& c : covered) {
    if (c.empty()) continue;
    xs.insert(xs.end(), {c.min.x - label.size().x, c.max.x});
    ys.insert(ys.end(), {c.min.y - label.size().y, c.max.y});
  }
  Rect best = wanted;
  float least = -1.0f;
  for (const float x : xs) {
    for (const float y : ys) {
      const Rect r = at(label, {x, y});
      if (within(r, area).min != r.min) continue;
      if (std::any_of(covered.begin(), covered.end(), [&](const Rect& c) { return overlap(r, c); }))
        continue;
      const float moved = glm::distance(r.min, wanted.min);
      if (least >= 0.0f && moved >= least) continue;
      least = moved;
      best = r;
    }
  }
  return best;
}

}  // namespace lamplighter
