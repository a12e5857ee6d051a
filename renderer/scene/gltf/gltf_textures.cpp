#include <algorithm>
#include <set>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

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
  std::string why;  // reason if there are no bytes
};

// The encoded bytes of an image, from its own file or from a buffer view.
Encoded encodedImage(const GltfDocument& document, size_t index) {
  const At at{"images", index};
  const Json& json = listOf(document, "images")[index];
  Encoded out;
  if (const auto view = sizeMember(document, json, "bufferView", at)) {
    const Json& bufferView = listOf(document, "bufferViews")[*view];
    const At viewAt{"bufferViews", *view};
    out.owner = document.buffers[*sizeMember(document, bufferView, "buffer", viewAt)];
    out.bytes = std::span(*out.owner)
                    .subspan(sizeMember(document, bufferView, "byteOffset", viewAt).value_or(0),
                             *sizeMember(document, bufferView, "byteLength", viewAt));
    return out;
  }
  const std::string uri = textMember(document, json, "uri", at);
  std::string why;
  out.owner = readUri(document, uri, why);
  if (out.owner == nullptr) {
    out.why = "names \"" + printable(uri) + "\", which " + why;
  } else {
    out.bytes = *out.owner;
  }
  return out;
}

// The image of a texture: the core image, which every loader can read, is preferred to those of
// extensions.
std::optional<size_t> sourceOf(const GltfDocument& document, const Json& texture, At at) {
  if (const auto source = sizeMember(document, texture, "source", at)) return source;
  for (const char* name :
       {"EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"}) {
    if (const Json* extension = extensionOf(texture, name)) {
      if (const auto source = sizeMember(document, *extension, "source", at)) return source;
    }
  }
  return std::nullopt;
}

Wrap wrapMode(const GltfDocument& document, const Json& sampler, const char* key, At at) {
  switch (sizeMember(document, sampler, key, at).value_or(10497)) {
    case 33071:
      return Wrap::clamp;
    case 33648:
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

// Unused images that are alternatives to a used one; they need not be readable.
std::set<size_t> alternatives(const GltfDocument& document) {
  std::set<size_t> out;
  for (const Json& texture : listOf(document, "textures")) {
    if (member(texture, "source") == nullptr) continue;
    for (const char* name :
         {"EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"}) {
      const Json* extension = extensionOf(texture, name);
      const Json* source = extension == nullptr ? nullptr : member(*extension, "source");
      if (source != nullptr) out.insert(source->get<size_t>());
    }
  }
  return out;
}

}  // namespace

std::vector<Texture> readTextures(GltfDocument& document, const std::vector<Material>& materials,
                                  const LoadProgress& progress) {
  const Json& images = listOf(document, "images");
  const Json& list = listOf(document, "textures");
  const Json& samplers = listOf(document, "samplers");

  std::vector<Texture> textures(list.size());
  std::vector<std::optional<size_t>> source(list.size());
  std::vector<bool> needed(images.size(), false);
  const std::set<size_t> used = texturesInUse(materials);
  for (size_t i = 0; i < list.size(); ++i) {
    const At at{"textures", i};
    textures[i].name = textMember(document, list[i], "name", at);
    source[i] = sourceOf(document, list[i], at);
    if (source[i] && used.contains(i)) needed[*source[i]] = true;
    if (const auto index = sizeMember(document, list[i], "sampler", at)) {
      const At samplerAt{"samplers", *index};
      textures[i].wrapS = wrapMode(document, samplers[*index], "wrapS", samplerAt);
      textures[i].wrapT = wrapMode(document, samplers[*index], "wrapT", samplerAt);
      constexpr size_t kNearest = 9728;
      textures[i].nearest =
          sizeMember(document, samplers[*index], "magFilter", samplerAt) == kNearest;
    }
  }

  // Files are read one after the other, including unused ones, because saving to another folder
  // copies them. Then one batch at a time is decoded, with as many images as there are cores.
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

  // For unused images only the header is checked.
  const std::set<size_t> unneeded = alternatives(document);
  for (size_t i = 0; i < images.size(); ++i) {
    if (!needed[i] && encoded[i].why.empty() && !unneeded.contains(i)) {
      checkImageHeader(encoded[i].bytes, encoded[i].why);
    }
    if (encoded[i].why.empty() || (!needed[i] && unneeded.contains(i))) continue;
    document.warn("images[" + std::to_string(i) + "] " + encoded[i].why +
                  (needed[i] ? "; a placeholder is shown" : "; nothing shows it"));
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
