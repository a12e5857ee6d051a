#include <algorithm>

#include "renderer/scene/gltf/gltf_content.h"

namespace lamplighter {

namespace {

TextureRef readTextureRef(const GltfDocument& document, const Json& owner, const char* key, At at) {
  TextureRef ref;
  const Json* json = member(owner, key);
  if (json == nullptr) return ref;
  const auto index = indexMember(document, *json, "index", at, listOf(document, "textures").size());
  if (!index) return ref;
  ref.texture = static_cast<int>(*index);
  size_t set = sizeMember(document, *json, "texCoord", at).value_or(0);
  if (const Json* transform = extensionOf(*json, "KHR_texture_transform")) {
    const std::vector<double> offset = numbersMember(document, *transform, "offset", 2, at);
    const std::vector<double> scale = numbersMember(document, *transform, "scale", 2, at);
    if (!offset.empty()) ref.offset = vec2(offset[0], offset[1]);
    if (!scale.empty()) ref.scale = vec2(scale[0], scale[1]);
    ref.rotation = static_cast<float>(numberMember(document, *transform, "rotation", 0.0, at));
    set = sizeMember(document, *transform, "texCoord", at).value_or(set);
  }
  ref.texCoord = static_cast<int>(std::min<size_t>(set, 1));
  return ref;
}

float unitMember(const GltfDocument& document, const Json& object, const char* key,
                 double otherwise, At at) {
  return static_cast<float>(
      std::clamp(numberMember(document, object, key, otherwise, at), 0.0, 1.0));
}

}  // namespace

Material readMaterial(const GltfDocument& document, size_t index) {
  const At at{"materials", index};
  const Json& json = listOf(document, "materials")[index];
  Material m;
  m.name = textMember(document, json, "name", at);

  if (const Json* pbr = member(json, "pbrMetallicRoughness")) {
    const std::vector<double> color = numbersMember(document, *pbr, "baseColorFactor", 4, at);
    // An albedo above 1 would reflect more light than it receives.
    if (!color.empty()) {
      m.baseColor = glm::clamp(vec4(color[0], color[1], color[2], color[3]), 0.0f, 1.0f);
    }
    m.baseColorTexture = readTextureRef(document, *pbr, "baseColorTexture", at);
    m.metallic = unitMember(document, *pbr, "metallicFactor", 1.0, at);
    m.roughness = unitMember(document, *pbr, "roughnessFactor", 1.0, at);
    m.metallicRoughnessTexture = readTextureRef(document, *pbr, "metallicRoughnessTexture", at);
  }
  if (const Json* normal = member(json, "normalTexture")) {
    m.normalTexture = readTextureRef(document, json, "normalTexture", at);
    m.normalScale = static_cast<float>(numberMember(document, *normal, "scale", 1.0, at));
  }
  m.emissiveTexture = readTextureRef(document, json, "emissiveTexture", at);
  const std::vector<double> emissive = numbersMember(document, json, "emissiveFactor", 3, at);
  if (!emissive.empty()) {
    double strength = 1.0;
    if (const Json* extension = extensionOf(json, "KHR_materials_emissive_strength")) {
      strength = numberMember(document, *extension, "emissiveStrength", 1.0, at);
    }
    // The product in double, so that a saved factor and strength are read back bit-equal.
    for (int c = 0; c < 3; ++c) {
      const double value = std::max(emissive[static_cast<size_t>(c)] * strength, 0.0);
      if (value > 1e30) document.fail(at, "emits more than a float can hold", kExportAgain);
      m.emissive[c] = static_cast<float>(value);
    }
  }
  if (const Json* transmission = extensionOf(json, "KHR_materials_transmission")) {
    m.transmission = unitMember(document, *transmission, "transmissionFactor", 0.0, at);
  }
  const std::string mode = textMember(document, json, "alphaMode", at);
  if (mode == "MASK") m.alphaMode = AlphaMode::mask;
  if (mode == "BLEND") m.alphaMode = AlphaMode::blend;
  m.alphaCutoff = static_cast<float>(numberMember(document, json, "alphaCutoff", 0.5, at));
  m.doubleSided = boolMember(document, json, "doubleSided", false, at);
  return m;
}

std::vector<Material> readMaterials(GltfDocument& document) {
  std::vector<Material> materials;
  const size_t count = listOf(document, "materials").size();
  for (size_t i = 0; i < count; ++i) materials.push_back(readMaterial(document, i));
  return materials;
}

}  // namespace lamplighter
