// Everything that would let a reader go astray, checked before anything is read.
#include <algorithm>
#include <array>
#include <climits>
#include <set>
#include <string_view>

#include "renderer/scene/gltf/gltf_accessors.h"
#include "renderer/scene/gltf/gltf_document.h"

namespace lamplighter {

namespace {

// What is read. EXT_lights_area and the image formats of textures are read as far as docs/gltf.md
// says.
constexpr auto kSupported = std::to_array<std::string_view>({
    "EXT_lights_area",
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_transmission",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
});

// What changes the look of a surface, adds light or holds notes: the geometry is whole without it.
constexpr auto kWithoutEffect = std::to_array<std::string_view>({
    "EXT_lights_ies",
    "EXT_lights_image_based",
    "EXT_texture_avif",
    "KHR_animation_pointer",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_subsurface",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_materials_volume_scatter",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_texture_basisu",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MSFT_texture_dds",
});

// Some exporters write these for every material, mostly with the default values.
bool isMostlyDefault(std::string_view name) {
  return name == "KHR_materials_ior" || name == "KHR_materials_specular";
}

template <typename List>
bool holds(const List& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

// extensionsUsed or extensionsRequired.
std::vector<std::string> extensionNames(const GltfDocument& document, const char* key) {
  std::vector<std::string> names;
  for (const Json& entry : listOf(document, key)) {
    if (!entry.is_string()) {
      document.fail("\"" + std::string(key) + "\" is not a list of names");
    }
    names.push_back(entry.get<std::string>());
  }
  return names;
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
  const std::vector<std::string> required = extensionNames(document, "extensionsRequired");
  for (const std::string& name : required) {
    if (holds(kSupported, name)) continue;
    if (!holds(kWithoutEffect, name)) {
      document.fail("needs the extension " + printable(name) + ", which is not supported",
                    remedyFor(name));
    }
    document.warn("needs the extension " + name + ", which is not supported; shown without it");
  }
  std::string without;
  for (const std::string& name : extensionNames(document, "extensionsUsed")) {
    if (!name.starts_with("KHR_materials_") || !holds(kWithoutEffect, name) ||
        isMostlyDefault(name) || holds(required, name)) {
      continue;
    }
    without += (without.empty() ? "" : ", ") + name;
  }
  if (!without.empty()) document.warn("is shown without " + without + ": not supported");
}

namespace {

std::vector<size_t> indicesIn(const Json& object, const char* key) {
  const Json* list = member(object, key);
  return list == nullptr ? std::vector<size_t>() : list->get<std::vector<size_t>>();
}

class StructureCheck {
 public:
  explicit StructureCheck(const GltfDocument& document)
      : doc_(document),
        buffers_(listOf(doc_, "buffers")),
        views_(listOf(doc_, "bufferViews")),
        accessors_(listOf(doc_, "accessors")),
        meshes_(listOf(doc_, "meshes")),
        nodes_(listOf(doc_, "nodes")),
        scenes_(listOf(doc_, "scenes")) {}

  void run() {
    for (const char* name : {"buffers", "bufferViews", "accessors", "meshes", "materials",
                             "textures", "images", "samplers", "cameras", "skins", "nodes",
                             "scenes", "animations", kPunctualLights, kAreaLights}) {
      const Json& list = listOf(doc_, name);
      if (!std::all_of(list.begin(), list.end(), [](const Json& e) { return e.is_object(); })) {
        doc_.fail(std::string("\"") + name + "\" is not an array of objects");
      }
      for (size_t i = 0; i < list.size(); ++i) objectMember(list[i], "extensions", {name, i});
    }
    objectMember(doc_.json, "extensions", {"glTF", 0});
    checkMembers(doc_);
    for (size_t i = 0; i < views_.size(); ++i) view(i);
    for (size_t i = 0; i < accessors_.size(); ++i) accessor(i);
    for (size_t i = 0; i < meshes_.size(); ++i) mesh(i);
    animations();
    nodes();
    scenes();
  }

 private:
  void objectMember(const Json& object, const char* key, At at) {
    const Json* value = member(object, key);
    if (value != nullptr && !value->is_object()) {
      doc_.fail(at, std::string("has \"") + key + "\" that are not an object");
    }
  }

  void view(size_t i) {
    const At at{"bufferViews", i};
    const size_t buffer = sizeIn(views_[i], "buffer"), length = sizeIn(views_[i], "byteLength"),
                 offset = sizeIn(views_[i], "byteOffset"),
                 whole = sizeIn(buffers_[buffer], "byteLength");
    if (offset > whole || length > whole - offset) {
      doc_.fail(at, "ends past the " + std::to_string(whole) + " bytes of buffers[" +
                        std::to_string(buffer) + "]");
    }
    const size_t stride = sizeIn(views_[i], "byteStride", 4);
    if (stride < 4 || stride > 252 || stride % 4 != 0) {
      doc_.fail(at, "has the byteStride " + std::to_string(stride) +
                        ", not a multiple of 4 from 4 to 252");
    }
  }

  // `count` elements of `size` bytes, `stride` apart, from the byteOffset of `object` in its view.
  void inView(const Json& object, At at, size_t count, size_t size, bool strided) {
    const size_t index = sizeIn(object, "bufferView");
    const size_t offset = sizeIn(object, "byteOffset");
    const size_t length = sizeIn(views_[index], "byteLength");
    const size_t stride = strided ? sizeIn(views_[index], "byteStride", size) : size;
    if (stride < size) {
      doc_.fail(at, "has elements that overlap: byteStride is less than their size");
    }
    // Without overflow: (count − 1) · stride + size ≤ length − offset.
    if (count > 0 && (offset > length || length - offset < size ||
                      (length - offset - size) / stride < count - 1)) {
      doc_.fail(at, "has " + std::to_string(count) + " elements, more than fit in bufferViews[" +
                        std::to_string(index) + "]");
    }
  }

  void accessor(size_t i) {
    const At at{"accessors", i};
    const Json& json = accessors_[i];
    const size_t count = sizeIn(json, "count");
    const ElementLayout layout =
        elementLayout(json["type"].get_ref<const std::string&>(), sizeIn(json, "componentType"));
    if (layout.components == 0) {
      doc_.fail(at, "has an unknown type or componentType");
    }
    if (member(json, "bufferView") != nullptr) {
      inView(json, at, count, layout.bytes, true);
    } else if (count > std::max<size_t>(65536, doc_.bytesRead)) {
      doc_.fail(at, "has " + std::to_string(count) + " elements but no bytes for them");
    }
    const Json* sparse = member(json, "sparse");
    if (sparse == nullptr) return;
    const Json &where = (*sparse)["indices"], &values = (*sparse)["values"];
    const size_t replaced = sizeIn(*sparse, "count");
    if (replaced > count) doc_.fail(at, "has more sparse data than elements");
    const size_t indexType = sizeIn(where, "componentType");
    if (!isUnsigned(indexType)) {
      doc_.fail(at, "has sparse indices that are not unsigned integers");
    }
    // tinygltf holds these in an int.
    if (std::max({replaced, sizeIn(where, "byteOffset"), sizeIn(values, "byteOffset")}) > INT_MAX) {
      doc_.fail(at, "has sparse data beyond 2 GiB");
    }
    inView(where, at, replaced, elementLayout("SCALAR", indexType).bytes, false);
    inView(values, at, replaced, layout.bytes, false);
  }

  static bool isUnsigned(size_t componentType) {
    return componentType == 5121 || componentType == 5123 || componentType == 5125;
  }

  size_t attributes(const Json& object, At at, std::optional<size_t> count) {
    for (const auto& [name, value] : object.items()) {
      const size_t n = sizeIn(accessors_[value.get<size_t>()], "count");
      if (count && n != *count) {
        doc_.fail(at, "has " + std::to_string(n) + " of attribute " + printable(name) + " but " +
                          std::to_string(*count) + " of another");
      }
      count = n;
    }
    return count.value_or(0);
  }

  void mesh(size_t i) {
    const At at{"meshes", i};
    const Json* primitives = member(meshes_[i], "primitives");
    if (primitives == nullptr) return;
    for (const Json& primitive : *primitives) {
      const Json* attribs = member(primitive, "attributes");
      if (attribs == nullptr) doc_.fail(at, "has a primitive without attributes");
      // Draco data may be there although the file does not require it, with nothing to fall back
      // to.
      if (const Json* position = member(*attribs, "POSITION");
          position != nullptr && extensionOf(primitive, "KHR_draco_mesh_compression") != nullptr &&
          member(accessors_[position->get<size_t>()], "bufferView") == nullptr) {
        doc_.fail(at, "is compressed by KHR_draco_mesh_compression, which is not supported",
                  "export it without compression");
      }
      const size_t count = attributes(*attribs, at, std::nullopt);
      if (const Json* targets = member(primitive, "targets")) {
        for (const Json& target : *targets) attributes(target, at, count);
      }
      if (member(primitive, "indices") != nullptr) indices(sizeIn(primitive, "indices"));
      if (sizeIn(primitive, "mode") > 6) {
        doc_.fail(at, "has a primitive of an unknown mode");
      }
    }
  }

  void indices(size_t accessor) {
    const Json& json = accessors_[accessor];
    if (!isUnsigned(sizeIn(json, "componentType")) || json["type"] != "SCALAR") {
      doc_.fail(At{"accessors", accessor}, "has indices that are not unsigned integers");
    }
    if (member(json, "bufferView") == nullptr) {
      doc_.fail(At{"accessors", accessor}, "has indices without a bufferView");
    }
  }

  void animations() {
    const Json& list = listOf(doc_, "animations");
    for (size_t i = 0; i < list.size(); ++i) {
      const Json *samplers = member(list[i], "samplers"), *channels = member(list[i], "channels");
      if (channels == nullptr) continue;
      const size_t count = samplers == nullptr ? 0 : samplers->size();
      for (const Json& channel : *channels) {
        if (const size_t sampler = sizeIn(channel, "sampler"); sampler >= count) {
          doc_.fail(At{"animations", i}, "has a channel of samplers[" + std::to_string(sampler) +
                                             "], but there are " + std::to_string(count));
        }
      }
    }
  }

  void nodes() {
    constexpr size_t kNoParent = SIZE_MAX;
    std::vector<size_t> parent(nodes_.size(), kNoParent);
    std::vector<std::vector<size_t>> children(nodes_.size());
    for (size_t i = 0; i < nodes_.size(); ++i) {
      const At at{"nodes", i};
      children[i] = indicesIn(nodes_[i], "children");
      for (const size_t child : children[i]) {
        if (child == i) doc_.fail(at, "is its own child");
        if (parent[child] != kNoParent) {
          doc_.fail(At{"nodes", child}, "is a child of nodes[" + std::to_string(parent[child]) +
                                            "] and of nodes[" + std::to_string(i) +
                                            "]; a node has one parent");
        }
        parent[child] = i;
      }
    }
    // With one parent each, what no root leads to is in a cycle or below one.
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
      doc_.fail(At{"nodes", static_cast<size_t>(lost - reached.begin())},
                "is in a cycle: it is its own descendant, or a descendant of such a node");
    }
    isChild_.resize(nodes_.size());
    for (size_t i = 0; i < nodes_.size(); ++i) isChild_[i] = parent[i] != kNoParent;
  }

  void scenes() {
    // A scene index without any scenes is taken care of by the loader.
    const size_t shown = sizeIn(doc_.json, "scene");
    if (!scenes_.empty() && shown >= scenes_.size()) {
      doc_.fail("names the scene " + std::to_string(shown) + ", but there are " +
                std::to_string(scenes_.size()));
    }
    for (size_t i = 0; i < scenes_.size(); ++i) {
      const At at{"scenes", i};
      std::set<size_t> seen;
      for (const size_t root : indicesIn(scenes_[i], "nodes")) {
        if (isChild_[root] || !seen.insert(root).second) {
          doc_.fail(at, "lists nodes[" + std::to_string(root) +
                            "], which is a child of another or listed twice");
        }
      }
    }
  }

  const GltfDocument& doc_;
  const Json &buffers_, &views_, &accessors_, &meshes_, &nodes_, &scenes_;
  std::vector<bool> isChild_;
};

}  // namespace

void checkStructure(const GltfDocument& document) { StructureCheck(document).run(); }

}  // namespace lamplighter
