// Common values of the selected objects, and edits of all of them: each is one step, or joins the
// open transaction.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "editor/edits/editing.h"

namespace lamplighter {

// A number of a node, as the inspector shows it. Rotations are about X, then Y, then Z, in degrees;
// setting one axis keeps the others.
struct ObjectProperty {
  const char* name;  // "position.x"
  float (*of)(const Node&);
  void (*set)(Node&, float);
};
const std::vector<ObjectProperty>& objectProperties();
// Throws InputError.
const ObjectProperty& objectProperty(const std::string& name);

// The value that all selected nodes share; none if they differ or nothing is selected.
std::optional<float> commonNumber(const Document& document, const ObjectProperty& property);
void setNumber(Editing& editing, const ObjectProperty& property, float value);

// The materials of selected meshes, each once.
std::vector<int> selectedMaterials(const Document& document);
// Changes each of them; one step.
void editMaterials(Editing& editing, const std::string& label,
                   const std::function<void(Material&)>& change);
// Changes each selected node that `applies`; one step.
void editSelected(Editing& editing, const std::string& label,
                  const std::function<bool(const Node&)>& applies,
                  const std::function<void(Node&)>& change);

}  // namespace lamplighter
