#include "editor/split/tile_sheet.h"

#include <algorithm>
#include <cmath>

#include "editor/debug_views/look.h"

namespace lamplighter {
namespace {

constexpr int kGap = 6;  // around tiles [px]

void fill(Image8& image, const vec4& colour) {
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] =
        i % 4 == 3 ? uint8_t{255} : static_cast<uint8_t>(std::lround(255.0f * colour[i % 4]));
}

// The longest beginning of the text that fits.
std::string fitting(std::string text, float width, const Font& font) {
  while (!text.empty() && font.width(text) > width) text.pop_back();
  return text;
}

}  // namespace

Image8 tileSheet(std::span<const Tile> tiles, int columns, const Font& font) {
  if (tiles.empty()) return {};
  const int width = tiles.front().picture.width, height = tiles.front().picture.height;
  const int line = static_cast<int>(std::ceil(font.lineHeight()));
  size_t lines = 0;
  for (const Tile& t : tiles) lines = std::max(lines, t.figures.size());
  const int caption = line * (1 + static_cast<int>(lines)) + kGap;
  columns = std::clamp(columns, 1, static_cast<int>(tiles.size()));
  const int rows = (static_cast<int>(tiles.size()) + columns - 1) / columns;
  Image8 sheet(kGap + columns * (width + kGap), kGap + rows * (height + caption + kGap));
  fill(sheet, look::colour(look::kBackground));
  const auto room = static_cast<float>(width);
  for (int i = 0; i < static_cast<int>(tiles.size()); ++i) {
    const Tile& tile = tiles[static_cast<size_t>(i)];
    const int left = kGap + i % columns * (width + kGap),
              top = kGap + i / columns * (height + caption + kGap);
    for (int y = 0; y < height; ++y)
      std::copy_n(tile.picture.at(0, y), 4 * width, sheet.at(left, top + y));
    vec2 at(left, top + height + kGap / 2);
    font.draw(sheet, at, fitting(tile.title, room, font), vec3(look::colour(look::kText)));
    for (const std::string& figure : tile.figures) {
      at.y += static_cast<float>(line);
      font.draw(sheet, at, fitting(figure, room, font), vec3(look::colour(look::kTextDim)));
    }
  }
  return sheet;
}

}  // namespace lamplighter
