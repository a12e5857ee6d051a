// A glTF file as read: its JSON, the data that tinygltf decoded, its bytes, and messages about it.
// Shared by the gltf_*.cpp files only; other code sees gltf_io.h.
//
// The JSON is parsed and checked here (checkStructure), because tinygltf 2.7 accepts cycles,
// indices out of range and counts of four billion; checked parts are decoded by tinygltf
// (decodeModel). Extensions and extras are read from the JSON, and saving patches it, so that
// unknown members do not change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "renderer/base/math.h"
#include "renderer/scene/gltf/scene_files.h"

namespace tinygltf {
class Model;
}

namespace lamplighter {

// The loader places nothing farther than this from the origin [m].
inline constexpr double kFarthestPlace = 1e9;

// nlohmann::ordered_map copies its values when it grows, which is half the time of parsing a large
// file; this one moves them.
template <class Key, class T, class Less = std::less<Key>,
          class Allocator = std::allocator<std::pair<const Key, T>>>
struct OrderedMap : nlohmann::ordered_map<Key, T, Less, Allocator> {
  using Base = nlohmann::ordered_map<Key, T, Less, Allocator>;
  using Base::Base;
  template <class K>
  T& operator[](K&& key) {
    if (this->size() == this->capacity()) {
      OrderedMap larger;
      larger.reserve(std::max<size_t>(4, 2 * this->size()));
      for (auto& [name, value] : *this) larger.emplace_back(name, std::move(value));
      this->swap(larger);
    }
    return Base::operator[](std::forward<K>(key));
  }
};

// Preserves the order of the members when the file is written again.
using Json = nlohmann::basic_json<OrderedMap>;
using NewBytes = std::shared_ptr<std::vector<uint8_t>>;
using Bytes = std::shared_ptr<const std::vector<uint8_t>>;

// A position in the file: "accessors[3]".
struct At {
  const char* list;
  size_t index;
  std::string text() const { return std::string(list) + "[" + std::to_string(index) + "]"; }
};

// The remedy for a file that violates the glTF specification.
inline constexpr const char* kExportAgain =
    "export it again, or mend it (a glTF validator says more)";

struct GltfDocument {
  std::filesystem::path path;
  Json json;
  // Without buffers, images, skins, animations, extensions (except lights) and extras. Null until
  // decodeModel(), and for a scene that was not loaded.
  std::shared_ptr<const tinygltf::Model> model;
  NewBytes binaryChunk;           // of a .glb, else null; moves to buffers
  std::vector<Bytes> buffers;     // one for each of json["buffers"], of byteLength (at least 1)
  std::vector<Bytes> imageFiles;  // encoded bytes of images with a file of their own, else null
  size_t bytesRead = 0;           // of the file and its buffers
  // Every file that was read, with its stamp just before reading.
  std::shared_ptr<std::vector<FileStamp>> files = std::make_shared<std::vector<FileStamp>>();
  std::vector<std::string> warnings;

  [[noreturn]] void fail(const std::string& wrong, const std::string& remedy = kExportAgain) const;
  [[noreturn]] void fail(const At& at, const std::string& wrong,
                         const std::string& remedy = kExportAgain) const {
    fail(at.text() + " " + wrong, remedy);
  }
  void warn(const std::string& text);
  bool usesExtension(const char* name) const;
};

// Replaces control characters by '?' and shortens long texts, for messages of one line.
std::string printable(std::string_view text);

// The lights of extensions as top-level lists.
inline constexpr const char* kPunctualLights = "KHR_lights_punctual.lights";
inline constexpr const char* kAreaLights = "EXT_lights_area.lights";

// A top-level array; an empty one where the file has none. checkStructure() ensures that its
// entries are objects.
const Json& listOf(const GltfDocument& document, const char* name);
// The default scene, or null where the file has none.
const Json* shownScene(const GltfDocument& document);

// A member of an object, or null if there is none (or `object` is not an object).
const Json* member(const Json& object, const char* key);
// object.extensions.NAME, or null.
const Json* extensionOf(const Json& object, const char* name);

// The member of "extras" that contains the notes of this program in a file.
inline constexpr const char* kExtrasName = "lamplighter";
// Marks meshes that show sphere lights in other programs, see gltf_sphere_meshes.cpp.
inline constexpr const char* kSphereMark = "sphereLight";
// A note on a node: how its mesh is lit, "simple" or "complex" (MeshKind).
inline constexpr const char* kMeshKindNote = "mesh";
inline constexpr const char* kLockedNote = "locked";
// A note on a scene: its sky.
inline constexpr const char* kSkyNote = "sky";
// object.extras.lamplighter.KEY, or null.
const Json* noteOf(const Json& object, const char* key);
// Whether this member is true.
bool isMarked(const Json& object, const char* key);

// Members of extensions and notes, after checkMembers() has checked their types.
double numberIn(const Json& object, const char* key, double otherwise);
bool flagIn(const Json& object, const char* key, bool otherwise);
std::string textIn(const Json& object, const char* key);
size_t sizeIn(const Json& object, const char* key, size_t otherwise = 0);
// Empty where there is no such member.
std::vector<double> numbersIn(const Json& object, const char* key);

// gltf_document.cpp: reads the file and parses the JSON; buffers and images are not read yet.
GltfDocument readGltfJson(const std::filesystem::path& path);

// gltf_uri.cpp: the bytes behind a URI: data, or a file in the folder of the document. Returns null
// and sets `why` if they are not available.
NewBytes readUri(const GltfDocument& document, const std::string& uri, std::string& why);
// Decodes escapes such as %20; other text does not change.
std::string percentDecoded(std::string_view text);
// Reads a whole regular file. Returns null and sets `why` if it cannot be read.
NewBytes readWholeFile(const std::filesystem::path& path, std::string& why);

// gltf_members.cpp: throws InputError if a member that is read has a wrong type, is not finite, or
// is an index out of range.
void checkMembers(const GltfDocument& document);
// A count or index, or none if the value is not one.
std::optional<size_t> sizeOf(const Json& value);

// gltf_validate.cpp. Both throw InputError.
void checkVersionAndExtensions(GltfDocument& document);
// Members as checkMembers() says, every accessor in its view and every view in its buffer, nodes a
// forest.
void checkStructure(const GltfDocument& document);

// gltf_decode.cpp: fills GltfDocument::model and buffers. Call it after checkStructure().
void decodeModel(GltfDocument& document);

}  // namespace lamplighter
