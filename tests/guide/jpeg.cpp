#include "tests/guide/jpeg.h"

#include <OpenImageIO/imageio.h>

#include "renderer/base/error.h"

namespace lamplighter::test {

void writeJpeg(const Image8& image, const std::filesystem::path& path) {
  namespace oiio = OIIO;
  oiio::ImageSpec spec(image.width, image.height, 3, oiio::TypeDesc::UINT8);
  spec.attribute("Compression", "jpeg:78");
  spec.attribute("jpeg:subsampling", "4:2:0");
  const auto out = oiio::ImageOutput::create(path.string());
  // Removes the alpha channel.
  if (!out || !out->open(path.string(), spec) ||
      !out->write_image(oiio::TypeDesc::UINT8, image.pixels.data(), 4) || !out->close())
    throw InputError(path.string(), "cannot be written: " + (out ? out->geterror() : "no JPEG"),
                     "check the folder and the space left");
}

}  // namespace lamplighter::test
