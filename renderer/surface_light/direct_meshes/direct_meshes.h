// The direct light of area lights at the vertices of meshes that are refined where the picture
// needs it (paper 4, "Multi-mesh caching"): one mesh for each light, so that an edit of a light
// does not change other meshes, or one mesh for all lights.
//
// The light of a vertex depends only on its position and normal, and the cut for a view
// (mesh_cut.h) only on that light. So a finished picture does not depend on earlier frames.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/surface_light/direct_meshes/light_factor.h"
#include "renderer/surface_light/direct_meshes/lit_pixels.h"
#include "renderer/surface_light/direct_meshes/mesh_cut.h"
#include "renderer/surface_light/direct_meshes/request_order.h"

namespace lamplighter {

struct DirectMeshOptions {
  MeshCutOptions cut;
  MeshPriority priority = MeshPriority::sorted;
  bool isSeparate = true;  // a mesh for each light
  uint32_t seed = 1;
  size_t memory =
      size_t{256}
      << 20;  // limit for vertices and nodes [bytes]; those of other views are discarded
  bool operator==(const DirectMeshOptions&) const = default;
};

class DirectMeshes {
 public:
  // Work since beginFrame(), and current sizes.
  struct Counts {
    size_t meshes = 0, vertices = 0, triangles = 0;  // triangles: of all cuts of the last picture
    size_t samples = 0;                              // vertices whose light was computed
    LightFactor::Work work;
    size_t bytes = 0;
  };

  void beginFrame() {
    counts_.samples = 0;
    counts_.work = {};
  }
  // Takes the scene and discards light that may have changed. `lights`, `scene` and `rays` must
  // stay valid until the next call.
  void update(const RenderScene& scene, const RenderSceneChanges& changes, const RayCaster& rays,
              const LightSet& lights, const DirectMeshOptions& options);
  // Sets the pixels that the following calls show.
  void show(const View& view, const GBufferView& gbuffer, const SurfacePictureOptions& options);
  // Computes light that the pixels need, at up to `most` vertices. Returns whether nothing is
  // missing.
  bool goOn(size_t most);
  // Computes the radiance of the pixels by each mesh, per unit of brightness(). `byMesh`: the
  // result of the last call since show(); unchanged parts are kept.
  void picture(std::vector<std::vector<vec3>>& byMesh);
  // By mesh: brightness of its emitter; 1 if there is one mesh for all lights.
  std::vector<vec3> brightness() const;
  // Whether the last update changed anything except the brightness of lights whose light is known.
  bool changed() const { return changed_; }

  const Counts& counts() const { return counts_; }
  void forget() { *this = DirectMeshes(); }

 private:
  struct Mesh {
    std::vector<VplId> lights;  // one, or all
    std::vector<LitPixels::Light>
        of;  // the same lights; weights: brightness if there are several lights
    MeshValues values;
    bool isComplete = false;  // whether the light of all pixels is known
    bool isOff = false;       // the light is off, so nothing is computed
    bool isShown = false;     // the last picture() shows it unchanged
    size_t triangles = 0;     // triangles of its cut in the last picture()
  };
  void findLight(Mesh& mesh, uint32_t number, size_t most);
  void makeMeshes(const RenderSceneChanges& changes, const DirectMeshOptions& options);
  void forgetTouched(const RenderSceneChanges& changes);
  size_t bytes() const;

  const RenderScene* scene_ = nullptr;
  const RayCaster* rays_ = nullptr;
  const LightSet* lights_ = nullptr;
  DirectMeshOptions options_;
  // On the heap, because factors refer to them.
  std::unique_ptr<Blockers> blockers_;
  std::vector<std::unique_ptr<LightFactor>> factors_;
  SplitTree tree_;
  std::vector<Mesh> meshes_;
  View view_;
  VisibleTriangles visible_;
  std::vector<uint32_t> roots_;  // of the visible triangles
  std::optional<LitPixels> pixels_;
  uint32_t batch_ = 0;
  size_t next_ = 0;  // mesh at which the next frame continues
  bool changed_ = false;
  Counts counts_;
};

}  // namespace lamplighter
