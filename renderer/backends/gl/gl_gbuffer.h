// Primary visibility by rasterisation: what each pixel sees.
#pragma once

#include <filesystem>
#include <map>

#include "renderer/backends/gl/gl_scene.h"
#include "renderer/backends/gl/shading_points.h"
#include "renderer/gl/program.h"
#include "renderer/gl/waits.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/frustum.h"

namespace lamplighter::gl {

class GlGBuffer {
 public:
  explicit GlGBuffer(const std::filesystem::path& shaders);
  void reload(const std::filesystem::path& shaders);

  void render(const GlScene& scene, const View& view, vec2 jitter);
  // Binds the textures to the units of shaders/shared/bindings.h.
  void bind() const;
  const ShadingPoints& points() const { return points_; }
  Image readNormals(Waits& waits) const;
  Image readAlbedo(Waits& waits) const;

  // Frustum of the view in the G-buffer.
  const Frustum& frustum() const { return frustum_; }
  const View& view() const { return view_; }
  vec2 jitter() const { return jitter_; }
  const vec3& eye() const { return view_.eye; }
  int width() const { return width_; }
  int height() const { return height_; }
  uint64_t bytes() const;

 private:
  void resize(int width, int height);
  const Program& programFor(const GlScene::Drawn& drawn);

  std::filesystem::path shaders_;
  // Compiled on first use: each takes tens of milliseconds on a software driver.
  std::map<std::pair<bool, bool>, Program> programs_;  // by (textured, masked)
  Program normals_;
  VertexArray emptyVertexArray_;
  Framebuffer framebuffer_;
  ShadingPoints points_;
  Texture albedo_, emission_, gloss_, depth_;
  Frustum frustum_;
  View view_;
  vec2 jitter_{0.0f};
  int width_ = 0, height_ = 0;
};

}  // namespace lamplighter::gl
