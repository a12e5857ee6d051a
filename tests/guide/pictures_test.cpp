// Checks the pictures of the guide. The steps of each page are replayed without a window, and the
// resulting pictures are compared with those of the page. `./dev guide` sets
// LAMPLIGHTER_UPDATE_GUIDE to update them.
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>

#include <gtest/gtest.h>

#include "renderer/image/image_io.h"
#include "tests/guide/jpeg.h"
#include "tests/guide/page.h"
#include "tests/guide/steps.h"
#include "tests/support/process.h"
#include "ui/app/picture_check.h"

namespace lamplighter::test {
namespace {

namespace fs = std::filesystem;

// OpenGL drivers differ by one or two levels at the edges of letters and in colours. A missing word
// changes the mean of its tile by 10 or more, and a panel that is wider by a pixel moves all its
// text.
constexpr double kMostMean = 0.5, kMostOfTile = 6.0;
constexpr size_t kLargestFile = 120 * 1024;

class GuidePictures : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    page_ = readPage(pagesFolder() / (std::string(GetParam()) + ".md"));
    folder_ = fs::path(LAMPLIGHTER_GUIDE_OUT) / page_.name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void replay() {
    Recording recording = recordingOf(page_);
    recording.path = folder_ / recording.path;
    writeRecording(recording);
    const ProcessResult r = runLamplighter(
        {"replay", recording.path.string(), "--headless", "--frame-clock", "-o", folder_.string()});
    ASSERT_EQ(r.code, 0) << r.err;
  }
  Image8 taken(const std::string& picture) const {
    const fs::path png = folder_ / (page_.name() + "." + picture + ".window.png");
    if (!fs::exists(png)) ADD_FAILURE() << picture << ": no picture; is there OpenGL 4.5 by EGL?";
    return fs::exists(png) ? readPicture(png) : Image8();
  }
  void compare(const std::string& picture);
  void runCommands();

  Page page_;
  fs::path folder_;
};

void GuidePictures::compare(const std::string& picture) {
  const fs::path wanted = pagesFolder() / page_.pictureFile(picture);
  const fs::path now = folder_ / wanted.filename();
  const Image8 image = taken(picture);
  if (image.width == 0) return;
  writeJpeg(image, now);
  if (std::getenv("LAMPLIGHTER_UPDATE_GUIDE") != nullptr) {
    fs::create_directories(wanted.parent_path());
    // Files of equal pictures are not replaced, so that the commit contains only real changes.
    const bool stays =
        fs::exists(wanted) && comparePictures(readPicture(now), readPicture(wanted)).none();
    if (!stays) fs::copy_file(now, wanted, fs::copy_options::overwrite_existing);
  }
  ASSERT_TRUE(fs::exists(wanted)) << wanted << " is missing; run ./dev guide";
  EXPECT_LE(fs::file_size(wanted), kLargestFile) << wanted;
  // Compares two JPEG files, so that both have the same compression errors.
  const Image8 a = readPicture(now), b = readPicture(wanted);
  const PictureDifference d = comparePictures(a, b);
  const bool isSame = d.sameSize && d.mean <= kMostMean && d.tile <= kMostOfTile;
  const fs::path heat = folder_ / (picture + ".difference.png");
  if (d.sameSize && !isSame) writePng(differencePicture(a, b), heat);
  EXPECT_TRUE(isSame) << wanted.filename() << ": " << d.text() << ", " << d.tile
                      << " is the mean difference of a tile; see " << now << " and " << heat
                      << "; if the change is intended, run ./dev guide and check the new pictures";
  RecordProperty(picture, std::to_string(d.mean) + " " + std::to_string(d.tile));
}

// Runs the commands of the page in the folder of the replay, where the level was saved.
void GuidePictures::runCommands() {
  ASSERT_TRUE(fs::exists(folder_ / "reading_room.gltf"));
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  for (const CodeBlock& block : page_.blocks) {
    std::istringstream in(block.text);
    for (std::string line; std::getline(in, line);) {
      if (!line.starts_with("lamplighter ")) continue;
      std::istringstream words(line.substr(line.find(' ')));
      const std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
      const ProcessResult r = runLamplighter(arguments);
      EXPECT_EQ(r.code, 0) << line << ": " << r.err;
    }
  }
  fs::current_path(before);
  EXPECT_TRUE(fs::exists(folder_ / "baked/reading_room.gltf"));
  EXPECT_TRUE(fs::exists(folder_ / "reading_room.png"));
}

TEST_P(GuidePictures, MatchTheProgram) {
  ASSERT_NO_FATAL_FAILURE(replay());
  for (const std::string& picture : picturesOf(page_)) compare(picture);
  if (page_.name() == "tutorial") runCommands();
}

INSTANTIATE_TEST_SUITE_P(Pages, GuidePictures, testing::Values("tutorial", "guide"),
                         [](const auto& page) { return std::string(page.param); });

}  // namespace
}  // namespace lamplighter::test
