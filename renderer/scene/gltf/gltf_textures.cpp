#include <algorithm>
#include <set>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tiny_gltf.h>

#include "renderer/base/error.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf/gltf_content.h"

namespace lamplighter {

std::shared_ptr<const Image8> placeholderImage() {
  constexpr int kSize = 64, kSquare = 8;
  auto image = std::make_shared<Image8>(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const bool isMagenta = (x / kSquare + y / kSquare) % 2 == 0;
      uint8_t* p = image->at(x, y);
      p[0] = p[2] = isMagenta ? 255 : 0;
      p[1] = 0;
    }
  }
  return image;
}

namespace {

struct Encoded {
  Bytes owner;  // keeps `bytes` alive
  std::span<const uint8_t> bytes;
  std::string why;  // why there are none
};

// The encoded bytes of an image, from its own file or from a buffer view.
Encoded encodedImage(const GltfDocument& document, size_t index) {
  const Json& json = listOf(document, "images")[index];
  Encoded out;
  if (member(json, "bufferView") != nullptr) {
    const tinygltf::BufferView& view = document.model->bufferViews[sizeIn(json, "bufferView")];
    out.owner = document.buffers[static_cast<size_t>(view.buffer)];
    out.bytes = std::span(*out.owner).subspan(view.byteOffset, view.byteLength);
    return out;
  }
  const std::string uri = textIn(json, "uri");
  std::string why;
  out.owner = readUri(document, uri, why);
  if (out.owner == nullptr) {
    out.why = "names \"" + printable(uri) + "\", which " + why;
  } else {
    out.bytes = *out.owner;
  }
  return out;
}

constexpr const char* kSources[] = {"EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif",
                                    "MSFT_texture_dds"};

// The images that extensions name.
std::vector<size_t> extensionSources(const Json& texture) {
  std::vector<size_t> out;
  for (const char* name : kSources) {
    const Json* extension = extensionOf(texture, name);
    if (extension != nullptr && extension->contains("source"))
      out.push_back(sizeIn(*extension, "source"));
  }
  return out;
}

// The image of a texture: the core one, which every loader can read, before those of extensions.
std::optional<size_t> sourceOf(const tinygltf::Texture& texture, const Json& json) {
  if (texture.source >= 0) return static_cast<size_t>(texture.source);
  const std::vector<size_t> others = extensionSources(json);
  return others.empty() ? std::nullopt : std::optional(others.front());
}

Wrap wrapMode(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirror;
    default:
      return Wrap::repeat;
  }
}

std::set<size_t> texturesInUse(const std::vector<Material>& materials) {
  std::set<size_t> used;
  for (const Material& m : materials) {
    for (const TextureRef* ref :
         {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.emissiveTexture}) {
      if (ref->texture != kNone) used.insert(static_cast<size_t>(ref->texture));
    }
  }
  return used;
}

// Images that no texture shows, but that are alternatives to one that does, need not be readable.
std::set<size_t> alternatives(const GltfDocument& document) {
  std::set<size_t> out;
  for (const Json& texture : listOf(document, "textures")) {
    if (member(texture, "source") == nullptr) continue;
    for (const size_t source : extensionSources(texture)) out.insert(source);
  }
  return out;
}

}  // namespace

std::vector<Texture> readTextures(GltfDocument& document, const std::vector<Material>& materials,
                                  const LoadProgress& progress) {
  const Json& images = listOf(document, "images");
  const Json& list = listOf(document, "textures");
  const tinygltf::Model& model = *document.model;

  std::vector<Texture> textures(list.size());
  std::vector<std::optional<size_t>> source(list.size());
  std::vector<bool> needed(images.size(), false);
  const std::set<size_t> used = texturesInUse(materials);
  for (size_t i = 0; i < list.size(); ++i) {
    const tinygltf::Texture& texture = model.textures[i];
    textures[i].name = texture.name;
    source[i] = sourceOf(texture, list[i]);
    if (source[i] && used.contains(i)) needed[*source[i]] = true;
    if (texture.sampler >= 0) {
      const tinygltf::Sampler& sampler = model.samplers[static_cast<size_t>(texture.sampler)];
      textures[i].wrapS = wrapMode(sampler.wrapS);
      textures[i].wrapT = wrapMode(sampler.wrapT);
      textures[i].nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
  }

  // Files are read one after the other, also those that are not shown: saving to another folder
  // takes them along. Then a batch at a time is decoded, as many as there are cores.
  std::vector<Encoded> encoded;
  document.imageFiles.resize(images.size());
  for (size_t i = 0; i < images.size(); ++i) {
    encoded.push_back(encodedImage(document, i));
    const Json* uri = member(images[i], "uri");
    if (uri != nullptr && !uri->get_ref<const std::string&>().starts_with("data:")) {
      document.imageFiles[i] = encoded[i].owner;
    }
  }
  std::vector<std::shared_ptr<const Image8>> decoded(images.size());
  std::vector<size_t> work;
  for (size_t i = 0; i < images.size(); ++i) {
    if (needed[i] && encoded[i].why.empty()) work.push_back(i);
  }
  const size_t batch = static_cast<size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
  for (size_t first = 0; first < work.size(); first += batch) {
    const float done = static_cast<float>(first) / static_cast<float>(work.size());
    if (progress && !progress(0.4f + 0.6f * done, "textures")) throw InputError("cancelled");
    tbb::parallel_for(first, std::min(first + batch, work.size()), [&](size_t w) {
      const size_t i = work[w];
      if (auto image = decodeImage8(encoded[i].bytes, encoded[i].why)) {
        decoded[i] = std::make_shared<const Image8>(std::move(*image));
      }
    });
  }

  // Of unused images only the header is checked.
  const std::set<size_t> unneeded = alternatives(document);
  for (size_t i = 0; i < images.size(); ++i) {
    if (!needed[i] && encoded[i].why.empty() && !unneeded.contains(i)) {
      checkImageHeader(encoded[i].bytes, encoded[i].why);
    }
    if (encoded[i].why.empty() || (!needed[i] && unneeded.contains(i))) continue;
    document.warn("images[" + std::to_string(i) + "] " + encoded[i].why +
                  (needed[i] ? "; a placeholder is shown" : "; no visible material uses it"));
  }

  const auto white = std::make_shared<const Image8>(1, 1);
  const auto placeholder = placeholderImage();
  for (size_t i = 0; i < list.size(); ++i) {
    textures[i].image = white;
    if (!used.contains(i)) continue;
    const bool isThere = source[i] && decoded[*source[i]] != nullptr;
    textures[i].image = isThere ? decoded[*source[i]] : placeholder;
    textures[i].placeholder = !isThere;
    if (!source[i]) {
      document.warn("textures[" + std::to_string(i) + "] has no image; a placeholder is shown");
    }
  }
  return textures;
}

}  // namespace lamplighter
