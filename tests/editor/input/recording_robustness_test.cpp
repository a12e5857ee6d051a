// Recordings may be edited by hand and may come from anywhere. Reading one gives either valid
// values or an error of one line.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "editor/input/player.h"
#include "editor/input/recorder.h"
#include "editor/input/recording.h"
#include "renderer/base/error.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

const std::string kHeader = "{\"lamplighter\":1}\n";

class RecordingRobustness : public testing::Test {
 protected:
  fs::path path_ =
      fs::path(testing::TempDir()) /
      ("lamplighter_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
       ".jsonl");
  void TearDown() override { fs::remove(path_); }
  Recording read(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return readRecording(path_);
  }
  std::string complaint(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(RecordingRobustness, InvalidNumbersAreRefused) {
  for (const char* line : {
           R"({"f":-1,"text":"x"})",
           R"({"f":1.5,"text":"x"})",
           R"({"f":4294967295,"text":"x"})",  // a frame number that would take years
           R"({"f":99999999999,"text":"x"})",
           R"({"f":"1","text":"x"})",
           R"({"f":1,"pointer":[1e39,0]})",  // beyond the range of float
           R"({"f":1,"pointer":[1,"x"]})",
           R"({"f":1,"pointer":[1]})",
           R"({"f":1,"pointer":{"x":1}})",
           R"({"f":1,"wheel":[0,-1e39]})",
           R"({"f":1,"button":1.5,"down":true})",
           R"({"f":1,"button":0})",
           R"({"f":1,"button":0,"down":1})",
           R"({"f":1,"key":7,"down":true})",
           R"({"f":1,"key":"none","down":true})",
           R"({"f":1,"text":5})",
           R"({"f":1,"check":"a","max":"much"})",
           R"({"f":1,"check":"a","max":-1})",
           R"({"f":1,"check":"a","mean":1e39})",
           R"({"f":1,"check":""})",
           R"([1])",
           R"({"f":1,)",
       }) {
    const std::string message = complaint(kHeader + line + "\n");
    EXPECT_NE(message.find(":2: "), std::string::npos) << line << " → " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << line;
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
  }
}

TEST_F(RecordingRobustness, InvalidHeadersAreRefused) {
  for (const char* header : {
           R"({"lamplighter":1,"window":[1e30,600]})",
           R"({"lamplighter":1,"window":[0,600]})",
           R"({"lamplighter":1,"window":"big"})",
           R"({"lamplighter":1,"fps":0})",
           R"({"lamplighter":1,"fps":1e12})",
           R"({"lamplighter":1,"exposure":1e39})",
           R"({"lamplighter":1,"scene":7})",
           R"({"lamplighter":1,"left":"../.."})",
           R"({"lamplighter":1,"left":".."})",
           R"({"lamplighter":1,"left":"/home"})",
           R"({"lamplighter":1,"settings":[1]})",
           R"({"lamplighter":"1"})",
       }) {
    const std::string message = complaint(std::string(header) + "\n");
    EXPECT_NE(message.find(":1: "), std::string::npos) << header << " → " << message;
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
  }
}

TEST_F(RecordingRobustness, DeeplyNestedJsonIsRefused) {
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  EXPECT_NE(complaint(kHeader + "{\"f\":1,\"text\":" + deep + "}\n").find(":2: "),
            std::string::npos);
}

TEST_F(RecordingRobustness, TwoCheckpointsWithTheSameNameAreRefused) {
  // They would share one baseline.
  const std::string check = "{\"f\":1,\"check\":\"end\"}\n";
  EXPECT_NE(complaint(kHeader + check + check).find(":3: "), std::string::npos);
}

TEST_F(RecordingRobustness, WindowsLineEndingsAreAccepted) {
  const Recording r = read("{\"lamplighter\":1}\r\n\r\n{\"f\":2,\"text\":\"x\"}\r\n");
  ASSERT_EQ(r.lines.size(), 1u);
  EXPECT_EQ(std::get<InputEvent>(r.lines[0].what).text, "x");
}

TEST_F(RecordingRobustness, SettingsOfAnotherMethodAreKeptInTheHeader) {
  RecordingHeader header;
  header.render.method = "reference";
  header.render.values.set("vpls", 77);  // a parameter of many_lights
  header.render.values.set("samples_per_pixel", 4);
  { Recorder recorder(path_, header); }
  EXPECT_EQ(readRecording(path_).header.render, header.render);
}

TEST_F(RecordingRobustness, FloatsAreRestoredBitForBit) {
  const float values[] = {0.1f, 1.0f / 3.0f, 16777217.0f, 1e-7f, 123.456f, -0.5f, 3.0e7f};
  {
    Recorder recorder(path_, {});
    for (const float v : values) {
      InputEvent e{EventKind::pointer, "viewport", vec2(v, -v)};
      recorder.frame({e});
    }
  }
  const Recording r = readRecording(path_);
  ASSERT_EQ(r.lines.size(), std::size(values));
  for (size_t i = 0; i < std::size(values); ++i)
    EXPECT_EQ(std::get<InputEvent>(r.lines[i].what).position, vec2(values[i], -values[i]));
}

TEST_F(RecordingRobustness, PlaybackGivesTheRecordedEvents) {
  // Frames without events, frames with several events, and a checkpoint between frames.
  std::vector<std::vector<InputEvent>> frames(12);
  InputEvent press{EventKind::button};
  press.down = true;
  InputEvent action{EventKind::action};
  action.text = "light.add \"rectangle\"";
  frames[3] = {InputEvent{EventKind::pointer, "viewport", vec2(4, 5)}, press};
  frames[7] = {action, action};
  frames[11] = {press};
  {
    Recorder recorder(path_, {});
    for (size_t f = 0; f < frames.size(); ++f) {
      if (f == 9) recorder.checkpoint({"middle"});
      recorder.frame(frames[f]);
    }
  }
  Player player(readRecording(path_));
  int waits = 3, checks = 0;
  for (size_t rendered = 0; !player.finished(); ++rendered) {
    ASSERT_LT(rendered, 100u);
    const uint32_t f = player.frame();
    const auto events = player.beginFrame();
    EXPECT_EQ(events, frames[f]) << f;  // frame 9 waits for the checkpoint and has no events
    const bool settled = f == 9 ? --waits < 0 : false;
    for (const Checkpoint& c : player.endFrame(settled)) {
      EXPECT_EQ(c.name, "middle");
      EXPECT_EQ(f, 9u);
      ++checks;
    }
  }
  EXPECT_EQ(checks, 1);
  EXPECT_EQ(player.frame(), 12u);
}

}  // namespace
}  // namespace lamplighter
