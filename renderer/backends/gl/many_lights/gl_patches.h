// The scene's patch trees, light maps and precomputed radiance transfer in OpenGL buffers.
#pragma once

#include <span>
#include <vector>

#include "renderer/gl/objects.h"
#include "renderer/light_maps/patch_lights.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter::gl {

class GlPatches {
 public:
  // Uploads what changed since the last call. Throws InputError if the device has too little
  // memory.
  void update(const RenderScene& scene, const PatchLights& lights);
  // For shaders/passes/find_patches.frag.glsl, except the triangle corners (GlScene).
  void bind() const;

  // The index of an object's first patch among the patches of the scene; and their total number.
  uint32_t firstNode(uint32_t object) const { return objects_[object].first.nodes; }
  size_t nodes() const { return total_.nodes; }
  uint64_t bytes() const { return bytes_; }
  uint64_t uploaded() const { return uploaded_; }  // bytes since construction

  // Upper bound of light map texels on this device.
  static uint64_t mostTexels();

 private:
  struct Sizes {
    uint32_t triangles = 0, nodes = 0, charts = 0, tiles = 0, texels = 0;
    uint32_t vertices = 0;  // lit by radiance transfer
    bool operator==(const Sizes&) const = default;
  };
  struct Object {
    Sizes first, size;
    Revision patches, tiling, maps, light;
    std::vector<uint32_t> writes;  // by tile, as in LightMaps
  };
  static Sizes sizesOf(const RenderScene& scene, const PatchLights& lights, uint32_t object);
  void allocate();
  bool hasSameTrees(const PatchLights& lights, uint32_t object) const;
  void upload(const RenderScene& scene, const PatchLights& lights, uint32_t object);
  void uploadTexels(const LightMaps& maps, uint32_t object);
  template <typename T>
  void write(const Buffer& buffer, uint32_t first, std::span<const T> values);

  std::vector<Object> objects_;
  Sizes total_;
  bool hasMaps_ = false;
  Buffer roots_, patches_, charts_, tiles_, texels_, vertexLight_;
  uint64_t bytes_ = 0, uploaded_ = 0;
};

}  // namespace lamplighter::gl
