#include "editor/debug_views/annotate.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "editor/debug_views/legend.h"
#include "editor/debug_views/look.h"
#include "editor/tools/projection.h"

namespace lamplighter {
namespace {

// Blends the colour into the partly or fully covered pixels. distance(pixel centre) is the signed
// distance to the shape, negative inside. `low` and `high` bound the shape.
template <typename Distance>
void cover(Image8& image, const vec2& low, const vec2& high, const vec4& colour,
           const Distance& distance) {
  const auto within = [](float v, int size) {
    return static_cast<int>(std::clamp(v, 0.0f, static_cast<float>(size)));
  };
  const int right = within(high.x + 2.0f, image.width);
  const int bottom = within(high.y + 2.0f, image.height);
  for (int y = within(low.y - 1.0f, image.height); y < bottom; ++y) {
    for (int x = within(low.x - 1.0f, image.width); x < right; ++x) {
      const vec2 middle(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float alpha = colour.a * std::clamp(0.5f - distance(middle), 0.0f, 1.0f);
      if (alpha <= 0.0f) continue;
      uint8_t* pixel = image.at(x, y);
      for (int c = 0; c < 3; ++c) {
        const float mixed = glm::mix(static_cast<float>(pixel[c]), 255.0f * colour[c], alpha);
        pixel[c] = static_cast<uint8_t>(std::lround(std::clamp(mixed, 0.0f, 255.0f)));
      }
    }
  }
}

struct PixelBounds {
  vec2 low, high;
};
PixelBounds boundsOf(std::span<const vec2> points) {
  PixelBounds b{points[0], points[0]};
  for (const vec2& p : points) b = {glm::min(b.low, p), glm::max(b.high, p)};
  return b;
}

// Corners of a convex polygon, clockwise or counter-clockwise.
void fillConvex(Image8& image, std::span<const vec2> corners, const vec4& colour) {
  if (corners.size() < 3) return;
  float area = 0.0f;
  for (size_t i = 0; i < corners.size(); ++i) {
    const vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    area += a.x * b.y - a.y * b.x;
  }
  if (area == 0.0f) return;
  const float outwards = area > 0.0f ? 1.0f : -1.0f;
  const PixelBounds bounds = boundsOf(corners);
  cover(image, bounds.low, bounds.high, colour, [&](const vec2& p) {
    float farthest = -1e30f;
    for (size_t i = 0; i < corners.size(); ++i) {
      const vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const float length = glm::length(b - a);
      if (length == 0.0f) continue;
      const vec2 normal = outwards / length * vec2(b.y - a.y, a.x - b.x);
      farthest = std::max(farthest, glm::dot(p - a, normal));
    }
    return farthest;
  });
}

void strokeLine(Image8& image, std::span<const vec2> points, bool closed, const vec4& colour,
                float thickness) {
  if (points.size() < 2) return;
  const size_t lines = closed ? points.size() : points.size() - 1;
  const PixelBounds bounds = boundsOf(points);
  const float half = 0.5f * thickness;
  cover(image, bounds.low - half, bounds.high + half, colour, [&](const vec2& p) {
    float nearest = 1e30f;
    for (size_t i = 0; i < lines; ++i)
      nearest = std::min(nearest, distanceToSegment(p, points[i], points[(i + 1) % points.size()]));
    return nearest - half;
  });
}

}  // namespace

void drawOverlay(Image8& image, const Overlay& overlay, const Font* font, vec2 origin) {
  for (const OverlayShape& shape : overlay.shapes) {
    std::vector<vec2> points = shape.points;
    for (vec2& p : points) p += origin;
    if (shape.filled)
      fillConvex(image, points, shape.colour);
    else
      strokeLine(image, points, shape.closed, shape.colour, shape.thickness);
  }
  if (font == nullptr) return;
  for (const OverlayText& text : overlay.texts)
    font->draw(image, text.position + origin, text.text, vec3(text.colour));
}

Image8 withLegend(const ViewPicture& picture, const Font& font) {
  const LegendStyle style{1.0f, font.lineHeight(),
                          [&](const std::string& text) { return font.width(text); }};
  constexpr float kPad = 10.0f;
  const auto width = static_cast<float>(picture.image.width);
  const LegendLayout legend = layOutLegend(picture, style, width - 2.0f * kPad);
  if (legend.size == vec2(0.0f)) return picture.image;
  const int strip = static_cast<int>(std::ceil(legend.size.y + 2.0f * kPad));
  Image8 out(picture.image.width, picture.image.height + strip);
  std::copy(picture.image.pixels.begin(), picture.image.pixels.end(), out.pixels.begin());
  const float top = static_cast<float>(picture.image.height),
              bottom = top + static_cast<float>(strip);
  const vec2 corners[] = {{0.0f, top}, {width, top}, {width, bottom}, {0.0f, bottom}};
  fillConvex(out, corners, look::colour(look::kBackground));
  drawOverlay(out, legend.overlay, &font, {kPad, top + kPad});
  return out;
}

}  // namespace lamplighter
