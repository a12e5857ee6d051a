// A glTF file while it is being saved: the patched JSON of the source, and its bytes. For
// gltf_save*.cpp only. Only differences are written: parts that equal the loaded scene stay as they
// were in the file, to the digit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/gltf/gltf_document.h"
#include "renderer/scene/gltf/gltf_source.h"

namespace lamplighter {

class GltfOutput {
 public:
  GltfOutput(const Scene& savedScene, const std::filesystem::path& target);

  const Scene& scene;
  const SceneSource& source;  // empty if the scene was not loaded from a file
  std::filesystem::path path;
  bool isBinary = false;     // .glb
  bool besideSource = true;  // the result may refer to files of the source
  Json json;

  void useExtension(const char* name);
  // Appends an entry to a top-level list, which is created if necessary. Returns its index.
  size_t append(const char* list, Json entry);
  // Appends bytes as a new buffer view, aligned to 8 bytes. `target`: 34962 vertices, 34963
  // indices, 0 none.
  size_t appendView(std::span<const uint8_t> bytes, int target = 0);

  // gltf_save_buffers.cpp
  void startBuffers();  // takes over the source's buffers
  void carryImages();   // embeds image files of the source that would not be found otherwise
  // The files to write; the .gltf or .glb is last.
  struct File {
    std::filesystem::path path;
    std::vector<uint8_t> bytes;
  };
  void addFile(File file) { files_.push_back(std::move(file)); }  // an additional file
  // A file from addFile(), or null.
  const File* addedFile(const std::filesystem::path& target) const;
  std::vector<File> finish();
  bool isSameFolder() const;  // same folder as the source, so that its files can be referred to

 private:
  std::filesystem::path freeBufferName();

  size_t bufferIndex_ = 0;       // index of the buffer to which new bytes are appended
  std::vector<uint8_t> buffer_;  // its content
  bool keepsBuffers_ = false;    // the source's buffers are not rewritten
  std::vector<File> files_;      // from addFile()
};

// The shortest decimal that gives the same float; a float converted to double prints extra digits.
Json toJson(float value);
Json toJson(const vec2& v);
Json toJson(const vec3& v);
Json toJson(const vec4& v);
double shortestDouble(float value);
// File names in URIs: escapes special characters.
std::string percentEncoded(const std::string& name);
// A colour that may exceed 1, as factors in [0, 1] and a scale.
struct ScaledColor {
  Json color;
  double scale = 1.0;
};
ScaledColor scaledColor(const vec3& color);

// object.extensions.NAME; the first function creates it if necessary, the second removes it.
Json& extensionObject(Json& object, const char* name);
void eraseExtension(Json& object, const char* name);
// The object's extras.lamplighter, created if necessary. Extras can be of any type; extras that are
// not an object are moved to a member of a new object.
Json& noteFor(Json& object);
void eraseNote(Json& object, const char* key);

// gltf_save_materials.cpp
void saveTextures(GltfOutput& out);
void saveMaterials(GltfOutput& out);
// gltf_save_meshes.cpp. Writes the list so that entry i corresponds to scene.meshes[i].
void saveMeshes(GltfOutput& out);
size_t appendFloats(GltfOutput& out, std::span<const float> values, size_t components,
                    bool withBounds);
size_t appendIndices(GltfOutput& out, std::span<const uint32_t> indices, size_t vertices);
// gltf_save_nodes.cpp. Returns the JSON index of each node of scene.nodes.
std::vector<size_t> saveNodes(GltfOutput& out);
// gltf_save_lights.cpp
void saveLights(GltfOutput& out, const std::vector<size_t>& jsonNodes);
// gltf_light_notes.cpp: light properties that glTF does not have, as notes: on and solo, groups,
// light linking, profiles, pictures.
using JsonOfNode = std::map<NodeId, size_t>;  // index in the written file
void saveLightNotes(GltfOutput& out, Json& json, const Node& now, const Node& was,
                    const JsonOfNode& jsonNodes);
void saveSceneLightNotes(GltfOutput& out, const JsonOfNode& jsonNodes);
// gltf_save_sky.cpp
// The URI of a file beside the scene with these bytes: an existing one, or a new one that is added
// to the output under an unused name.
std::string uriOfFile(GltfOutput& out, const std::filesystem::path& name,
                      std::span<const uint8_t> bytes);
void saveSky(GltfOutput& out);
// gltf_bookmarks.cpp
void saveBookmarks(GltfOutput& out);
// gltf_save_spheres.cpp. Must be called last: see gltf_sphere_meshes.cpp.
void saveSphereMeshes(GltfOutput& out, const std::vector<size_t>& jsonNodes);

// gltf_save_files.cpp: writes all of the files or, on failure, none. Throws InputError.
void writeFilesAtomically(const std::vector<GltfOutput::File>& files);

}  // namespace lamplighter
