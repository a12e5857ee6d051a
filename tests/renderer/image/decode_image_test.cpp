#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/image/image_io.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

using testing::HasSubstr;

Image8 gradient() {
  Image8 image(5, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      uint8_t* p = image.at(x, y);
      p[0] = static_cast<uint8_t>(50 * x);
      p[1] = static_cast<uint8_t>(100 * y);
      p[2] = 77;
      p[3] = static_cast<uint8_t>(10 + 40 * x);  // colours must not be multiplied by it
    }
  }
  return image;
}

TEST(DecodeImage, PngComesBackAsItWas) {
  const Image8 image = gradient();
  std::string why;
  const auto decoded = decodeImage8(encodePng(image), why);
  ASSERT_TRUE(decoded.has_value()) << why;
  EXPECT_EQ(decoded->width, 5);
  EXPECT_EQ(decoded->height, 3);
  EXPECT_EQ(decoded->pixels, image.pixels);
}

TEST(DecodeImage, DamageIsToldOf) {
  const std::vector<uint8_t> whole = encodePng(gradient());
  std::string why;
  EXPECT_FALSE(decodeImage8({}, why).has_value());
  EXPECT_EQ(why, "is empty");
  const std::vector<uint8_t> garbage = {'h', 'e', 'l', 'l', 'o'};
  EXPECT_FALSE(decodeImage8(garbage, why).has_value());
  EXPECT_THAT(why, HasSubstr("no known image format"));
  for (size_t size = 0; size < whole.size() - 12; size += 7) {  // all before the end mark is needed
    why.clear();
    EXPECT_FALSE(decodeImage8(std::span(whole).first(size), why).has_value()) << size << " bytes";
    EXPECT_NE(why, "");
  }
}

uint32_t crc32(std::span<const uint8_t> bytes) {
  uint32_t crc = 0xffffffff;
  for (const uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

// Width and height are in the header: nothing may be allocated because a few bytes say so.
TEST(DecodeImage, UnreasonableSizeIsRefused) {
  std::vector<uint8_t> bytes = encodePng(Image8(1, 1));
  const auto put = [&](size_t at, uint32_t value) {
    for (size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<uint8_t>(value >> (24 - 8 * i));
  };
  put(16, 8193);  // IHDR is at 12: its mark, width, height; its checksum at 29
  put(20, 8193);
  put(29, crc32(std::span(bytes).subspan(12, 17)));
  std::string why;
  EXPECT_FALSE(decodeImage8(bytes, why).has_value());
  EXPECT_THAT(why, HasSubstr("8193 x 8193"));
}

// What would be given its room by the reader already.
TEST(DecodeImage, GifIsRefusedUnread) {
  const std::string_view header = "GIF89a\xff\xff\xff\xff\x80";
  std::vector<uint8_t> bytes(header.begin(), header.end());
  bytes.resize(2000, 0x2c);
  std::string why;
  EXPECT_FALSE(decodeImage8(bytes, why).has_value());
  EXPECT_THAT(why, HasSubstr("gif"));
  EXPECT_THAT(why, HasSubstr("make it a PNG"));
}

TEST(DecodeImage, JpegAndGreyAreExpanded) {
  const auto file = test::sharedScenes() / "classroom" / "textures";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(file)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::vector<char> text((std::istreambuf_iterator<char>(in)), {});
    const std::vector<uint8_t> bytes(text.begin(), text.end());
    std::string why;
    const auto decoded = decodeImage8(bytes, why);
    ASSERT_TRUE(decoded.has_value()) << entry.path() << why;
    EXPECT_TRUE(checkImageHeader(bytes, why));
    EXPECT_EQ(decoded->pixels.size(), size_t{4} * decoded->width * decoded->height);
    const uint8_t* last = decoded->at(decoded->width - 1, decoded->height - 1);
    EXPECT_EQ(last[3], 255) << "no alpha in a JPEG";
    ++count;
  }
  EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace lamplighter
