#include "editor/explain/measurement.h"

#include "editor/explain/quantity.h"
#include "editor/tools/projection.h"

namespace lamplighter {
namespace {

const vec4 kLine{1.0f, 0.85f, 0.35f, 1.0f};
const vec4 kUnder{0.0f, 0.0f, 0.0f, 0.55f};
const vec4 kAxes[3] = {
    {0.85f, 0.36f, 0.32f, 0.9f}, {0.5f, 0.75f, 0.35f, 0.9f}, {0.36f, 0.56f, 0.88f, 0.9f}};

void drawEnd(Overlay& overlay, const View& view, const vec3& p) {
  const auto at = projectPoint(view, p);
  if (!at) return;
  for (const auto& [colour, thickness] : {std::pair{kUnder, 5.0f}, {kLine, 2.0f}}) {
    constexpr float kHalf = 6.0f;
    overlay.shapes.push_back(
        {{*at - vec2(kHalf, 0), *at + vec2(kHalf, 0)}, false, false, colour, thickness});
    overlay.shapes.push_back(
        {{*at - vec2(0, kHalf), *at + vec2(0, kHalf)}, false, false, colour, thickness});
  }
}

}  // namespace

void Measurement::add(const vec3& point) {
  if (!from_ || to_) {
    from_ = point;
    to_.reset();
  } else {
    to_ = point;
  }
}

std::optional<vec3> Measurement::offset() const {
  const std::optional<vec3>& end = to_ ? to_ : hovered_;
  if (!from_ || !end) return std::nullopt;
  return *end - *from_;
}

std::string Measurement::text() const {
  const auto d = offset();
  return d ? metresText(glm::length(*d)) + "  (" + offsetText(*d) + ")" : "";
}

void Measurement::draw(Overlay& overlay, const View& view) const {
  if (!from_) {
    if (hovered_) drawEnd(overlay, view, *hovered_);
    return;
  }
  drawEnd(overlay, view, *from_);
  const auto d = offset();
  if (!d) return;
  const vec3 end = *from_ + *d;
  // The distances along the three axes, one after the other.
  vec3 corner = *from_;
  for (int axis = 0; axis < 3; ++axis) {
    vec3 next = corner;
    next[axis] = end[axis];
    addLine(overlay, view, corner, next, kAxes[axis], 1.0f);
    corner = next;
  }
  addLine(overlay, view, *from_, end, kUnder, 5.0f);
  addLine(overlay, view, *from_, end, kLine, 2.0f);
  drawEnd(overlay, view, end);
  // The text is at the end of the line, because the middle may be outside the picture. It is one
  // text, so that its lines do not overlap at any font size.
  if (const auto at = projectPoint(view, end))
    overlay.texts.push_back({*at + vec2(18.0f, 10.0f),
                             metresText(glm::length(*d)) + "\n" + offsetText(*d), kLine, true});
}

}  // namespace lamplighter
