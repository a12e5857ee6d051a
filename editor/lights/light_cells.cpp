#include "editor/lights/light_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "editor/commands/edits.h"
#include "editor/lights/light_edits.h"
#include "editor/session.h"
#include "renderer/error.h"

namespace lamplighter {

namespace {

// A number and what follows it; thousands may be parted by commas.
struct Typed {
  double value = 0.0;
  std::string rest;
};

Typed typed(std::string text) {
  std::erase(text, ',');
  const char* begin = text.c_str();
  char* end = nullptr;
  Typed out;
  out.value = std::strtod(begin, &end);
  if (end == begin || !std::isfinite(out.value))
    throw InputError(text.empty() ? "the cell" : text, "is no number", "type one such as 800");
  std::istringstream rest(end);
  rest >> out.rest;
  return out;
}

// "1.2 x 0.6", "1.2 \u00d7 0.6", or one number for both.
std::pair<double, double> sizes(const std::string& text) {
  for (const char* between : {"\u00d7", "x", "X", "*"}) {
    const size_t at = text.find(between);
    if (at == std::string::npos) continue;
    return {typed(text.substr(0, at)).value,
            typed(text.substr(at + std::string(between).size())).value};
  }
  const double both = typed(text).value;
  return {both, both};
}

void rename(Session& s, const std::string& name) {
  std::vector<Node> nodes;
  for (const LightSource& light : selectedLights(s.document())) {
    nodes.push_back(s.document().scene.nodes[light.index]);
    nodes.back().name = nodes.size() == 1 ? name : name + " " + std::to_string(nodes.size());
  }
  s.history().run(std::make_unique<EditNodes>("Rename lights", s.document(), std::move(nodes)));
}

void resize(Session& s, const std::string& text) {
  const auto [width, height] = sizes(text);
  const auto lights = selectedLights(s.document());
  const auto any = [&](LightProperty p) {
    return commonValue(s.document().scene, lights, p, LightUnit::lumens).count > 0;
  };
  const bool isOwnStep = !s.history().inTransaction();
  if (isOwnStep) s.history().begin("Change size of lights");
  try {
    editLights(s, LightOperation::set, LightProperty::width, width, LightUnit::lumens);
    if (any(LightProperty::height))
      editLights(s, LightOperation::set, LightProperty::height, height, LightUnit::lumens);
  } catch (const InputError&) {
    if (isOwnStep) s.history().cancel();
    throw;
  }
  if (isOwnStep) s.history().commit();
}

}  // namespace

bool isTyped(LightColumn column) {
  return column == LightColumn::name || column == LightColumn::strength ||
         column == LightColumn::temperature || column == LightColumn::size ||
         column == LightColumn::group;
}

const char* columnName(LightColumn column) {
  switch (column) {
    case LightColumn::name:
      return "name";
    case LightColumn::strength:
      return "strength";
    case LightColumn::temperature:
      return "temperature";
    case LightColumn::size:
      return "size";
    case LightColumn::group:
      return "group";
    case LightColumn::colour:
      return "colour";
    default:
      return "";
  }
}

void editLightCells(Session& s, LightColumn column, const std::string& text) {
  const auto lights = selectedLights(s.document());
  if (lights.empty()) throw InputError("lights", "no light is selected", "select one or more");
  switch (column) {
    case LightColumn::name:
      if (text.empty()) throw InputError("a light", "must have a name", "type one");
      return rename(s, text);
    case LightColumn::group:
      return groupLights(s, text);
    case LightColumn::size:
      return resize(s, text);
    case LightColumn::temperature: {
      return editLights(s, LightOperation::set, LightProperty::temperature, typed(text).value,
                        LightUnit::lumens);
    }
    case LightColumn::strength: {
      const Typed value = typed(text);
      const LightUnit shown = s.lighting().unit;
      LightUnit unit =
          commonValue(s.document().scene, lights, LightProperty::intensity, shown).unitOr(shown);
      if (!value.rest.empty()) {
        const auto named = unitNamed(value.rest);
        if (!named) throw InputError(value.rest, "is no unit of light", "give lm, cd, nt, W or lx");
        unit = *named;
      }
      return editLights(s, LightOperation::set, LightProperty::intensity, value.value, unit);
    }
    default:
      throw InputError("the column", "cannot be typed in", "type in another");
  }
}

}  // namespace lamplighter
