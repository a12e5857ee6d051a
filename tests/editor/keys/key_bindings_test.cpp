// Key bindings: presets, the file of the user, and reports of conflicts.
#include "editor/keys/key_bindings.h"

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "editor/keys/key_presets.h"
#include "editor/session/register_actions.h"

namespace lamplighter {
namespace {

class KeyBindings : public testing::Test {
 protected:
  void SetUp() override { addAllActions(registry_); }
  void bind(const KeyList& preset, const std::string& file) {
    problems_.clear();
    registry_.setKeys(resolveKeys(registry_, preset, parseKeys(file, problems_), problems_));
  }
  std::string at(Key key, Modifiers m = {}) const { return registry_.textForKey(key, m); }

  ActionRegistry registry_;
  std::vector<std::string> problems_;
};

TEST_F(KeyBindings, EveryDefaultKeyBelongsToOneAction) {
  std::map<std::string, std::string> owner;
  for (const auto& [text, chords] : registry_.defaultKeys()) {
    for (const Chord& chord : chords)
      EXPECT_TRUE(owner.emplace(chordText(chord), text).second)
          << chordText(chord) << ": " << text << " and " << owner[chordText(chord)];
  }
}

TEST_F(KeyBindings, ChordsAreParsedAndFormatted) {
  for (const char* text : {"G", "Ctrl+Shift+Z", "F6", "Alt+Left", "Ctrl+Page_up", "Delete"}) {
    ASSERT_TRUE(parseChord(text)) << text;
    EXPECT_EQ(parseChord(chordText(*parseChord(text))), parseChord(text)) << text;
  }
  for (const char* bad : {"", "Ctrl", "Ctrl+", "Strg+A", "Ctrl+Ctrl+A", "Foo", "Shift", "a b"})
    EXPECT_FALSE(parseChord(bad)) << bad;
}

TEST_F(KeyBindings, PresetsMoveTheTools) {
  bind(keysOfPreset("grs"), "{}");
  EXPECT_EQ(at(Key::g), "tool.move");
  EXPECT_EQ(at(Key::r), "tool.rotate");
  EXPECT_EQ(at(Key::s), "tool.scale");
  EXPECT_EQ(at(Key::w), "");
  EXPECT_EQ(registry_.find("tool.move")->shortcut, "G");
  EXPECT_NE(registry_.find("tool.snap")->shortcut, "") << "the action of S gets another key";
  bind(keysOfPreset("wer"), "{}");
  EXPECT_EQ(at(Key::w), "tool.move");
  EXPECT_TRUE(problems_.empty());
}

TEST_F(KeyBindings, TheFileOverridesThePreset) {
  bind(keysOfPreset("grs"),
       R"({"tool.move": "Ctrl+M", "light.add disk": "Ctrl+Shift+D", "view.vpls": ""})");
  EXPECT_TRUE(problems_.empty()) << problems_[0];
  EXPECT_EQ(at(Key::m, {.ctrl = true}), "tool.move");
  EXPECT_EQ(at(Key::g), "");
  EXPECT_EQ(at(Key::d, {.ctrl = true, .shift = true}), "light.add disk");
  EXPECT_EQ(registry_.keysOf("light.add disk"), "Ctrl+Shift+D");
  EXPECT_EQ(registry_.forKey(Key::d, {.ctrl = true, .shift = true})->name, "light.add");
  EXPECT_EQ(at(Key::v), "");
  EXPECT_EQ(registry_.find("view.vpls")->shortcut, "");
}

TEST_F(KeyBindings, ProblemsAreOneLineEach) {
  bind({}, R"({"tool.mvoe": "G", "tool.move": "Ctrl+Foo", "tool.scale": 3})");
  ASSERT_EQ(problems_.size(), 3u);
  EXPECT_NE(problems_[0].find("\"tool.move\": \"Ctrl+Foo\" is not a key"), std::string::npos);
  EXPECT_NE(problems_[1].find("tool.scale"), std::string::npos);
  EXPECT_NE(problems_[2].find("\"tool.mvoe\": there is no such action"), std::string::npos);
  EXPECT_EQ(at(Key::w), "tool.move");
  bind({}, "][");
  EXPECT_EQ(problems_.size(), 1u);
}

TEST_F(KeyBindings, ConflictsAreReported) {
  bind({}, R"({"tool.move": "G", "tool.scale": "G"})");
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_NE(problems_[0].find("G is already the key of \"tool.move\""), std::string::npos)
      << problems_[0];
  EXPECT_EQ(at(Key::g), "tool.move");
  bind({}, R"({"tool.move": "L"})");
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_NE(problems_[0].find("takes L from \"panel.lights\""), std::string::npos) << problems_[0];
  // The file binds both actions, so the conflict is intended and not reported.
  bind({}, R"({"tool.move": "L", "panel.lights": "G"})");
  EXPECT_TRUE(problems_.empty());
  EXPECT_EQ(at(Key::l), "tool.move");
  EXPECT_EQ(at(Key::g), "panel.lights");
}

}  // namespace
}  // namespace lamplighter
