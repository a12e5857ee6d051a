// Converts the JSON of a glTF file to parts of a Scene, list by list: entry i of each result
// corresponds to entry i of the file's list. Requires that checkStructure() has passed.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/scene/gltf/gltf_document.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {

// gltf_meshes.cpp. Warns about skipped data (points and lines) and repaired data (normals).
std::vector<std::shared_ptr<const Mesh>> readMeshes(GltfDocument& document);

// gltf_materials.cpp
Material readMaterial(const GltfDocument& document, size_t index);
std::vector<Material> readMaterials(GltfDocument& document);

// gltf_textures.cpp. Decodes the textures that `materials` use, on all cores, and fills
// document.imageFiles. Other textures get a white pixel. Warns about every image that is not
// available.
std::vector<Texture> readTextures(GltfDocument& document, const std::vector<Material>& materials,
                                  const LoadProgress& progress);

// A checkerboard of magenta and black, easy to notice.
std::shared_ptr<const Image8> placeholderImage();

// gltf_lights.cpp
std::optional<PunctualLight> readPunctual(const GltfDocument& document, size_t node);
// The light as in the file: EXT_lights_area scales its size by the largest world scale of the node,
// whereas AreaLight scales each axis separately. `worldScale`: of the node, by axis.
std::optional<AreaLight> readArea(const GltfDocument& document, size_t node,
                                  const vec3& worldScale);
// A spot or rectangle light that cannot be read correctly is an error. Lights of unknown kinds are
// skipped with a warning.
void warnOfUnknownLights(GltfDocument& document);
// gltf_light_notes.cpp: on, solo, group and profile of the nodes' lights; groups and the state of
// the sky.
void readLightNotes(GltfDocument& document, std::vector<Node>& nodes);
void readSceneLightNotes(GltfDocument& document, Scene& scene);
// gltf_bookmarks.cpp: camera bookmarks, by slot; malformed ones are skipped with a warning.
std::vector<CameraBookmark> readBookmarks(GltfDocument& document);
// gltf_sphere_meshes.cpp: removes the meshes that saveGltf() added so that other programs show
// sphere lights.
void stripSphereMeshes(GltfDocument& document);

// gltf_nodes.cpp
Camera readCamera(const GltfDocument& document, size_t index);
std::vector<Camera> readCameras(GltfDocument& document);
Transform readTransform(const GltfDocument& document, size_t node);
// Everything of a node except id, parent and area light.
Node readNode(const GltfDocument& document, size_t node);
// Nodes of the default scene, parents before children; ids start at 1.
std::vector<Node> readNodes(GltfDocument& document);

// gltf_sky.cpp: the sky of the default scene. It is skipped with a warning if it is malformed or
// its picture is not available.
std::optional<Sky> readSky(GltfDocument& document);

// Name of the default scene, or empty.
std::string sceneName(const GltfDocument& document);

}  // namespace lamplighter
