#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "renderer/base/error.h"
#include "renderer/image/image_io.h"

namespace lamplighter {

std::vector<uint8_t> encodePng(const Image8& image) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  auto output = OIIO::ImageOutput::create("png");
  OIIO::ImageSpec spec(image.width, image.height, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // colours are not multiplied by alpha
  if (output == nullptr || !output->set_ioproxy(&memory) || !output->open("memory.png", spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) || !output->close()) {
    throw InputError("texture", "cannot be encoded as PNG", "report this as a bug");
  }
  return bytes;
}

}  // namespace lamplighter
