#include "ui/app/replay_checks.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "renderer/image/image_io.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter {
namespace {

Image8 grey(uint8_t level) {
  Image8 image(64, 48);
  std::fill(image.pixels.begin(), image.pixels.end(), level);
  return image;
}

class ReplayChecksTest : public testing::Test {
 protected:
  ReplayChecksTest() {
    recording_.path = folder_.path() / "a.jsonl";
    options_.outputFolder = (folder_.path() / "out").string();
    checks_.begin({});
  }
  // Returns whether the check passed.
  bool take(const Checkpoint& checkpoint, const Image8& picture, const char* document = "1") {
    const int before = checks_.failed();
    checks_.take(checkpoint, document, picture);
    return checks_.failed() == before;
  }

  test::TemporaryFolder folder_;
  ReplayOptions options_;
  Recording recording_;
  ReplayChecks checks_{options_, recording_};
  const Checkpoint seen_{"seen", "", true, "", 16.0f, 0.5f}, unseen_{"unseen", "", false};
};

TEST_F(ReplayChecksTest, APictureMayDifferFromItsBaselineInAPixelButNotInABlock) {
  checks_.writeBaseline(seen_, grey(100));
  Image8 picture = grey(100);
  picture.at(10, 10)[0] = 104;
  EXPECT_TRUE(take(seen_, picture));
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) picture.at(x, y)[0] = 110;
  EXPECT_FALSE(take(seen_, picture));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out/a.seen.difference.png"));
}

TEST_F(ReplayChecksTest, ADocumentMustEqualTheRecordedOne) {
  EXPECT_TRUE(take({"a", "1", false}, grey(1)));
  EXPECT_FALSE(take({"b", "2", false}, grey(1)));
}

TEST_F(ReplayChecksTest, SameAsRequiresTheBitsOfTheEarlierCheckpoint) {
  EXPECT_TRUE(take(unseen_, grey(100)));
  const Checkpoint undone{"undone", "", false, "unseen"};
  EXPECT_TRUE(take(undone, grey(100)));
  Image8 picture = grey(100);
  picture.at(10, 10)[0] = 101;
  EXPECT_FALSE(take(undone, picture));
  EXPECT_FALSE(take({"other", "", false, "nowhere"}, grey(100)));
}

TEST_F(ReplayChecksTest, AnotherRunOnTheSameBackendMustHaveTheSameBits) {
  take(unseen_, grey(100));
  checks_.begin({"threads=1", true, true});
  EXPECT_TRUE(take(unseen_, grey(100)));
  EXPECT_FALSE(take(unseen_, grey(100), "2"));
  Image8 picture = grey(100);
  picture.at(10, 10)[0] = 101;
  EXPECT_FALSE(take(unseen_, picture));
  EXPECT_FALSE(take({"never", "", false}, grey(100)));
}

TEST_F(ReplayChecksTest, AnotherBackendMustBeWithinTheToleranceOfTheRecording) {
  take(unseen_, grey(100));
  checks_.begin({"threads=1", true, true});
  take(unseen_, grey(100));
  checks_.begin({"backend=gl", false, false});
  Image8 picture = grey(100);
  picture.at(10, 10)[0] = 200;
  EXPECT_TRUE(take(unseen_, picture));
  EXPECT_FALSE(take(unseen_, grey(101)));
}

}  // namespace
}  // namespace lamplighter
