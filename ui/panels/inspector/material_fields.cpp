#include <algorithm>

#include "ui/panels/panels.h"
#include "ui/widgets/colour_fields.h"

namespace lamplighter {
namespace {

// The materials of a mesh, each once, in the order of its primitives.
std::vector<int> materialsOf(const Scene& scene, const Node& node) {
  std::vector<int> materials;
  for (const Primitive& primitive : scene.meshes[static_cast<size_t>(node.mesh)]->primitives)
    if (primitive.material != kNone &&
        std::find(materials.begin(), materials.end(), primitive.material) == materials.end())
      materials.push_back(primitive.material);
  return materials;
}

std::string nameOf(const Scene& scene, int material) {
  const std::string& name = scene.materials[static_cast<size_t>(material)].name;
  return name.empty() ? "material " + std::to_string(material) : name;
}

void emissionFields(const PanelContext& ui, int index, Material& material) {
  const std::string step = "Change emission of " + material.name;
  ColouredStrength emission = split(material.emissive);
  labelledRow(ui, "Emits", "Colour of the emitted light.");
  bool changed = colourField(ui, "emissive.colour", step, emission.colour);
  labelledRow(ui, "Radiance", "Emitted luminance in nits (cd/m\u00b2).");
  changed |= dragField(ui, "emissive.strength", emission.strength,
                       std::max(0.01f, emission.strength * 0.01f), "%.4g nt", 0.0f, 1e6f);
  trackEdit(ui, step);
  if (!changed) return;
  material.emissive = join(emission);
  ui.session.setMaterial(index, material);
}

}  // namespace

void materialFields(PanelContext ui, const Node& node, InspectorState& state) {
  const Scene& scene = ui.session.document().scene;
  const std::vector<int> materials = materialsOf(scene, node);
  if (materials.empty()) {
    note("The file gives this object no material: it is white.");
    return;
  }
  state.slot = std::clamp(state.slot, 0, static_cast<int>(materials.size()) - 1);
  const int index = materials[static_cast<size_t>(state.slot)];
  labelledRow(ui, "Material",
              "The material of the mesh that is shown below. Changes apply to every object with "
              "this material.");
  if (materials.size() == 1) {
    ImGui::TextUnformatted(nameOf(scene, index).c_str());
  } else {
    std::vector<ComboItem> items;
    for (const int m : materials) items.push_back({nameOf(scene, m), nameOf(scene, m)});
    const int chosen = combo(ui, "material", nameOf(scene, index), items, state.slot);
    if (chosen != kNone) state.slot = chosen;
  }

  Material material = scene.materials[static_cast<size_t>(index)];
  vec3 base(material.baseColor);
  labelledRow(ui, "Base colour", "Albedo of the surface.");
  if (colourField(ui, "base", "Change base colour of " + material.name, base)) {
    material.baseColor = vec4(base, material.baseColor.a);
    ui.session.setMaterial(index, material);
  }
  emissionFields(ui, index, material);
  labelledRow(ui, "Both sides", "The back face emits light and is visible, too.");
  bool doubleSided = material.doubleSided;
  if (ImGui::Checkbox("##double", &doubleSided)) {
    material.doubleSided = doubleSided;
    ui.session.setMaterial(index, material);
  }
  ui.name("doubleSided");
  const int textures = (material.baseColorTexture.texture != kNone) +
                       (material.metallicRoughnessTexture.texture != kNone) +
                       (material.normalTexture.texture != kNone) +
                       (material.emissiveTexture.texture != kNone);
  if (textures > 0)
    note(textures == 1 ? std::string("1 texture multiplies these.")
                       : std::to_string(textures) + " textures are on it.");
}

}  // namespace lamplighter
