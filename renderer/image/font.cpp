#include "renderer/image/font.h"

#include <cmath>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include "renderer/base/error.h"

namespace lamplighter {
Font::Font(const std::filesystem::path& file, int size, const std::string& wantedBy)
    : file_(file.string()), size_(size) {
  const OIIO::ROI letters = OIIO::ImageBufAlgo::text_size("Ágj|", size_, file_);
  if (letters.defined()) {
    ascent_ = -letters.ybegin;
    descent_ = letters.yend;
    return;
  }
  // OpenImageIO reports the reason only when drawing.
  OIIO::ImageBuf probe(OIIO::ImageSpec(8, 8, 4, OIIO::TypeDesc::UINT8));
  OIIO::ImageBufAlgo::render_text(probe, 0, 8, "x", size_, file_);
  throw InputError(wantedBy, "text cannot be drawn: " + probe.geterror(),
                   "install fonts-inter and an OpenImageIO with FreeType, or omit it");
}

float Font::width(const std::string& text) const {
  const OIIO::ROI roi = OIIO::ImageBufAlgo::text_size(text, size_, file_);
  return roi.defined() ? static_cast<float>(roi.xend) : 0.0f;
}

void Font::draw(Image8& image, const vec2& at, const std::string& text, const vec3& colour) const {
  // Four channels without a meaning: OpenImageIO would draw into an alpha channel.
  OIIO::ImageSpec spec(image.width, image.height, 4, OIIO::TypeDesc::UINT8);
  spec.alpha_channel = -1;
  OIIO::ImageBuf buffer(spec, image.pixels.data());
  const float ink[4] = {colour.r, colour.g, colour.b, 1.0f};
  OIIO::ImageBufAlgo::render_text(buffer, static_cast<int>(std::lround(at.x)),
                                  static_cast<int>(std::lround(at.y)) + ascent_, text, size_, file_,
                                  ink);
}

}  // namespace lamplighter
