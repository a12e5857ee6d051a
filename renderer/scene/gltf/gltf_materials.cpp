#include <algorithm>

#include <tiny_gltf.h>

#include "renderer/scene/gltf/gltf_content.h"

namespace lamplighter {

namespace {

// `json`: the same texture in the file, for its extensions; may be null.
template <typename TextureInfo>
TextureRef readTextureRef(const TextureInfo& info, const Json* json) {
  TextureRef ref;
  ref.texture = info.index;
  ref.texCoord = std::clamp(info.texCoord, 0, 1);
  if (info.index < 0 || json == nullptr) return ref;
  if (const Json* transform = extensionOf(*json, "KHR_texture_transform")) {
    const std::vector<double> offset = numbersIn(*transform, "offset"),
                              scale = numbersIn(*transform, "scale");
    if (!offset.empty()) ref.offset = vec2(offset[0], offset[1]);
    if (!scale.empty()) ref.scale = vec2(scale[0], scale[1]);
    ref.rotation = static_cast<float>(numberIn(*transform, "rotation", 0.0));
    if (const Json* set = member(*transform, "texCoord")) {
      ref.texCoord = static_cast<int>(std::min<size_t>(set->get<size_t>(), 1));
    }
  }
  return ref;
}

float unit(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

}  // namespace

Material readMaterial(const GltfDocument& document, size_t index) {
  const tinygltf::Material& source = document.model->materials[index];
  const Json& json = listOf(document, "materials")[index];
  Material m;
  m.name = source.name;

  const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
  const std::vector<double>& color = pbr.baseColorFactor;
  // Above one a surface would give back more light than it gets.
  m.baseColor = glm::clamp(vec4(color[0], color[1], color[2], color[3]), 0.0f, 1.0f);
  m.metallic = unit(pbr.metallicFactor);
  m.roughness = unit(pbr.roughnessFactor);
  const Json* pbrJson = member(json, "pbrMetallicRoughness");
  const auto pbrMember = [&](const char* key) { return pbrJson ? member(*pbrJson, key) : nullptr; };
  m.baseColorTexture = readTextureRef(pbr.baseColorTexture, pbrMember("baseColorTexture"));
  m.metallicRoughnessTexture =
      readTextureRef(pbr.metallicRoughnessTexture, pbrMember("metallicRoughnessTexture"));
  m.normalTexture = readTextureRef(source.normalTexture, member(json, "normalTexture"));
  m.normalScale = static_cast<float>(source.normalTexture.scale);
  m.emissiveTexture = readTextureRef(source.emissiveTexture, member(json, "emissiveTexture"));
  const Json* extension = extensionOf(json, "KHR_materials_emissive_strength");
  const double strength = extension ? numberIn(*extension, "emissiveStrength", 1.0) : 1.0;
  // The product in double, so that what is saved as factor and strength comes back as it was.
  for (int c = 0; c < 3; ++c) {
    const double value = std::max(source.emissiveFactor[static_cast<size_t>(c)] * strength, 0.0);
    if (value > 1e30) {
      document.fail(At{"materials", index}, "emits more than a float can hold");
    }
    m.emissive[c] = static_cast<float>(value);
  }
  if (const Json* transmission = extensionOf(json, "KHR_materials_transmission")) {
    m.transmission = unit(numberIn(*transmission, "transmissionFactor", 0.0));
  }
  if (source.alphaMode == "MASK") m.alphaMode = AlphaMode::mask;
  if (source.alphaMode == "BLEND") m.alphaMode = AlphaMode::blend;
  m.alphaCutoff = static_cast<float>(source.alphaCutoff);
  m.doubleSided = source.doubleSided;
  return m;
}

std::vector<Material> readMaterials(GltfDocument& document) {
  std::vector<Material> materials;
  const size_t count = document.model->materials.size();
  for (size_t i = 0; i < count; ++i) materials.push_back(readMaterial(document, i));
  return materials;
}

}  // namespace lamplighter
