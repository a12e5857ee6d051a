#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

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
      p[3] = static_cast<uint8_t>(10 + 40 * x);  // must not be multiplied into the colours
    }
  }
  return image;
}

TEST(DecodeImage, PngRoundTripIsExact) {
  const Image8 image = gradient();
  std::string why;
  const auto decoded = decodeImage8(encodePng(image), why);
  ASSERT_TRUE(decoded.has_value()) << why;
  EXPECT_EQ(decoded->width, 5);
  EXPECT_EQ(decoded->height, 3);
  EXPECT_EQ(decoded->pixels, image.pixels);
}

TEST(DecodeImage, DamagedFilesGiveAReason) {
  const std::vector<uint8_t> whole = encodePng(gradient());
  std::string why;
  EXPECT_FALSE(decodeImage8({}, why).has_value());
  EXPECT_EQ(why, "is empty");
  const std::vector<uint8_t> garbage = {'h', 'e', 'l', 'l', 'o'};
  EXPECT_FALSE(decodeImage8(garbage, why).has_value());
  EXPECT_THAT(why, HasSubstr("no known image format"));
  for (size_t size = 0; size < whole.size() - 12;
       size += 7) {  // the end marker of a PNG may be missing
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

// Width and height are in the header: a small file must not cause a large allocation.
TEST(DecodeImage, UnreasonableSizeIsRejected) {
  std::vector<uint8_t> bytes = encodePng(Image8(1, 1));
  const auto put = [&](size_t at, uint32_t value) {
    for (size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<uint8_t>(value >> (24 - 8 * i));
  };
  put(16, 8193);  // The IHDR chunk: type at 12, width at 16, height at 20, checksum at 29.
  put(20, 8193);
  put(29, crc32(std::span(bytes).subspan(12, 17)));
  std::string why;
  EXPECT_FALSE(decodeImage8(bytes, why).has_value());
  EXPECT_THAT(why, HasSubstr("8193 x 8193"));
}

// The reader would allocate memory for the header's size before the file is checked.
TEST(DecodeImage, GifIsRejectedWithoutDecoding) {
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

// A JPEG with a colour profile whose tags are unknown.
std::vector<uint8_t> withProfile(const std::vector<uint8_t>& jpeg, uint32_t firstTag) {
  constexpr size_t kHeader = 128, kTags = 24, kATag = 12;
  std::vector<uint8_t> profile(kHeader + 4 + kTags * kATag + 16, 0);
  const auto put = [&](size_t at, uint32_t value) {
    for (size_t i = 0; i < 4; ++i) profile[at + i] = static_cast<uint8_t>(value >> (24 - 8 * i));
  };
  const auto text = [&](size_t at, std::string_view of) {
    std::copy(of.begin(), of.end(), profile.begin() + static_cast<ptrdiff_t>(at));
  };
  put(0, static_cast<uint32_t>(profile.size()));
  text(36, "acsp");
  put(kHeader, kTags);
  const size_t data = profile.size() - 16;
  text(data, "text");
  text(data + 8, "unknown");
  for (size_t tag = 0; tag < kTags; ++tag) {
    const size_t at = kHeader + 4 + tag * kATag;
    put(at, firstTag + static_cast<uint32_t>(tag));
    put(at + 4, static_cast<uint32_t>(data));
    put(at + 8, 16);
  }
  // Inserts a second application segment after the first marker.
  const std::string_view name("ICC_PROFILE\0\1\1", 14);
  const size_t length = 2 + name.size() + profile.size();
  std::vector<uint8_t> segment{0xff, 0xe2, static_cast<uint8_t>(length >> 8),
                               static_cast<uint8_t>(length & 0xff)};
  segment.insert(segment.end(), name.begin(), name.end());
  segment.insert(segment.end(), profile.begin(), profile.end());
  std::vector<uint8_t> out = jpeg;
  out.insert(out.begin() + 2, segment.begin(), segment.end());
  return out;
}

// The library registers each unknown tag in a list shared by all threads. Without the lock in
// open_picture.h, two of six runs crashed.
TEST(DecodeImage, ColourProfilesAreReadByManyThreads) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "profile.jpg";
  writePng(gradient(), path);  // the name's extension does not matter
  std::ifstream file(path, std::ios::binary);
  const std::vector<uint8_t> jpeg{std::istreambuf_iterator<char>(file), {}};
  ASSERT_GT(jpeg.size(), 2u);
  constexpr uint32_t kPictures = 600;
  std::atomic<uint32_t> decoded = 0;
  tbb::parallel_for(0u, kPictures, [&](uint32_t i) {
    std::string why;
    decoded += decodeImage8(withProfile(jpeg, 0x61000000u + 64 * i), why).has_value() ? 1 : 0;
  });
  EXPECT_EQ(decoded, kPictures);
}

}  // namespace
}  // namespace lamplighter
