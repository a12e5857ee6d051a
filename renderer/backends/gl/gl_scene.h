// The scene's triangles, materials and textures in OpenGL buffers.
#pragma once

#include <vector>

#include "renderer/backends/gl/gl_textures.h"
#include "renderer/gl/objects.h"
#include "renderer/scene/render_scene.h"
#include "shaders/shared/material.h"

namespace lamplighter::gl {

class GlScene {
 public:
  GlScene();

  // Throws InputError if the device has too little memory.
  void update(const RenderScene& scene, const RenderSceneChanges& changes);

  // An object to draw (clear ones are not drawn).
  struct Drawn {
    uint32_t object = 0;  // index into RenderScene::objects
    int material = 0;
    bool textured = false;
    bool masked = false;
    bool culled = false;  // its back faces are culled for the camera
  };
  // Opaque untextured objects first, then by material, so that few state changes are needed.
  const std::vector<Drawn>& drawn() const { return drawn_; }
  const RenderScene& scene() const { return *scene_; }

  // All vertex attributes and the index buffer.
  GLuint vertexArray() const { return vertexArray_.name(); }
  // Binds the vertices as storage buffers, to read the corners of a triangle.
  void bindStorage() const;
  // The same for shaders/passes/find_patches.frag.glsl.
  void bindCorners() const;
  // For light linking in shaders/common/left_out.glsl.
  void bindLeftOut() const;
  // Binds the material's uniform block and textures.
  void bindMaterial(int material) const;

  // Uploads of the vertices of one object since construction.
  size_t uploadedObjects() const { return uploaded_; }
  uint64_t bytes() const { return bytes_ + textures_.bytes(); }

 private:
  void allocate();
  void uploadGeometry();
  bool hasRoom() const;
  void uploadObject(uint32_t object, bool isNew);
  void uploadMaterials();

  const RenderScene* scene_ = nullptr;
  VertexArray vertexArray_;
  Buffer positions_, normals_, tangents_, uv0_, uv1_, colors_, indices_, firstIndices_;
  Buffer leftOut_;    // by triangle, if any light has light linking
  Buffer materials_;  // one SurfaceMaterial per materialStride_ bytes
  GLintptr materialStride_ = 0;
  struct MaterialTextures {
    GLuint baseColor = 0, normal = 0, emissive = 0, gloss = 0;
  };
  std::vector<MaterialTextures> materialTextures_;
  TextureCache textures_;
  std::vector<Drawn> drawn_;
  size_t vertexRoom_ = 0, indexRoom_ = 0, objectRoom_ = 0;  // of the buffers
  size_t uploaded_ = 0;
  uint64_t bytes_ = 0;
};

// The material in the layout of the shaders.
shared::SurfaceMaterial surfaceMaterial(const Material& material);

}  // namespace lamplighter::gl
