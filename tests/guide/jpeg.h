// Pictures for pages: small JPEG files with sharp text.
#pragma once

#include <filesystem>

#include "renderer/image/image.h"

namespace lamplighter::test {

void writeJpeg(const Image8& image, const std::filesystem::path& path);

}  // namespace lamplighter::test
