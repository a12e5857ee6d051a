// The pictures in the guide are what the program shows after the steps that stand in its pages:
// each page's steps are replayed without a window, and the pictures compared with those beside it.
// `./dev guide` sets LAMPLIGHTER_UPDATE_GUIDE and so writes them anew.
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

// Drivers of OpenGL round the edges of letters and the picture's colours otherwise, by a level or
// two; a word that is not there makes 10 and more of its tile, and a panel that is wider by a pixel
// moves all the text in it.
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
    // What is as good as the same stays, so that only what changed is a change.
    const bool stays =
        fs::exists(wanted) && comparePictures(readPicture(now), readPicture(wanted)).none();
    if (!stays) fs::copy_file(now, wanted, fs::copy_options::overwrite_existing);
  }
  ASSERT_TRUE(fs::exists(wanted)) << wanted << " is missing; run ./dev guide";
  EXPECT_LE(fs::file_size(wanted), kLargestFile) << wanted;
  // Both have been through JPEG, so that its loss is in both.
  const Image8 a = readPicture(now), b = readPicture(wanted);
  const PictureDifference d = comparePictures(a, b);
  const bool isSame = d.sameSize && d.mean <= kMostMean && d.tile <= kMostOfTile;
  const fs::path heat = folder_ / (picture + ".difference.png");
  if (d.sameSize && !isSame) writePng(differencePicture(a, b), heat);
  EXPECT_TRUE(isSame) << wanted.filename() << ": " << d.text() << ", " << d.tile
                      << " in the mean of a tile; see " << now << " and " << heat
                      << "; if it is meant to, run ./dev guide and look at what it wrote";
  RecordProperty(picture, std::to_string(d.mean) + " " + std::to_string(d.tile));
}

// The page's commands on what was saved: in the folder of the replay, where it saved to.
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

TEST_P(GuidePictures, AreWhatTheProgramShows) {
  ASSERT_NO_FATAL_FAILURE(replay());
  for (const std::string& picture : picturesOf(page_)) compare(picture);
  if (page_.name() == "tutorial") runCommands();
}

INSTANTIATE_TEST_SUITE_P(Pages, GuidePictures, testing::Values("tutorial", "guide"),
                         [](const auto& page) { return std::string(page.param); });

}  // namespace
}  // namespace lamplighter::test
