// A glTF file in the making: the JSON of the source, patched, and the bytes that come with it. For
// gltf_save*.cpp only. What is the same in the scene as it was loaded stays as it was in the file,
// to the digit; only differences are written.
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
  const SceneSource& source;  // an empty one for a scene that came from no file
  std::filesystem::path path;
  bool isBinary = false;     // .glb
  bool besideSource = true;  // may refer to the source's files
  Json json;

  void useExtension(const char* name);
  // Entries of a top-level list; the list is made where there is none. Returns the entry's index.
  size_t append(const char* list, Json entry);
  // Bytes in a new buffer view, at a multiple of eight. `target`: 34962 vertices, 34963 indices, 0.
  size_t appendView(std::span<const uint8_t> bytes, int target = 0);

  // gltf_save_buffers.cpp
  void startBuffers();  // takes the source's buffers over
  void carryImages();   // embeds the source's image files where they would not be found
  // What to write: the .gltf or .glb last.
  struct File {
    std::filesystem::path path;
    std::vector<uint8_t> bytes;
  };
  void addFile(File file) { files_.push_back(std::move(file)); }  // beside them
  // One of them, or null.
  const File* addedFile(const std::filesystem::path& target) const;
  std::vector<File> finish();
  bool isSameFolder() const;  // as the source's, whose files are there to be referred to

 private:
  std::filesystem::path freeBufferName();

  size_t bufferIndex_ = 0;       // the buffer that new bytes go to
  std::vector<uint8_t> buffer_;  // all of it
  bool keepsBuffers_ = false;    // the source's buffers stay where they are
  std::vector<File> files_;      // that were added
};

// The shortest decimal that gives this float again; a float as a double has digits nobody wrote.
Json toJson(float value);
Json toJson(const vec2& v);
Json toJson(const vec3& v);
Json toJson(const vec4& v);
double shortestDouble(float value);
// File names in URIs: what is not plain is escaped.
std::string percentEncoded(const std::string& name);
// Factors in [0, 1] and what to multiply them with, of a colour that may be above one.
struct ScaledColor {
  Json color;
  double scale = 1.0;
};
ScaledColor scaledColor(const vec3& color);

// object.extensions.NAME, made where there is none; and taken away again.
Json& extensionObject(Json& object, const char* name);
void eraseExtension(Json& object, const char* name);
// The object's extras.lamplighter, made where there is none. Extras may be anything; what is no
// object has no place for ours and moves down.
Json& noteFor(Json& object);
void eraseNote(Json& object, const char* key);

// gltf_save_materials.cpp
void saveTextures(GltfOutput& out);
void saveMaterials(GltfOutput& out);
// gltf_save_meshes.cpp. Writes the list so that entry i is scene.meshes[i].
void saveMeshes(GltfOutput& out);
size_t appendFloats(GltfOutput& out, std::span<const float> values, size_t components,
                    bool withBounds);
size_t appendIndices(GltfOutput& out, std::span<const uint32_t> indices, size_t vertices);
// gltf_save_nodes.cpp. Returns the JSON index of each of scene.nodes.
std::vector<size_t> saveNodes(GltfOutput& out);
// gltf_save_lights.cpp
void saveLights(GltfOutput& out, const std::vector<size_t>& jsonNodes);
// gltf_light_notes.cpp: what glTF has no place for, as notes: on and solo, groups, what is left
// out, profiles, pictures.
using JsonOfNode = std::map<NodeId, size_t>;  // index in the file that is written
void saveLightNotes(GltfOutput& out, Json& json, const Node& now, const Node& was,
                    const JsonOfNode& jsonNodes);
void saveSceneLightNotes(GltfOutput& out, const JsonOfNode& jsonNodes);
// gltf_save_sky.cpp
// The URI of a file beside the scene with these bytes: one that is there already, or a new one that
// is added to the output under a name that no other file has.
std::string uriOfFile(GltfOutput& out, const std::filesystem::path& name,
                      std::span<const uint8_t> bytes);
void saveSky(GltfOutput& out);
// gltf_bookmarks.cpp
void saveBookmarks(GltfOutput& out);
// gltf_save_spheres.cpp. Last of all: see gltf_sphere_meshes.cpp.
void saveSphereMeshes(GltfOutput& out, const std::vector<size_t>& jsonNodes);

// gltf_save_files.cpp: all of the files or, when one cannot be written, none. Throws InputError.
void writeFilesAtomically(const std::vector<GltfOutput::File>& files);

}  // namespace lamplighter
