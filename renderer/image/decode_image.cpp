// Decodes encoded images in memory with OpenImageIO's readers.
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "renderer/base/text.h"
#include "renderer/image/image_io.h"
#include "renderer/image/open_picture.h"
#include "renderer/image/tone_map.h"

namespace lamplighter {

namespace {

// Largest number of pixels: 8192 x 8192; every graphics driver supports twice that side. A limit is
// necessary, because a few kilobytes of PNG can claim any size.
constexpr int64_t kMostPixels = int64_t{1} << 26;

// Format by the first bytes; OpenImageIO would use the file extension, which data in memory does
// not have. Null if unknown.
const char* formatOf(std::span<const uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  using namespace std::string_view_literals;
  if (text.starts_with("\x89PNG\r\n\x1a\n"sv)) return "png";
  if (text.starts_with("\xff\xd8\xff"sv)) return "jpeg";
  if (text.starts_with("RIFF"sv) && text.substr(0, 12).ends_with("WEBP"sv)) return "webp";
  if (text.starts_with("\xabKTX 20\xbb"sv)) return "ktx2";
  if (text.starts_with("DDS "sv)) return "dds";
  if (text.starts_with("BM"sv)) return "bmp";
  if (text.starts_with("GIF8"sv)) return "gif";
  if (text.starts_with("\x76\x2f\x31\x01"sv)) return "openexr";
  if (text.starts_with("#?RADIANCE"sv) || text.starts_with("#?RGBE"sv)) return "hdr";
  return nullptr;
}

struct Opened {
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
  std::unique_ptr<OIIO::ImageInput> input;  // destroyed before the memory that it reads
};

// Opens the image and checks its size. On failure sets `why` and returns a null input.
Opened open(std::span<const uint8_t> bytes, std::string& why) {
  Opened opened;
  const char* format = formatOf(bytes);
  if (format == nullptr) {
    why = bytes.empty() ? "is empty" : "has no known image format";
    return opened;
  }
  const std::string name = format;
  // OpenImageIO allocates memory for the size that a GIF claims before the size can be checked.
  // glTF does not allow GIF.
  if (name == "ktx2" || name == "dds" || name == "gif") {
    why = "is a " + name + " picture, which cannot be decoded here; make it a PNG";
    return opened;
  }
  opened.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(
      const_cast<uint8_t*>(bytes.data()), bytes.size());
  OIIO::ImageSpec config;
  // Do not multiply colours by alpha.
  config.attribute("oiio:UnassociatedAlpha", 1);
  auto input = OIIO::ImageInput::create(name, false, &config, opened.memory.get());
  if (input == nullptr || !input->supports("ioproxy")) {
    why = "is a " + name + " image, which cannot be decoded here";
    OIIO::geterror();  // otherwise OpenImageIO keeps the error and prints it at exit
    return opened;
  }
  input->set_ioproxy(opened.memory.get());
  OIIO::ImageSpec spec;
  const bool isOpen = [&] {
    const auto lock = openingAPicture();
    return input->open("image." + name, spec, config);
  }();
  if (!isOpen) {
    why = "cannot be decoded (" + oneLine(input->geterror()) + ")";
    return opened;
  }
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0 ||
      spec.nchannels > 16) {
    why = "is not a picture";
    return opened;
  }
  if (int64_t{spec.width} * spec.height > kMostPixels) {
    why = "has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
          " pixels, more than 8192 x 8192";
    return opened;
  }
  opened.input = std::move(input);
  return opened;
}

// The samples of all channels; empty if they cannot be read.
template <typename Sample>
std::vector<Sample> samplesOf(const Opened& opened, OIIO::TypeDesc type, std::string& why) {
  if (opened.input == nullptr) return {};
  const OIIO::ImageSpec& spec = opened.input->spec();
  std::vector<Sample> samples(spec.image_pixels() * static_cast<size_t>(spec.nchannels));
  if (opened.input->read_image(0, 0, 0, spec.nchannels, type, samples.data())) return samples;
  why = "cannot be decoded (" + oneLine(opened.input->geterror()) + ")";
  return {};
}

}  // namespace

bool checkImageHeader(std::span<const uint8_t> bytes, std::string& why) {
  return open(bytes, why).input != nullptr;
}

std::optional<Image8> decodeImage8(std::span<const uint8_t> bytes, std::string& why) {
  const Opened opened = open(bytes, why);
  const auto raw = samplesOf<uint8_t>(opened, OIIO::TypeDesc::UINT8, why);
  if (raw.empty()) return std::nullopt;
  const OIIO::ImageSpec& spec = opened.input->spec();
  const size_t channels = static_cast<size_t>(spec.nchannels), pixels = raw.size() / channels;
  Image8 image(spec.width, spec.height);
  const bool isGray = channels <= 2, hasAlpha = channels == 2 || channels >= 4;
  for (size_t i = 0; i < pixels; ++i) {
    const uint8_t* in = &raw[i * channels];
    uint8_t* out = &image.pixels[i * 4];
    out[0] = in[0];
    out[1] = isGray ? in[0] : in[1];
    out[2] = isGray ? in[0] : in[2];
    out[3] = hasAlpha ? in[isGray ? 1 : 3] : uint8_t{255};
  }
  return image;
}

std::optional<Image> decodeImage(std::span<const uint8_t> bytes, std::string& why) {
  const Opened opened = open(bytes, why);
  const auto raw = samplesOf<float>(opened, OIIO::TypeDesc::FLOAT, why);
  if (raw.empty()) return std::nullopt;
  const OIIO::ImageSpec& spec = opened.input->spec();
  const size_t channels = static_cast<size_t>(spec.nchannels), pixels = raw.size() / channels;
  const bool isEncoded = spec.format.basetype == OIIO::TypeDesc::UINT8 ||
                         spec.format.basetype == OIIO::TypeDesc::UINT16;
  Image image(spec.width, spec.height);
  for (size_t i = 0; i < pixels; ++i) {
    for (size_t c = 0; c < 3; ++c) {
      const float v = raw[i * channels + (channels <= 2 ? 0 : c)];
      image.pixels[i][static_cast<int>(c)] = isEncoded ? decodeSrgb(v) : v;
    }
  }
  return image;
}

}  // namespace lamplighter
