// The direct light of area lights at the vertices of meshes that are refined where the picture asks
// (paper 4, "Multi-mesh caching"): one mesh for each light, so that a light that moves, or becomes
// brighter, changes no other, or one for all.
//
// The light of a vertex is a function of its place and normal, and the cut that a view shows one of
// that light (mesh_cut.h). So a finished picture is the same whatever came before.
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
  size_t memory = size_t{256} << 20;  // of vertices and nodes; those of other views are forgotten
  bool operator==(const DirectMeshOptions&) const = default;
};

class DirectMeshes {
 public:
  // Work since beginFrame(), and what there is.
  struct Counts {
    size_t meshes = 0, vertices = 0, triangles = 0;  // triangles: of all cuts of the last picture
    size_t samples = 0;                              // vertices whose light was found
    LightFactor::Work work;
    size_t bytes = 0;
  };

  void beginFrame() {
    counts_.samples = 0;
    counts_.work = {};
  }
  // Takes the scene, and forgets the light that may have changed. `lights`: valid until the next
  // call, as are `scene` and `rays`.
  void update(const RenderScene& scene, const RenderSceneChanges& changes, const RayCaster& rays,
              const LightSet& lights, const DirectMeshOptions& options);
  // The pixels to show from now on.
  void show(const View& view, const GBufferView& gbuffer, const SurfacePictureOptions& options);
  // Finds light that the pixels need, of up to `most` vertices. Returns whether nothing is missing.
  bool goOn(size_t most);
  // The radiance of the pixels by each mesh, per unit of brightness(). `byMesh`: that of the last
  // call since show(), whose unchanged parts stay.
  void picture(std::vector<std::vector<vec3>>& byMesh);
  // Of each mesh [of the emitter; 1 if there is one mesh for all].
  std::vector<vec3> brightness() const;
  // Whether the last update changed more than the brightness of lights whose light is known.
  bool changed() const { return changed_; }

  const Counts& counts() const { return counts_; }
  void forget() { *this = DirectMeshes(); }

 private:
  struct Mesh {
    std::vector<VplId> lights;         // one, or all
    std::vector<LitPixels::Light> of;  // the same; weights: brightness if there are several
    MeshValues values;
    bool isComplete = false;  // for the pixels
    bool isOff = false;       // has no brightness, so that nothing is found
    bool isShown = false;     // by the last picture(), as it is
    size_t triangles = 0;     // of its cut then
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
  size_t next_ = 0;  // mesh at which the next frame goes on
  bool changed_ = false;
  Counts counts_;
};

}  // namespace lamplighter
