#include "editor/lights/light_table_edits.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "editor/edits/edits.h"
#include "editor/lights/light_edits.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

// A number and the rest of the text. Commas may separate thousands.
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
    throw InputError(text.empty() ? "the cell" : text, "is not a number", "type one such as 800");
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

void rename(Editing& editing, const std::string& name) {
  std::vector<Node> nodes;
  for (const LightSource& light : selectedLights(editing.document())) {
    nodes.push_back(editing.document().scene.nodes[light.index]);
    nodes.back().name = nodes.size() == 1 ? name : name + " " + std::to_string(nodes.size());
  }
  setNodes(editing, "Rename lights", std::move(nodes));
}

void resize(Editing& editing, const std::string& text) {
  const auto [width, height] = sizes(text);
  const auto lights = selectedLights(editing.document());
  const auto any = [&](LightProperty p) {
    return commonValue(editing.document().scene, lights, p, LightUnit::lumens).count > 0;
  };
  Transaction edit = editing.begin("Change size of lights");
  editLights(editing, LightOperation::set, LightProperty::width, width, LightUnit::lumens);
  if (any(LightProperty::height))
    editLights(editing, LightOperation::set, LightProperty::height, height, LightUnit::lumens);
  edit.commit();
}

}  // namespace

bool isTyped(LightColumn column) {
  return column == LightColumn::name || column == LightColumn::strength ||
         column == LightColumn::temperature || column == LightColumn::size ||
         column == LightColumn::group;
}

const char* columnName(LightColumn column) {
  static constexpr std::pair<LightColumn, const char*> kNames[] = {
      {LightColumn::name, "name"},   {LightColumn::strength, "strength"},
      {LightColumn::size, "size"},   {LightColumn::temperature, "temperature"},
      {LightColumn::group, "group"}, {LightColumn::colour, "colour"}};
  for (const auto& [named, name] : kNames)
    if (named == column) return name;
  return "";
}

void editLightTableCells(Editing& editing, LightColumn column, const std::string& text,
                         LightUnit shown) {
  const auto lights = selectedLights(editing.document());
  if (lights.empty()) throw InputError("lights", "no light is selected", "select one or more");
  switch (column) {
    case LightColumn::name:
      if (text.empty()) throw InputError("a light", "must have a name", "type a name");
      return rename(editing, text);
    case LightColumn::group:
      return groupLights(editing, text);
    case LightColumn::size:
      return resize(editing, text);
    case LightColumn::temperature: {
      return editLights(editing, LightOperation::set, LightProperty::temperature, typed(text).value,
                        LightUnit::lumens);
    }
    case LightColumn::strength: {
      const Typed value = typed(text);
      LightUnit unit =
          commonValue(editing.document().scene, lights, LightProperty::intensity, shown)
              .unitOr(shown);
      if (!value.rest.empty()) {
        const auto named = unitNamed(value.rest);
        if (!named)
          throw InputError(value.rest, "is not a unit of light", "give lm, cd, nt, W or lx");
        unit = *named;
      }
      return editLights(editing, LightOperation::set, LightProperty::intensity, value.value, unit);
    }
    default:
      throw InputError("the column", "cannot be edited", "choose another column");
  }
}

}  // namespace lamplighter
