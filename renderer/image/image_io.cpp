#include "renderer/image/image_io.h"

#include <filesystem>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "renderer/base/text.h"
#include "renderer/image/open_picture.h"
#include "renderer/image/tone_map.h"

namespace lamplighter {

namespace {

// Encodes in memory first. So the old file stays intact until the new one is complete, and a full
// disk is detected here: not all encoders check for it.
std::vector<uint8_t> encodedImage(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                                  OIIO::TypeDesc type, const void* pixels) {
  const auto fail = [&](const std::string& why) {
    throw InputError(path.string(), "cannot be written: " + oneLine(why),
                     "name a file that ends in .png or .exr");
  };
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  // OpenImageIO selects the format by the file extension.
  const auto out = OIIO::ImageOutput::create(path.filename().string());
  if (!out) fail(OIIO::geterror());
  if (!out->supports("ioproxy") || !out->set_ioproxy(&memory) ||
      !out->open(path.filename().string(), spec) || !out->write_image(type, pixels) ||
      !out->close())
    fail(out->geterror());
  return bytes;
}

void writeEncoded(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                  OIIO::TypeDesc type, const void* pixels) {
  writeWhole(path, encodedImage(path, spec, type, pixels));
}

OIIO::ImageSpec exrSpec(int width, int height, int channels) {
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  // A fixed time instead of the time of day, so that equal pictures give equal files.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  return spec;
}

}  // namespace

Image readImage(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& why) {
    throw InputError(path.string(), "cannot be read: " + oneLine(why),
                     "name an EXR, PNG, JPEG or HDR file");
  };
  if (!std::filesystem::is_regular_file(path)) fail("there is no such file");
  const auto in = [&] {
    const auto lock = openingAPicture();
    return OIIO::ImageInput::open(path.string());
  }();
  if (!in) fail(OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.width <= 0 || spec.height <= 0 || spec.width > 65536 || spec.height > 65536 ||
      spec.depth > 1) {
    fail("its size is " + std::to_string(spec.width) + " x " + std::to_string(spec.height));
  }
  const int channels = spec.nchannels;
  std::vector<float> data(static_cast<size_t>(spec.width) * spec.height * channels);
  const bool encoded = spec.format.basetype == OIIO::TypeDesc::UINT8 ||
                       spec.format.basetype == OIIO::TypeDesc::UINT16;
  if (!in->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, data.data())) fail(in->geterror());
  Image image(spec.width, spec.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const float v =
          data[i * static_cast<size_t>(channels) + static_cast<size_t>(channels < 3 ? 0 : c)];
      image.pixels[i][c] = encoded ? decodeSrgb(v) : v;
    }
  }
  return image;
}

void writeExr(const Image& image, const std::filesystem::path& path) {
  writeEncoded(path, exrSpec(image.width, image.height, 3), OIIO::TypeDesc::FLOAT,
               image.pixels.data());
}

std::vector<uint8_t> encodeExr(int width, int height, std::span<const vec4> pixels) {
  return encodedImage("memory.exr", exrSpec(width, height, 4), OIIO::TypeDesc::FLOAT,
                      pixels.data());
}

void writePng(const Image8& image, const std::filesystem::path& path) {
  std::vector<uint8_t> rgb;
  rgb.reserve(image.pixels.size() / 4 * 3);
  for (size_t i = 0; i < image.pixels.size(); i += 4)
    rgb.insert(rgb.end(), {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]});
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  writeEncoded(path, spec, OIIO::TypeDesc::UINT8, rgb.data());
}

}  // namespace lamplighter
