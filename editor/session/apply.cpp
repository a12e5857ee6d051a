#include "editor/session/apply.h"

#include "editor/keys/key_presets.h"
#include "editor/presets/presets.h"
#include "editor/session/session.h"
#include "editor/session/user_state.h"
#include "renderer/image/tone_map.h"

namespace lamplighter {

namespace {

constexpr std::pair<LightUnit, const char*> kUnitNames[] = {{LightUnit::lumens, "lm"},
                                                            {LightUnit::candela, "cd"},
                                                            {LightUnit::nits, "nits"},
                                                            {LightUnit::watts, "W"}};

}  // namespace

void applyPreferences(Session& s, std::vector<std::string>& problems) {
  const UserSettings settings = s.home().preferences.settings();
  s.actions().setKeys(
      resolveKeys(s.actions(), keysOfPreset(settings.keys), s.home().fileKeys, problems));
  for (const auto& [unit, name] : kUnitNames)
    if (settings.lightUnit == name) s.lighting().unit = unit;
  s.display().setToneMapper(findToneMapper(settings.toneMapper).mapper);
}

void applyPreset(Session& s) {
  const std::string wanted = s.home().preferences.settings().preset;
  for (const Preset& preset : presets()) {
    if (preset.name == wanted)
      s.editing().setInitialRender(withPreset(s.document().render, preset));
  }
}

void takePreferences(Session& s) {
  Preferences& p = s.home().preferences;
  for (const auto& [unit, name] : kUnitNames)
    if (s.lighting().unit == unit) p.set("light_unit", std::string(name));
  p.set("tone_mapper", std::string(infoOf(s.display().toneMapper()).name));
}

}  // namespace lamplighter
