// Bakes light into the vertex colours of a copy of a scene, for engines without light maps.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/bake/bake_job.h"
#include "renderer/bake/vertex_light.h"

namespace lamplighter {

struct VertexColourOptions {
  BakeLightOptions light;
  VertexLightOptions vertices;
  // Colours are irradiance / π times 2^exposure; those above 1 become 1. None: the brightest is 1.
  std::optional<float> exposure;
  std::filesystem::path output;  // folder; created if it does not exist
  std::string name;              // name of the files, without extension
};

struct LitScene {
  Scene scene;
  float scale = 1.0f;  // factor of the colours
  size_t meshes = 0;   // number of meshes with their own light
  size_t trianglesBefore = 0, triangles = 0;
  size_t clipped = 0;  // vertices with a colour above 1
};

// A copy whose meshes have the light in their vertex colours; nodes that are lit differently have
// meshes of their own. Returns nullopt if `progress` returns false; `progress` receives the number
// of nodes. Deterministic. Throws InputError if there is nothing to light.
std::optional<LitScene> withVertexColours(const Scene& scene, const VertexColourOptions& options,
                                          const BakeProgress& progress);

// Writes the copy and a JSON file with its scale, or nothing. Throws InputError. Returns the files.
std::vector<std::filesystem::path> writeLitScene(const LitScene& lit,
                                                 const VertexColourOptions& options);

}  // namespace lamplighter
