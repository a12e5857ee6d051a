#include "renderer/image/image_io.h"
#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/gltf/save/gltf_output.h"

namespace lamplighter {

namespace {

int wrapCode(Wrap wrap) {
  switch (wrap) {
    case Wrap::clamp:
      return 33071;
    case Wrap::mirror:
      return 33648;
    case Wrap::repeat:
      break;
  }
  return 10497;
}

Json newTexture(GltfOutput& out, const Texture& texture) {
  Json image = {{"mimeType", "image/png"},
                {"bufferView", out.appendView(encodePng(*texture.image))}};
  if (!texture.name.empty()) image["name"] = texture.name;
  Json sampler = {{"wrapS", wrapCode(texture.wrapS)}, {"wrapT", wrapCode(texture.wrapT)}};
  if (texture.nearest) sampler["magFilter"] = 9728;
  Json json = {{"sampler", out.append("samplers", std::move(sampler))},
               {"source", out.append("images", std::move(image))}};
  if (!texture.name.empty()) json["name"] = texture.name;
  return json;
}

void saveTextureRef(GltfOutput& out, Json& owner, const char* key, const TextureRef& ref) {
  if (ref.texture == kNone) {
    owner.erase(key);
    return;
  }
  Json& json = owner[key];
  json["index"] = ref.texture;
  json.erase("texCoord");
  if (ref.texCoord != 0) json["texCoord"] = ref.texCoord;
  eraseExtension(json, "KHR_texture_transform");
  TextureRef plain;
  plain.texture = ref.texture;
  plain.texCoord = ref.texCoord;
  if (ref == plain) return;
  Json& transform = extensionObject(json, "KHR_texture_transform");
  transform["offset"] = toJson(ref.offset);
  transform["rotation"] = toJson(ref.rotation);
  transform["scale"] = toJson(ref.scale);
  out.useExtension("KHR_texture_transform");
}

void saveEmission(GltfOutput& out, Json& json, const vec3& emissive) {
  const ScaledColor scaled = scaledColor(emissive);
  json["emissiveFactor"] = scaled.color;
  eraseExtension(json, "KHR_materials_emissive_strength");
  if (scaled.scale == 1.0) return;
  extensionObject(json, "KHR_materials_emissive_strength")["emissiveStrength"] = scaled.scale;
  out.useExtension("KHR_materials_emissive_strength");
}

void saveMaterial(GltfOutput& out, Json& json, const Material& now, const Material& was) {
  if (now.name != was.name) json["name"] = now.name;
  const auto pbr = [&]() -> Json& { return json["pbrMetallicRoughness"]; };
  if (now.baseColor != was.baseColor) pbr()["baseColorFactor"] = toJson(now.baseColor);
  if (now.metallic != was.metallic) pbr()["metallicFactor"] = toJson(now.metallic);
  if (now.roughness != was.roughness) pbr()["roughnessFactor"] = toJson(now.roughness);
  if (now.baseColorTexture != was.baseColorTexture) {
    saveTextureRef(out, pbr(), "baseColorTexture", now.baseColorTexture);
  }
  if (now.metallicRoughnessTexture != was.metallicRoughnessTexture) {
    saveTextureRef(out, pbr(), "metallicRoughnessTexture", now.metallicRoughnessTexture);
  }
  if (now.normalTexture != was.normalTexture) {
    saveTextureRef(out, json, "normalTexture", now.normalTexture);
  }
  if (now.normalScale != was.normalScale && json.contains("normalTexture")) {
    json["normalTexture"]["scale"] = toJson(now.normalScale);
  }
  if (now.emissiveTexture != was.emissiveTexture) {
    saveTextureRef(out, json, "emissiveTexture", now.emissiveTexture);
  }
  if (now.emissive != was.emissive) saveEmission(out, json, now.emissive);
  if (now.transmission != was.transmission) {
    extensionObject(json, "KHR_materials_transmission")["transmissionFactor"] =
        toJson(now.transmission);
    out.useExtension("KHR_materials_transmission");
  }
  if (now.alphaMode != was.alphaMode) {
    json["alphaMode"] = now.alphaMode == AlphaMode::opaque ? "OPAQUE"
                        : now.alphaMode == AlphaMode::mask ? "MASK"
                                                           : "BLEND";
  }
  if (now.alphaCutoff != was.alphaCutoff) json["alphaCutoff"] = toJson(now.alphaCutoff);
  if (now.doubleSided != was.doubleSided) json["doubleSided"] = now.doubleSided;
}

}  // namespace

void saveTextures(GltfOutput& out) {
  const std::vector<Texture>& was = out.source.textures;
  for (size_t i = 0; i < out.scene.textures.size(); ++i) {
    const Texture& now = out.scene.textures[i];
    if (i >= was.size()) {
      out.append("textures", newTexture(out, now));
    } else if (!(now == was[i])) {
      out.json["textures"][i] = newTexture(out, now);
    }
  }
}

void saveMaterials(GltfOutput& out) {
  const size_t count = listOf(out.source.document, "materials").size();
  for (size_t i = 0; i < out.scene.materials.size(); ++i) {
    Material was;
    if (i < count) {
      was = readMaterial(out.source.document, i);
    } else {
      out.append("materials", Json::object());
    }
    saveMaterial(out, out.json["materials"][i], out.scene.materials[i], was);
  }
}

}  // namespace lamplighter
