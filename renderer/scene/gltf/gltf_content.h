// From the JSON of a glTF file to the parts of a Scene, list by list: entry i of each result
// belongs to entry i of the file's list. They expect checkStructure() to have passed.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/scene/gltf/gltf_document.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {

// gltf_meshes.cpp. Warns of what was left out (points and lines) and mended (normals).
std::vector<std::shared_ptr<const Mesh>> readMeshes(GltfDocument& document);

// gltf_materials.cpp
Material readMaterial(const GltfDocument& document, size_t index);
std::vector<Material> readMaterials(GltfDocument& document);

// gltf_textures.cpp. Decodes what `materials` use, on all cores, and fills document.imageFiles; the
// other textures have a white pixel. Warns of every image that cannot be had.
std::vector<Texture> readTextures(GltfDocument& document, const std::vector<Material>& materials,
                                  const LoadProgress& progress);

// Magenta and black squares, not to be overlooked.
std::shared_ptr<const Image8> placeholderImage();

// gltf_lights.cpp
std::optional<PunctualLight> readPunctual(const GltfDocument& document, size_t node);
// The light as the file has it: its size takes the largest of the node's world scales, not each
// axis its own as AreaLight's does. `worldScale`: the node's, by axis.
std::optional<AreaLight> readArea(const GltfDocument& document, size_t node,
                                  const vec3& worldScale);
// A spot's or rectangle's light that cannot be read right is an error; lights of unknown kinds are
// left out with a warning.
void warnOfUnknownLights(GltfDocument& document);
// gltf_light_notes.cpp: on, solo, group and profile of the nodes' lights; groups and the sky's
// state.
void readLightNotes(GltfDocument& document, std::vector<Node>& nodes);
void readSceneLightNotes(GltfDocument& document, Scene& scene);
// gltf_bookmarks.cpp: places to look from, by slot; malformed ones are left out with a warning.
std::vector<CameraBookmark> readBookmarks(GltfDocument& document);
// gltf_sphere_meshes.cpp: takes out what saveGltf() put in to show sphere lights to other programs.
void stripSphereMeshes(GltfDocument& document);

// gltf_nodes.cpp
Camera readCamera(const GltfDocument& document, size_t index);
std::vector<Camera> readCameras(GltfDocument& document);
Transform readTransform(const GltfDocument& document, size_t node);
// All of a node but its id, parent and area light.
Node readNode(const GltfDocument& document, size_t node);
// Nodes of the default scene, parents before children; ids from 1 on.
std::vector<Node> readNodes(GltfDocument& document);

// gltf_sky.cpp: of the default scene. One that is malformed, or whose picture cannot be had, is
// left out with a warning.
std::optional<Sky> readSky(GltfDocument& document);

// Of the default scene, or empty.
std::string sceneName(const GltfDocument& document);

}  // namespace lamplighter
