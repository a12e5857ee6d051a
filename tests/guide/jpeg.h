// Pictures for pages: JPEG files, small and without seams in text.
#pragma once

#include <filesystem>

#include "renderer/image/image.h"

namespace lamplighter::test {

void writeJpeg(const Image8& image, const std::filesystem::path& path);

}  // namespace lamplighter::test
