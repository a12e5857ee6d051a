// A glTF file as read: its JSON, its bytes and what is said about it. Shared by the gltf_*.cpp
// files only; other code sees gltf_io.h.
//
// The JSON is read here and not by tinygltf, for two reasons: tinygltf 2.7 accepts cycles, indices
// out of range and counts of four billion, so that everything has to be checked in the JSON anyway;
// and saving patches the very JSON that was read, so that what is not understood stays as it was.
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

using Json = nlohmann::ordered_json;  // keeps the order of the members when it is written again
using Bytes = std::shared_ptr<const std::vector<uint8_t>>;

// Where in the file something is: "accessors[3]".
struct At {
  const char* list;
  size_t index;
  std::string text() const { return std::string(list) + "[" + std::to_string(index) + "]"; }
};

struct GltfDocument {
  std::filesystem::path path;
  Json json;
  Bytes binaryChunk;              // of a .glb, else null
  std::vector<Bytes> buffers;     // one for each of json["buffers"], at least byteLength long
  std::vector<Bytes> imageFiles;  // encoded bytes of images with a file of their own, else null
  size_t bytesRead = 0;           // of the file and its buffers
  // Every file that was read, as it was just before.
  std::shared_ptr<std::vector<FileStamp>> files = std::make_shared<std::vector<FileStamp>>();
  std::vector<std::string> warnings;

  [[noreturn]] void fail(const std::string& wrong, const std::string& remedy) const;
  [[noreturn]] void fail(const At& at, const std::string& wrong, const std::string& remedy) const {
    fail(at.text() + " " + wrong, remedy);
  }
  void warn(const std::string& text);
  bool usesExtension(const char* name) const;
};

// Nothing is placed farther than this from the origin [m].
inline constexpr double kFarthestPlace = 1e9;

// What to do about a file that breaks the rules of glTF.
inline constexpr const char* kExportAgain =
    "export it again, or mend it (a glTF validator says more)";

// Control characters out, long texts cut: for use in a message of one line.
std::string printable(std::string_view text);

// A top-level array; an empty one where the file has none. checkStructure() sees to it that its
// entries are objects.
const Json& listOf(const GltfDocument& document, const char* name);

// A member of an object, or null where there is none (or `object` is no object).
const Json* member(const Json& object, const char* key);
// object.extensions.NAME, or null.
const Json* extensionOf(const Json& object, const char* name);

// The member of "extras" that holds what this program notes in a file.
inline constexpr const char* kExtrasName = "lamplighter";
// Marks what shows sphere lights to other programs, see gltf_sphere_meshes.cpp.
inline constexpr const char* kSphereMark = "sphereLight";
// A note on a node: how its mesh is lit, "simple" or "complex" (MeshKind).
inline constexpr const char* kMeshKindNote = "mesh";
inline constexpr const char* kLockedNote = "locked";
// A note on a scene: what is around it.
inline constexpr const char* kSkyNote = "sky";
// object.extras.lamplighter.KEY, or null.
const Json* noteOf(const Json& object, const char* key);
// Whether that is true.
bool isMarked(const Json& object, const char* key);

// Typed members. They throw InputError when the member is there and of another type or not finite.
std::optional<size_t> sizeMember(const GltfDocument&, const Json& object, const char* key, At at);
// The same, and less than `count`.
std::optional<size_t> indexMember(const GltfDocument&, const Json& object, const char* key, At at,
                                  size_t count);
double numberMember(const GltfDocument&, const Json& object, const char* key, double otherwise,
                    At at);
bool boolMember(const GltfDocument&, const Json& object, const char* key, bool otherwise, At at);
std::string textMember(const GltfDocument&, const Json& object, const char* key, At at);
// `count` finite numbers that fit in a float; empty where there is no such member.
std::vector<double> numbersMember(const GltfDocument&, const Json& object, const char* key,
                                  size_t count, At at);
vec3 vec3Member(const GltfDocument&, const Json& object, const char* key, const vec3& otherwise,
                At at);
const Json* arrayMember(const GltfDocument&, const Json& object, const char* key, At at);

// gltf_document.cpp: reads the file and parses the JSON; buffers and images are not read yet.
GltfDocument readGltfJson(const std::filesystem::path& path);

// gltf_uri.cpp: the bytes behind a URI: data, or a file in the folder of the document. Null and
// `why` set when there are none to be had.
Bytes readUri(const GltfDocument& document, const std::string& uri, std::string& why);
// %20 and the like; what is no escape stays as it is.
std::string percentDecoded(std::string_view text);
// Reads a whole regular file. Null and `why` set when it cannot be read.
Bytes readWholeFile(const std::filesystem::path& path, std::string& why);
// gltf_uri.cpp: fills GltfDocument::buffers. Call it after checkStructure().
void readBuffers(GltfDocument& document);

// gltf_validate.cpp. Both throw InputError.
void checkVersionAndExtensions(GltfDocument& document);
// Every index in range, every accessor in its view and every view in its buffer, nodes a forest.
void checkStructure(const GltfDocument& document);

}  // namespace lamplighter
