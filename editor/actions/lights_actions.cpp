// Actions that edit all selected lights.
#include "editor/actions/arguments.h"
#include "editor/lights/light_edits.h"
#include "editor/lights/light_table_edits.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

LightProperty propertyNamed(const std::string& name) {
  std::string names;
  for (const LightPropertyInfo& info : lightProperties()) {
    if (name == info.name) return info.property;
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  }
  throw InputError(name, "is not a property of lights", "give one of " + names);
}

LightUnit unitOf(const std::string& name) {
  const auto unit = unitNamed(name);
  if (!unit) throw InputError(name, "is not a unit of light", "give lm, cd, nits, W or lx");
  return *unit;
}

// PROPERTY VALUE [UNIT]
void edit(Session& s, const Arguments& a, LightOperation operation) {
  const LightProperty property = propertyNamed(a[0]);
  // Without a unit the value is in the displayed unit; a sun uses lux.
  const LightUnit shown = s.lighting().unit;
  LightUnit unit =
      commonValue(s.document().scene, selectedLights(s.document()), property, shown).unitOr(shown);
  if (a.size() == 3) {
    if (property != LightProperty::intensity)
      throw InputError(a[2], "is not needed: " + a[0] + " has only one unit", "omit it");
    unit = unitOf(a[2]);
  }
  editLights(s.editing(), operation, property, static_cast<double>(numberOf(a[1])), unit);
}

bool anySelected(const Session& s) { return !selectedLights(s.document()).empty(); }

}  // namespace

void addLightsActions(ActionRegistry& r) {
  const auto add = [&](const char* name, const char* label, const char* usage, const char* help,
                       LightOperation operation) {
    r.add({name, label, usage, help, "",
           [operation](Session& s, const Arguments& a) { edit(s, a, operation); }});
  };
  add("lights.set", "Set of lights", "PROPERTY VALUE [UNIT]",
      "Sets a property of all selected lights: intensity, temperature (K), width or height (m), "
      "inner_cone or outer_cone (degrees).",
      LightOperation::set);
  add("lights.multiply", "Multiply of lights", "PROPERTY FACTOR",
      "Multiplies a property of all selected lights.", LightOperation::multiply);
  add("lights.offset", "Offset of lights", "PROPERTY VALUE [UNIT]",
      "Adds to a property of all selected lights.", LightOperation::offset);
  r.add({"lights.colour", "Colour of lights", "R G B",
         "Sets the linear colour of all selected lights. Their luminous flux stays the same.", "",
         [](Session& s, const Arguments& a) { colourLights(s.editing(), vectorOf(a, 0)); }});
  r.add({"lights.edit", "Edit cells of lights", "name|strength|temperature|size|group VALUE",
         "Sets a column of the light table for all selected lights, from text: a name, 800 lm, "
         "2700 K, 1.2 x 0.6, a group.",
         "",
         [](Session& s, const Arguments& a) {
           for (const LightColumn column :
                {LightColumn::name, LightColumn::strength, LightColumn::temperature,
                 LightColumn::size, LightColumn::group}) {
             if (a[0] == columnName(column))
               return editLightTableCells(s.editing(), column, a[1], s.lighting().unit);
           }
           throw InputError(a[0], "is not a column that can be edited",
                            "give name, strength, temperature, size or group");
         },
         anySelected});
  r.add({"lights.unit", "Unit of light", "lm|cd|nits|W",
         "Sets the unit in which the strength of lights is shown and typed. Lights for which it is "
         "not defined keep their own unit.",
         "", [](Session& s, const Arguments& a) { s.lighting().unit = unitOf(a[0]); }, nullptr,
         true});
  r.add({"lights.select", "Select all lights", "", "Selects every light that is not hidden.", "",
         [](Session& s, const Arguments&) {
           const Scene& scene = s.document().scene;
           const std::vector<bool> visible = visibleNodes(scene);
           std::vector<NodeId> ids;
           for (const LightSource& light : lightsOf(scene)) {
             if (light.node != kNoNode && visible[light.index]) ids.push_back(light.node);
           }
           s.select(std::move(ids));
         }});
  r.add({"lights.brighter", "Double intensity", "", "Doubles the intensity of the selected lights.",
         "",
         [](Session& s, const Arguments&) {
           editLights(s.editing(), LightOperation::multiply, LightProperty::intensity, 2.0,
                      LightUnit::nits);
         },
         anySelected});
  r.add({"lights.darker", "Halve intensity", "", "Halves the intensity of the selected lights.", "",
         [](Session& s, const Arguments&) {
           editLights(s.editing(), LightOperation::multiply, LightProperty::intensity, 0.5,
                      LightUnit::nits);
         },
         anySelected});
}

}  // namespace lamplighter
