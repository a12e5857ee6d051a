#include "editor/input/recording.h"

#include <fstream>

#include <gtest/gtest.h>

#include "editor/input/player.h"
#include "editor/input/recorder.h"
#include "renderer/base/error.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

class RecordingFile : public testing::Test {
 protected:
  fs::path path_ =
      fs::path(testing::TempDir()) /
      ("lamplighter_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
       ".jsonl");
  void TearDown() override { fs::remove(path_); }
  void write(const std::string& text) { std::ofstream(path_) << text; }
  std::string complaint(const std::string& text) {
    write(text);
    try {
      readRecording(path_);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

std::vector<InputEvent> oneOfEach() {
  InputEvent pointer{EventKind::pointer, "viewport", vec2(12.5f, 33.0f)};
  InputEvent button{EventKind::button};
  button.button = 1;
  button.down = true;
  InputEvent wheel{EventKind::wheel};
  wheel.wheel = vec2(0.0f, -1.0f);
  InputEvent key{EventKind::key};
  key.key = Key::del;
  InputEvent text{EventKind::text};
  text.text = "ü\"5";
  InputEvent action{EventKind::action};
  action.text = "light.add rectangle";
  return {pointer, button, wheel, key, text, action};
}

TEST_F(RecordingFile, ARecordingIsWrittenAndReadBack) {
  RecordingHeader header;
  header.scene = "scene.gltf";
  header.left = "left_behind";
  header.render.exposureEv = 1.5f;
  header.render.values.set("vpls", 64);
  header.render.values.set("direct_share", 0.25f);
  {
    Recorder recorder(path_, header);
    recorder.frame({});
    recorder.frame(oneOfEach());
    recorder.checkpoint({"end", "00ff", true, "start", 3.0f, 0.25f});
  }
  const Recording r = readRecording(path_);
  EXPECT_EQ(r.header.render, header.render);
  EXPECT_EQ(r.scenePath(), path_.parent_path() / "scene.gltf");
  EXPECT_EQ(r.leftPath(), path_.parent_path() / "left_behind");
  ASSERT_EQ(r.lines.size(), oneOfEach().size() + 1);
  for (size_t i = 0; i < oneOfEach().size(); ++i) {
    EXPECT_EQ(r.lines[i].frame, 1u);
    EXPECT_EQ(std::get<InputEvent>(r.lines[i].what), oneOfEach()[i]) << i;
  }
  EXPECT_EQ(std::get<Checkpoint>(r.lines.back().what),
            (Checkpoint{"end", "00ff", true, "start", 3.0f, 0.25f}));

  Recording again = r;
  writeRecording(again);
  EXPECT_EQ(readRecording(path_).lines.size(), r.lines.size());
}

TEST_F(RecordingFile, ConsecutivePointerEventsAreMerged) {
  {
    Recorder recorder(path_, {});
    InputEvent a{EventKind::pointer, "", vec2(1.0f)}, b{EventKind::pointer, "", vec2(2.0f)};
    recorder.frame({a, b});
  }
  const Recording r = readRecording(path_);
  ASSERT_EQ(r.lines.size(), 1u);
  EXPECT_EQ(std::get<InputEvent>(r.lines[0].what).position, vec2(2.0f));
}

TEST_F(RecordingFile, ErrorsNameTheLine) {
  const std::string header = "{\"lamplighter\":1}\n";
  EXPECT_NE(complaint("").find("is empty"), std::string::npos);
  EXPECT_NE(complaint("{\"lamplighter\":2}\n").find(":1: "), std::string::npos);
  EXPECT_NE(complaint("nonsense\n").find(":1: "), std::string::npos);
  EXPECT_NE(complaint(header + "{\"f\":1,\"key\":\"w\",\"down\":true}\n{\"f\":0,\"text\":\"x\"}\n")
                .find(":3: has a frame number below"),
            std::string::npos);
  EXPECT_NE(complaint(header + "{\"f\":1,\"key\":\"hyper\",\"down\":true}\n").find("no known key"),
            std::string::npos);
  EXPECT_NE(complaint(header + "{\"f\":1,\"button\":7,\"down\":true}\n").find(":2: "),
            std::string::npos);
  EXPECT_NE(complaint(header + "{\"f\":1}\n").find("neither"), std::string::npos);
  EXPECT_NE(complaint(header + "{\"text\":\"x\"}\n").find(":2: "), std::string::npos);
  EXPECT_NE(complaint(header + "{\"f\":1,\"check\":\"a/b\"}\n").find("usable name"),
            std::string::npos);
  EXPECT_NE(complaint("{\"lamplighter\":1,\"settings\":{\"vpls\":-4}}\n").find("vpls"),
            std::string::npos);
  EXPECT_NE(complaint("{\"lamplighter\":1,\"method\":\"magic\"}\n").find("magic"),
            std::string::npos);
}

Recording threeLines() {
  Recording r;
  InputEvent key{EventKind::key};
  key.key = Key::w;
  r.lines = {{1, key}, {2, Checkpoint{"a"}}, {2, key}};
  return r;
}

TEST(Player, TheClockStopsWhileACheckpointWaits) {
  Player p(threeLines());
  EXPECT_TRUE(p.beginFrame().empty());  // frame 0
  EXPECT_TRUE(p.endFrame(false).empty());
  EXPECT_EQ(p.beginFrame().size(), 1u);  // frame 1
  EXPECT_TRUE(p.endFrame(false).empty());
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(p.beginFrame().empty());  // frame 2, five times
    EXPECT_TRUE(p.endFrame(false).empty());
    EXPECT_EQ(p.frame(), 2u);
  }
  EXPECT_TRUE(p.beginFrame().empty());
  EXPECT_EQ(p.endFrame(true).size(), 1u);
  EXPECT_FALSE(p.finished());
  EXPECT_EQ(p.beginFrame().size(), 1u);  // the event after the checkpoint
  p.endFrame(false);
  EXPECT_TRUE(p.finished());
}

TEST(Player, EndsAReplayThatNeverSettles) {
  Player p(threeLines(), 10);
  EXPECT_THROW(
      for (int i = 0; i < 20; ++i) {
        p.beginFrame();
        p.endFrame(false);
      },
      InputError);
}

}  // namespace
}  // namespace lamplighter
