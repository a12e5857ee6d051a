// Draws text into an image.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/image/image.h"

namespace lamplighter {

class Font {
 public:
  // size: of the em [px]. Throws InputError if the file is not a usable font; `wantedBy` is named
  // in the message.
  Font(const std::filesystem::path& file, int size, const std::string& wantedBy);

  float lineHeight() const { return static_cast<float>(ascent_ + descent_); }
  float width(const std::string& text) const;
  // at: the upper left corner of the text [px], y down; colour: sRGB. Text outside the image is
  // clipped.
  void draw(Image8& image, const vec2& at, const std::string& text, const vec3& colour) const;

 private:
  std::string file_;
  int size_;
  int ascent_ = 0, descent_ = 0;
};

}  // namespace lamplighter
