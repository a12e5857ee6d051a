// A glTF file as read: its JSON, its bytes and warnings about it. Only the gltf_*.cpp files include
// this; other code uses gltf_io.h.
//
// The JSON is parsed here and not by tinygltf, for two reasons. tinygltf 2.7 accepts cycles,
// indices out of range and counts of four billion, so the JSON must be checked anyway. And saving
// patches the JSON that was read, so that unknown data stays unchanged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "renderer/base/math.h"
#include "renderer/scene/gltf/scene_files.h"

namespace lamplighter {

using Json = nlohmann::ordered_json;  // keeps the order of members when written
using Bytes = std::shared_ptr<const std::vector<uint8_t>>;

// A location in the file, for messages: "accessors[3]".
struct At {
  const char* list;
  size_t index;
  std::string text() const { return std::string(list) + "[" + std::to_string(index) + "]"; }
};

struct GltfDocument {
  std::filesystem::path path;
  Json json;
  Bytes binaryChunk;              // of a .glb; otherwise null
  std::vector<Bytes> buffers;     // one per entry of json["buffers"], at least byteLength long
  std::vector<Bytes> imageFiles;  // encoded bytes of images in files of their own; otherwise null
  size_t bytesRead = 0;           // size of the file and its buffers
  // Every file that was read, with its stamp just before reading.
  std::shared_ptr<std::vector<FileStamp>> files = std::make_shared<std::vector<FileStamp>>();
  std::vector<std::string> warnings;

  [[noreturn]] void fail(const std::string& wrong, const std::string& remedy) const;
  [[noreturn]] void fail(const At& at, const std::string& wrong, const std::string& remedy) const {
    fail(at.text() + " " + wrong, remedy);
  }
  void warn(const std::string& text);
  bool usesExtension(const char* name) const;
};

// Largest distance of any geometry from the origin [m].
inline constexpr double kFarthestPlace = 1e9;

// Remedy in messages about files that violate the glTF specification.
inline constexpr const char* kExportAgain =
    "export it again, or mend it (a glTF validator says more)";

// Removes control characters and shortens long text, for use in a one-line message.
std::string printable(std::string_view text);

// A top-level array, or an empty one. checkStructure() verifies that its entries are objects.
const Json& listOf(const GltfDocument& document, const char* name);

// A member of an object; null if missing (or if `object` is not an object).
const Json* member(const Json& object, const char* key);
// object.extensions.NAME, or null.
const Json* extensionOf(const Json& object, const char* name);

// The member of "extras" that contains this program's own data ("notes").
inline constexpr const char* kExtrasName = "lamplighter";
// Marks the meshes that show sphere lights in other programs, see gltf_sphere_meshes.cpp.
inline constexpr const char* kSphereMark = "sphereLight";
// Note on a node: how its mesh is lit, "simple" or "complex" (MeshKind).
inline constexpr const char* kMeshKindNote = "mesh";
inline constexpr const char* kLockedNote = "locked";
// Note on a scene: its sky.
inline constexpr const char* kSkyNote = "sky";
// object.extras.lamplighter.KEY, or null.
const Json* noteOf(const Json& object, const char* key);
// Whether noteOf() is `true`.
bool isMarked(const Json& object, const char* key);

// Typed members. They throw InputError if the member exists with another type or is not finite.
std::optional<size_t> sizeMember(const GltfDocument&, const Json& object, const char* key, At at);
// The same, and the value must be less than `count`.
std::optional<size_t> indexMember(const GltfDocument&, const Json& object, const char* key, At at,
                                  size_t count);
double numberMember(const GltfDocument&, const Json& object, const char* key, double otherwise,
                    At at);
bool boolMember(const GltfDocument&, const Json& object, const char* key, bool otherwise, At at);
std::string textMember(const GltfDocument&, const Json& object, const char* key, At at);
// `count` finite numbers in the range of float; empty if there is no such member.
std::vector<double> numbersMember(const GltfDocument&, const Json& object, const char* key,
                                  size_t count, At at);
vec3 vec3Member(const GltfDocument&, const Json& object, const char* key, const vec3& otherwise,
                At at);
const Json* arrayMember(const GltfDocument&, const Json& object, const char* key, At at);

// gltf_document.cpp: reads the file and parses the JSON, but reads no buffers or images.
GltfDocument readGltfJson(const std::filesystem::path& path);

// gltf_uri.cpp: the bytes of a URI, which is a data URI or a file in the folder of the document. On
// failure returns null and sets `why`.
Bytes readUri(const GltfDocument& document, const std::string& uri, std::string& why);
// Decodes %20 etc.; invalid escapes stay unchanged.
std::string percentDecoded(std::string_view text);
// Reads a whole regular file. On failure returns null and sets `why`.
Bytes readWholeFile(const std::filesystem::path& path, std::string& why);
// gltf_uri.cpp: fills GltfDocument::buffers. Requires checkStructure().
void readBuffers(GltfDocument& document);

// gltf_validate.cpp. Both throw InputError.
void checkVersionAndExtensions(GltfDocument& document);
// Checks that every index is in range, every accessor within its view, every view within its
// buffer, and that the nodes are a forest.
void checkStructure(const GltfDocument& document);

}  // namespace lamplighter
