// Presets: each is one step that sets exactly its parameters.
#include "editor/presets/presets.h"

#include "renderer/registry/registry.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

class Presets : public test::SessionFixture {};

TEST_F(Presets, AreOneStepWithUndoAndRedo) {
  session_.runAction("render.set seed=7");
  session_.renderFrame();
  for (const Preset& preset : presets()) {
    SCOPED_TRACE(preset.name);
    const uint64_t before = hash();
    const size_t position = session_.history().position();
    ASSERT_TRUE(session_.runAction("preset." + preset.name)) << session_.status();
    const Action* action = session_.actions().find("preset." + preset.name);
    EXPECT_TRUE(action->checked(session_));
    EXPECT_EQ(session_.history().position(), position + 1);
    EXPECT_EQ(session_.history().undoLabel(), "Preset " + preset.label);
    const uint64_t after = hash();
    EXPECT_NE(after, before);
    EXPECT_EQ(std::get<int>(session_.document().render.values.values().at("seed")), 7);
    for (const Preset& other : presets())
      EXPECT_EQ(hasPreset(session_.document().render, other), other.name == preset.name);
    session_.undo();
    EXPECT_EQ(hash(), before);
    session_.redo();
    EXPECT_EQ(hash(), after);
  }
}

TEST_F(Presets, SetValidValues) {
  for (const Preset& preset : presets()) {
    for (const auto& [name, value] : preset.values.values()) {
      bool found = false;
      for (const MethodInfo& method : methods())
        for (const ParameterSpec& spec : method.parameters)
          if (spec.name == name) {
            EXPECT_EQ(Settings::parse(spec, Settings::format(value)), value) << name;
            found = true;
          }
      EXPECT_TRUE(found) << name;
    }
  }
}

}  // namespace
}  // namespace lamplighter
