#include <algorithm>

#include <imgui.h>
// For mixed values, which imgui.h of 1.86 does not declare.
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "editor/lights/light_edits.h"
#include "ui/panels/light_table/light_table_panel.h"
#include "ui/widgets/colour_fields.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

std::string quotedName(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

// "800 lm", "2,700 K", or the range of the values if they differ.
std::string textOf(const CommonValue& v, LightProperty property) {
  if (v.count == 0) return "\u2013";
  std::string unit = lightPropertyInfo(property).unit;
  if (property == LightProperty::intensity) unit = unitSymbol(v.unit);
  if (unit != "\u00b0") unit = " " + unit;
  if (v.hasMixedUnits) return "mixed";
  if (!v.isMixed) return short3(v.least) + unit;
  return "mixed, " + short3(v.least) + " \u2026 " + short3(v.most) + unit;
}

class Bar {
 public:
  Bar(const PanelContext& ui, LightTableState& state, Requests& requests)
      : ui_(ui), state_(state), requests_(requests) {
    lights_ = selectedLights(ui.session.document());
    property_ = lightProperties()[static_cast<size_t>(state.property)].property;
  }

  void draw() {
    const bool any = !lights_.empty();
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kTextDim));
    ImGui::TextUnformatted(!any ? "No light selected"
                           : lights_.size() == 1
                               ? "1 light"
                               : (std::to_string(lights_.size()) + " lights").c_str());
    ImGui::PopStyleColor();
    ui_.name("count");
    ImGui::SameLine(ui_.px(128));
    ImGui::BeginDisabled(!any);
    propertyCombo();
    values();
    gap(14);
    colour();
    states();
    ImGui::EndDisabled();
    groups(any);
  }

 private:
  // Continues on the right, or on a new line if the next item needs more room.
  void gap(float width = 4, float needs = 72) {
    ImGui::SameLine(0, ui_.px(width));
    if (ImGui::GetContentRegionAvail().x < ui_.px(needs)) ImGui::NewLine();
  }

  bool button(const char* widget, const char* label, const char* help) {
    const bool clicked = ImGui::Button(label);
    ui_.name(widget);
    tooltip(ui_, help);
    return clicked;
  }

  void propertyCombo() {
    const auto& all = lightProperties();
    ImGui::SetNextItemWidth(ui_.px(130));
    std::vector<ComboItem> items;
    for (const LightPropertyInfo& info : all) items.push_back({info.name, info.label});
    const LightPropertyInfo& now = lightPropertyInfo(property_);
    const int chosen =
        combo(ui_, "property", now.label, items, static_cast<int>(&now - all.data()));
    if (chosen != kNone) state_.property = chosen;
    gap();
  }

  // The current values, a field for a new value, and the operations.
  void values() {
    const CommonValue common =
        commonValue(ui_.session.document().scene, lights_, property_, ui_.session.lighting().unit);
    const bool isIntensity = property_ == LightProperty::intensity;
    const LightPropertyInfo& info = lightPropertyInfo(property_);
    ImGui::SetNextItemWidth(std::min(ui_.px(190), ImGui::GetContentRegionAvail().x));
    const bool typed = ImGui::InputTextWithHint(
        "##value", textOf(common, property_).c_str(), &state_.value,
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CharsScientific);
    ui_.name("value");
    tooltip(ui_, "Type a number, then set it, multiply by it, or add it. Enter sets.");
    if (isIntensity) {
      gap();
      unitCombo(common.unitOr(ui_.session.lighting().unit));
    }
    gap();
    const std::string unit =
        isIntensity ? std::string(" ") + unitSymbol(common.unitOr(ui_.session.lighting().unit))
                    : "";
    const std::string value = std::string(" ") + info.name + " " + state_.value;
    const bool set = button("set", "Set", "Gives all selected lights this value.");
    gap();
    const bool multiply = button("multiply", "\u00d7", "Multiplies by the number.");
    gap();
    const bool offset = button("offset", "+", "Adds the number, which may be below 0.");
    if (state_.value.empty()) return;
    if (set || typed) requests_.actions.push_back("lights.set" + value + unit);
    if (multiply) requests_.actions.push_back("lights.multiply" + value);
    if (offset) requests_.actions.push_back("lights.offset" + value + unit);
    if (set || typed || multiply || offset) state_.value.clear();
  }

  void unitCombo(LightUnit unit) {
    ImGui::SetNextItemWidth(ui_.px(54));
    static const std::string kUnits[] = {unitSymbol(LightUnit::lumens),
                                         unitSymbol(LightUnit::candela),
                                         unitSymbol(LightUnit::nits), unitSymbol(LightUnit::watts)};
    const int chosen = combo(ui_, "unit", unitSymbol(unit), kUnits);
    tooltip(ui_, "Unit of the strength of lights, here and in the inspector.");
    if (chosen != kNone) requests_.actions.push_back("lights.unit " + kUnits[chosen]);
  }

  void colour() {
    vec3 now(1.0f);
    if (!lights_.empty())
      now = split(emissionOf(ui_.session.document().scene, lights_.back())).colour;
    vec3 shown = linearToSrgb(glm::clamp(now, 0.0f, 1.0f));
    const bool changed = ImGui::ColorEdit3(
        "##colour", &shown.x, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_PickerHueWheel);
    ui_.name("colour");
    tooltip(ui_, "Colour of all selected lights; their brightness does not change.");
    trackEdit(ui_, "Change colour of lights");
    if (changed && luminance(srgbToLinear(shown)) > 0.0f)
      colourLights(ui_.session.editing(), srgbToLinear(shown));
    gap(14);
  }

  void states() {
    const Scene& scene = ui_.session.document().scene;
    const auto all = [&](bool LightState::*flag) {
      return !lights_.empty() &&
             std::all_of(lights_.begin(), lights_.end(),
                         [&](const LightSource& l) { return stateOf(scene, l).*flag; });
    };
    const auto any = [&](bool LightState::*flag) {
      return std::any_of(lights_.begin(), lights_.end(),
                         [&](const LightSource& l) { return stateOf(scene, l).*flag; });
    };
    bool on = all(&LightState::on), solo = all(&LightState::solo);
    ImGui::PushItemFlag(ImGuiItemFlags_MixedValue, !on && any(&LightState::on));
    if (ImGui::Checkbox("On", &on))
      requests_.actions.push_back(std::string("lights.on ") + (on ? "true" : "false"));
    ImGui::PopItemFlag();
    ui_.name("on");
    gap(10);
    ImGui::PushItemFlag(ImGuiItemFlags_MixedValue, !solo && any(&LightState::solo));
    if (ImGui::Checkbox("Solo", &solo))
      requests_.actions.push_back(std::string("lights.solo ") + (solo ? "true" : "false"));
    ImGui::PopItemFlag();
    ui_.name("solo");
  }

  // The group of the selection, and mute and solo of each group.
  void groups(bool any) {
    const Scene& scene = ui_.session.document().scene;
    std::string common = any ? stateOf(scene, lights_.front()).group : "";
    for (const LightSource& l : lights_) {
      if (stateOf(scene, l).group != common) common = "mixed";
    }
    ImGui::AlignTextToFramePadding();
    colouredText("Groups", theme::kTextDim);
    ImGui::SameLine(ui_.px(128));
    ImGui::BeginDisabled(!any);
    ImGui::SetNextItemWidth(ui_.px(130));
    const bool typed =
        ImGui::InputTextWithHint("##group", common.empty() ? "Group of selection" : common.c_str(),
                                 &state_.group, ImGuiInputTextFlags_EnterReturnsTrue);
    ui_.name("group");
    gap();
    const bool set = button("set_group", "Put in", "Puts the selected lights into this group.");
    gap();
    if (button("ungroup", "Take out", "Removes the selected lights from their groups."))
      requests_.actions.push_back("lights.ungroup");
    if ((typed || set) && !state_.group.empty()) {
      requests_.actions.push_back("lights.group " + quotedName(state_.group));
      state_.group.clear();
    }
    ImGui::EndDisabled();
    for (const LightGroup& g : scene.lightGroups) group(g);
  }

  void group(const LightGroup& g) {
    ImGui::PushID(g.name.c_str());
    gap(18, 120);
    if (button(("group/" + g.name).c_str(), g.name.c_str(), "Selects the lights of this group."))
      requests_.actions.push_back("lights.select_group " + quotedName(g.name));
    const auto flag = [&](const char* label, const char* action, const char* widget, bool value,
                          const char* help) {
      ImGui::SameLine(0, ui_.px(1));
      if (value) ImGui::PushStyleColor(ImGuiCol_Button, theme::colour(theme::kAccent, 150));
      if (button(("group/" + g.name + widget).c_str(), label, help))
        requests_.actions.push_back(std::string(action) + " " + quotedName(g.name) +
                                    (value ? " false" : " true"));
      if (value) ImGui::PopStyleColor();
    };
    flag("M", "lights.mute_group", "/mute", g.muted, "Mute: its lights give no light.");
    flag("S", "lights.solo_group", "/solo", g.solo,
         "Solo: only lights and groups that are solo emit.");
    ImGui::PopID();
  }

  const PanelContext& ui_;
  LightTableState& state_;
  Requests& requests_;
  std::vector<LightSource> lights_;
  LightProperty property_ = LightProperty::intensity;
};

}  // namespace

void lightTableBar(PanelContext ui, LightTableState& state, Requests& requests) {
  Bar(ui, state, requests).draw();
}

void swatch(const PanelContext& ui, const vec3& linear, float width) {
  const float most = std::max({linear.r, linear.g, linear.b, 1e-6f});
  const vec3 shown = linearToSrgb(glm::clamp(linear / most, 0.0f, 1.0f));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height},
                                            ImGui::GetColorU32({shown.r, shown.g, shown.b, 1.0f}),
                                            ui.px(3));
  ImGui::Dummy({width, height});
}

}  // namespace lamplighter
