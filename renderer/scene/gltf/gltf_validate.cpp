// Validates the structure of a file before any data is read, so that readers need no checks.
#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "renderer/scene/gltf/gltf_accessors.h"
#include "renderer/scene/gltf/gltf_document.h"

namespace lamplighter {

namespace {

// Supported extensions without which a file is not displayed correctly.
constexpr std::array<std::string_view, 8> kKnown = {
    "KHR_lights_punctual",   "KHR_materials_emissive_strength",
    "KHR_texture_transform", "KHR_materials_transmission",
    "KHR_mesh_quantization", "KHR_node_visibility",
    "EXT_lights_area",       "KHR_materials_ior"};

// Extensions that change the appearance of a surface or contain notes: the scene is valid without
// them.
bool isOptionalInEffect(std::string_view name) {
  return name.starts_with("KHR_materials_") || name.starts_with("KHR_texture_") ||
         name.starts_with("EXT_texture_") || name.starts_with("MSFT_texture_") ||
         name.starts_with("KHR_xmp") || name.starts_with("EXT_lights_") ||
         name == "KHR_animation_pointer" || name == "KHR_node_hoverability" ||
         name == "KHR_node_selectability";
}

std::string remedyFor(std::string_view name) {
  if (name == "KHR_draco_mesh_compression" || name.ends_with("meshopt_compression")) {
    return "export it without compression, or unpack it (gltf-transform copy does)";
  }
  return "export it without that extension";
}

}  // namespace

void checkVersionAndExtensions(GltfDocument& document) {
  const Json* asset = member(document.json, "asset");
  const Json* version = asset == nullptr ? nullptr : member(*asset, "version");
  if (version == nullptr || !version->is_string()) {
    document.fail("states no asset.version", "export it as glTF 2.0");
  }
  const Json* least = member(*asset, "minVersion");
  const bool known = version->get<std::string>().starts_with("2.");
  if (!known || (least != nullptr && *least != "2.0")) {
    document.fail("is glTF of version \"" +
                      printable(known ? least->dump() : version->get<std::string>()) +
                      "\", not 2.0",
                  "export it as glTF 2.0");
  }
  const Json* required = member(document.json, "extensionsRequired");
  if (required == nullptr) return;
  if (!required->is_array()) document.fail("\"extensionsRequired\" is no array", kExportAgain);
  for (const Json& entry : *required) {
    if (!entry.is_string()) document.fail("\"extensionsRequired\" holds no names", kExportAgain);
    const std::string name = entry.get<std::string>();
    if (std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end()) continue;
    if (!isOptionalInEffect(name)) {
      document.fail("needs the extension " + printable(name) + ", which is not supported",
                    remedyFor(name));
    }
    document.warn("needs the extension " + printable(name) +
                  ", which is not supported; shown without it");
  }
}

namespace {

class StructureCheck {
 public:
  explicit StructureCheck(const GltfDocument& document)
      : doc_(document),
        buffers_(listOf(doc_, "buffers")),
        views_(listOf(doc_, "bufferViews")),
        accessors_(listOf(doc_, "accessors")),
        meshes_(listOf(doc_, "meshes")),
        materials_(listOf(doc_, "materials")),
        textures_(listOf(doc_, "textures")),
        images_(listOf(doc_, "images")),
        samplers_(listOf(doc_, "samplers")),
        cameras_(listOf(doc_, "cameras")),
        skins_(listOf(doc_, "skins")),
        nodes_(listOf(doc_, "nodes")),
        scenes_(listOf(doc_, "scenes")),
        animations_(listOf(doc_, "animations")) {}

  void run() {
    for (const char* name :
         {"buffers", "bufferViews", "accessors", "meshes", "materials", "textures", "images",
          "samplers", "cameras", "skins", "nodes", "scenes", "animations"}) {
      const Json& list = listOf(doc_, name);
      if (!std::all_of(list.begin(), list.end(), [](const Json& e) { return e.is_object(); })) {
        doc_.fail(std::string("\"") + name + "\" is no array of objects", kExportAgain);
      }
      for (size_t i = 0; i < list.size(); ++i) objectMember(list[i], "extensions", {name, i});
    }
    objectMember(doc_.json, "extensions", {"glTF", 0});
    if (const Json* used = arrayMember(doc_, doc_.json, "extensionsUsed", {"glTF", 0})) {
      if (!std::all_of(used->begin(), used->end(), [](const Json& e) { return e.is_string(); })) {
        doc_.fail("\"extensionsUsed\" holds no names", kExportAgain);
      }
    }
    for (size_t i = 0; i < buffers_.size(); ++i) need(buffers_[i], "byteLength", {"buffers", i});
    for (size_t i = 0; i < views_.size(); ++i) view(i);
    for (size_t i = 0; i < accessors_.size(); ++i) accessor(i);
    for (size_t i = 0; i < images_.size(); ++i) {
      indexMember(doc_, images_[i], "bufferView", {"images", i}, views_.size());
    }
    for (size_t i = 0; i < textures_.size(); ++i) texture(i);
    for (size_t i = 0; i < meshes_.size(); ++i) mesh(i);
    for (size_t i = 0; i < skins_.size(); ++i) skin(i);
    for (size_t i = 0; i < animations_.size(); ++i) animation(i);
    nodes();
    scenes();
  }

 private:
  size_t need(const Json& object, const char* key, At at) {
    const auto value = sizeMember(doc_, object, key, at);
    if (!value) doc_.fail(at, std::string("has no \"") + key + "\"", kExportAgain);
    return *value;
  }
  void objectMember(const Json& object, const char* key, At at) {
    const Json* value = member(object, key);
    if (value != nullptr && !value->is_object()) {
      doc_.fail(at, std::string("has \"") + key + "\" that are no object", kExportAgain);
    }
  }
  size_t needIndex(const Json& object, const char* key, At at, size_t count) {
    need(object, key, at);
    return *indexMember(doc_, object, key, at, count);
  }
  // Reads an array of indices, all less than `count`.
  std::vector<size_t> indices(const Json& object, const char* key, At at, size_t count) {
    std::vector<size_t> out;
    const Json* array = arrayMember(doc_, object, key, at);
    if (array == nullptr) return out;
    for (const Json& entry : *array) {
      if (!entry.is_number_unsigned() || entry.get<size_t>() >= count) {
        doc_.fail(at,
                  std::string("has ") + printable(entry.dump()) + " among its \"" + key +
                      "\", but there are " + std::to_string(count),
                  kExportAgain);
      }
      out.push_back(entry.get<size_t>());
    }
    return out;
  }

  void view(size_t i) {
    const At at{"bufferViews", i};
    const size_t buffer = needIndex(views_[i], "buffer", at, buffers_.size());
    const size_t length = need(views_[i], "byteLength", at);
    const size_t offset = sizeMember(doc_, views_[i], "byteOffset", at).value_or(0);
    const size_t whole = need(buffers_[buffer], "byteLength", {"buffers", buffer});
    if (offset > whole || length > whole - offset) {
      doc_.fail(at,
                "ends past the " + std::to_string(whole) + " bytes of buffers[" +
                    std::to_string(buffer) + "]",
                kExportAgain);
    }
    const auto stride = sizeMember(doc_, views_[i], "byteStride", at);
    if (stride && (*stride < 4 || *stride > 252)) {
      doc_.fail(at, "has the byteStride " + std::to_string(*stride) + ", not 4 to 252",
                kExportAgain);
    }
  }

  // Checks that `count` elements of `size` bytes with a stride fit into the view of `object`, from
  // its byteOffset on.
  void inView(const Json& object, At at, size_t count, size_t size, bool strided) {
    const size_t index = needIndex(object, "bufferView", at, views_.size());
    const size_t offset = sizeMember(doc_, object, "byteOffset", at).value_or(0);
    const size_t length = need(views_[index], "byteLength", {"bufferViews", index});
    const auto stated = sizeMember(doc_, views_[index], "byteStride", {"bufferViews", index});
    const size_t stride = strided && stated ? *stated : size;
    if (stride < size) {
      doc_.fail(at, "has elements that overlap: byteStride is less than their size", kExportAgain);
    }
    // Avoids overflow: (count − 1) · stride + size ≤ length − offset.
    if (count > 0 && (offset > length || length - offset < size ||
                      (length - offset - size) / stride < count - 1)) {
      doc_.fail(at,
                "has " + std::to_string(count) + " elements, more than fit in bufferViews[" +
                    std::to_string(index) + "]",
                kExportAgain);
    }
  }

  void accessor(size_t i) {
    const At at{"accessors", i};
    const Json& json = accessors_[i];
    const size_t type = need(json, "componentType", at);
    const size_t count = need(json, "count", at);
    const ElementLayout layout = elementLayout(textMember(doc_, json, "type", at), type);
    if (layout.components == 0) {
      doc_.fail(at, "has an unknown type or componentType", kExportAgain);
    }
    if (member(json, "bufferView") != nullptr) {
      inView(json, at, count, layout.bytes, true);
    } else if (count > std::max<size_t>(65536, doc_.bytesRead)) {
      doc_.fail(at, "has " + std::to_string(count) + " elements but no bytes for them",
                kExportAgain);
    }
    const Json* sparse = member(json, "sparse");
    if (sparse == nullptr) return;
    const size_t replaced = need(*sparse, "count", at);
    const Json *where = member(*sparse, "indices"), *values = member(*sparse, "values");
    if (where == nullptr || values == nullptr || replaced > count) {
      doc_.fail(at, "has sparse data without indices or values, or with too many", kExportAgain);
    }
    const size_t indexType = need(*where, "componentType", at);
    if (indexType != 5121 && indexType != 5123 && indexType != 5125) {
      doc_.fail(at, "has sparse indices that are no unsigned integers", kExportAgain);
    }
    inView(*where, at, replaced, componentSize(indexType), false);
    inView(*values, at, replaced, layout.bytes, false);
  }

  void texture(size_t i) {
    const At at{"textures", i};
    indexMember(doc_, textures_[i], "sampler", at, samplers_.size());
    indexMember(doc_, textures_[i], "source", at, images_.size());
    for (const char* name :
         {"EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"}) {
      if (const Json* extension = extensionOf(textures_[i], name)) {
        indexMember(doc_, *extension, "source", at, images_.size());
      }
    }
  }

  size_t attributes(const Json& object, At at, std::optional<size_t> count) {
    if (!object.is_object()) doc_.fail(at, "has attributes that are no object", kExportAgain);
    for (const auto& [name, value] : object.items()) {
      const size_t index = *indexMember(doc_, object, name.c_str(), at, accessors_.size());
      const size_t n = need(accessors_[index], "count", {"accessors", index});
      if (count && n != *count) {
        doc_.fail(at,
                  "has " + std::to_string(n) + " of attribute " + printable(name) + " but " +
                      std::to_string(*count) + " of another",
                  kExportAgain);
      }
      count = n;
    }
    return count.value_or(0);
  }

  void mesh(size_t i) {
    const At at{"meshes", i};
    const Json* primitives = arrayMember(doc_, meshes_[i], "primitives", at);
    if (primitives == nullptr) return;
    for (const Json& primitive : *primitives) {
      const Json* attribs = member(primitive, "attributes");
      if (attribs == nullptr) doc_.fail(at, "has a primitive without attributes", kExportAgain);
      const size_t count = attributes(*attribs, at, std::nullopt);
      if (const Json* targets = arrayMember(doc_, primitive, "targets", at)) {
        for (const Json& target : *targets) attributes(target, at, count);
      }
      if (const auto index = indexMember(doc_, primitive, "indices", at, accessors_.size())) {
        const Json& json = accessors_[*index];
        const size_t type = need(json, "componentType", {"accessors", *index});
        if ((type != 5121 && type != 5123 && type != 5125) || *member(json, "type") != "SCALAR") {
          doc_.fail({"accessors", *index}, "holds indices that are no unsigned integers",
                    kExportAgain);
        }
      }
      indexMember(doc_, primitive, "material", at, materials_.size());
      if (sizeMember(doc_, primitive, "mode", at).value_or(4) > 6) {
        doc_.fail(at, "has a primitive of an unknown mode", kExportAgain);
      }
    }
  }

  void skin(size_t i) {
    const At at{"skins", i};
    indices(skins_[i], "joints", at, nodes_.size());
    indexMember(doc_, skins_[i], "skeleton", at, nodes_.size());
    indexMember(doc_, skins_[i], "inverseBindMatrices", at, accessors_.size());
  }

  void animation(size_t i) {
    const At at{"animations", i};
    const Json* samplers = arrayMember(doc_, animations_[i], "samplers", at);
    if (samplers != nullptr) {
      for (const Json& sampler : *samplers) {
        indexMember(doc_, sampler, "input", at, accessors_.size());
        indexMember(doc_, sampler, "output", at, accessors_.size());
      }
    }
    const Json* channels = arrayMember(doc_, animations_[i], "channels", at);
    if (channels == nullptr) return;
    for (const Json& channel : *channels) {
      indexMember(doc_, channel, "sampler", at, samplers == nullptr ? 0 : samplers->size());
      if (const Json* target = member(channel, "target")) {
        indexMember(doc_, *target, "node", at, nodes_.size());
      }
    }
  }

  void nodes() {
    constexpr size_t kNoParent = SIZE_MAX;
    std::vector<size_t> parent(nodes_.size(), kNoParent);
    std::vector<std::vector<size_t>> children(nodes_.size());
    for (size_t i = 0; i < nodes_.size(); ++i) {
      const At at{"nodes", i};
      indexMember(doc_, nodes_[i], "mesh", at, meshes_.size());
      indexMember(doc_, nodes_[i], "camera", at, cameras_.size());
      indexMember(doc_, nodes_[i], "skin", at, skins_.size());
      children[i] = indices(nodes_[i], "children", at, nodes_.size());
      for (const size_t child : children[i]) {
        if (child == i) doc_.fail(at, "is its own child", kExportAgain);
        if (parent[child] != kNoParent) {
          doc_.fail({"nodes", child},
                    "is a child of nodes[" + std::to_string(parent[child]) + "] and of nodes[" +
                        std::to_string(i) + "]; a node has one parent",
                    kExportAgain);
        }
        parent[child] = i;
      }
    }
    // Each node has at most one parent, so nodes that no root reaches are in a cycle or below one.
    std::vector<bool> reached(nodes_.size(), false);
    std::vector<size_t> open;
    for (size_t i = 0; i < nodes_.size(); ++i) {
      if (parent[i] == kNoParent) open.push_back(i);
    }
    while (!open.empty()) {
      const size_t i = open.back();
      open.pop_back();
      reached[i] = true;
      open.insert(open.end(), children[i].begin(), children[i].end());
    }
    const auto lost = std::find(reached.begin(), reached.end(), false);
    if (lost != reached.end()) {
      doc_.fail({"nodes", static_cast<size_t>(lost - reached.begin())},
                "is in a cycle: it is its own descendant, or a descendant of such a node",
                kExportAgain);
    }
    isChild_.resize(nodes_.size());
    for (size_t i = 0; i < nodes_.size(); ++i) isChild_[i] = parent[i] != kNoParent;
  }

  void scenes() {
    for (size_t i = 0; i < scenes_.size(); ++i) {
      const At at{"scenes", i};
      std::set<size_t> seen;
      for (const size_t root : indices(scenes_[i], "nodes", at, nodes_.size())) {
        if (isChild_[root] || !seen.insert(root).second) {
          doc_.fail(at,
                    "lists nodes[" + std::to_string(root) +
                        "], which is a child of another or listed twice",
                    kExportAgain);
        }
      }
    }
    // The loader handles a scene index without any scenes.
    if (!scenes_.empty()) {
      const auto scene = sizeMember(doc_, doc_.json, "scene", {"scenes", 0});
      if (scene && *scene >= scenes_.size()) {
        doc_.fail("names the scene " + std::to_string(*scene) + ", but there are " +
                      std::to_string(scenes_.size()),
                  kExportAgain);
      }
    }
  }

  const GltfDocument& doc_;
  const Json &buffers_, &views_, &accessors_, &meshes_, &materials_, &textures_, &images_,
      &samplers_, &cameras_, &skins_, &nodes_, &scenes_, &animations_;
  std::vector<bool> isChild_;
};

}  // namespace

void checkStructure(const GltfDocument& document) { StructureCheck(document).run(); }

}  // namespace lamplighter
