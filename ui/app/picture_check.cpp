#include "ui/app/picture_check.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "renderer/base/error.h"
#include "renderer/image/image_io.h"

namespace lamplighter {
namespace {

int largestDifference(const uint8_t* a, const uint8_t* b) {
  int largest = 0;
  for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  return largest;
}

constexpr int kTile = 16;

// The largest mean difference of the tiles, over pixels and channels. Tiles at the border may be
// smaller.
double largestTile(const Image8& a, const Image8& b) {
  double largest = 0.0;
  for (int y0 = 0; y0 < a.height; y0 += kTile) {
    for (int x0 = 0; x0 < a.width; x0 += kTile) {
      const int x1 = std::min(x0 + kTile, a.width), y1 = std::min(y0 + kTile, a.height);
      int sum = 0;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
          for (int c = 0; c < 3; ++c) sum += std::abs(a.at(x, y)[c] - b.at(x, y)[c]);
      largest = std::max(largest, sum / (3.0 * (x1 - x0) * (y1 - y0)));
    }
  }
  return largest;
}

}  // namespace

std::string PictureDifference::text() const {
  if (!sameSize) return "the picture is of another size than its baseline";
  char text[192];
  std::snprintf(
      text, sizeof text,
      "the picture differs in %zu pixels, by %d of 255 at most, %d silhouettes apart, and %.4f "
      "in the mean",
      pixels, max, largest, mean);
  return text;
}

Image8 halved(const Image8& image) {
  Image8 out((image.width + 1) / 2, (image.height + 1) / 2);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const int right = std::min(2 * x + 1, image.width - 1);
      const int below = std::min(2 * y + 1, image.height - 1);
      uint8_t* to = &out.pixels[4 * (static_cast<size_t>(y) * out.width + x)];
      for (int c = 0; c < 4; ++c)
        to[c] = static_cast<uint8_t>((image.at(2 * x, 2 * y)[c] + image.at(right, 2 * y)[c] +
                                      image.at(2 * x, below)[c] + image.at(right, below)[c] + 2) /
                                     4);
    }
  }
  return out;
}

PictureDifference comparePictures(const Image8& a, const Image8& b) {
  PictureDifference d;
  d.sameSize = a.width == b.width && a.height == b.height;
  if (!d.sameSize) return d;
  uint64_t sum = 0;
  std::array<size_t, 256> counts{};
  const size_t count = a.pixels.size() / 4;
  for (size_t i = 0; i < count; ++i) {
    const uint8_t *pa = &a.pixels[4 * i], *pb = &b.pixels[4 * i];
    const int largest = largestDifference(pa, pb);
    if (largest > 0) ++d.pixels;
    d.max = std::max(d.max, largest);
    ++counts[static_cast<size_t>(largest)];
    for (int c = 0; c < 3; ++c) sum += static_cast<uint64_t>(std::abs(pa[c] - pb[c]));
  }
  d.largest = 255;
  for (size_t over = counts[255]; d.largest > 0 && over <= count / 1000;) {
    --d.largest;
    over += counts[static_cast<size_t>(d.largest)];
  }
  d.tile = largestTile(a, b);
  if (count > 0) d.mean = static_cast<double>(sum) / (3.0 * static_cast<double>(count));
  return d;
}

Image8 differencePicture(const Image8& a, const Image8& b) {
  constexpr int kWhite = 64;
  Image8 out(a.width, a.height);
  for (size_t i = 0; i + 3 < a.pixels.size(); i += 4) {
    const int level =
        std::min(largestDifference(&a.pixels[i], &b.pixels[i]), kWhite) * 510 / kWhite;
    out.pixels[i] = static_cast<uint8_t>(std::min(level, 255));
    out.pixels[i + 1] = out.pixels[i + 2] = static_cast<uint8_t>(std::max(level - 255, 0));
  }
  return out;
}

Image8 readPicture(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(in)), {});
  std::string why;
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  std::optional<Image8> image = decodeImage8({data, bytes.size()}, why);
  if (!image) throw InputError(path.string(), "cannot be read: it " + why, "write it again");
  return std::move(*image);
}

}  // namespace lamplighter
