// Computes light that is stored on surfaces: smooth bounced light with any number of bounces, up to
// date in every frame.
//
// Elements of all surfaces (surface_mesh.h) get direct light from each emitter (direct_factors.h)
// and exchange it along stored rays (gather_links.h, bounced_light.h). Edits of brightness trace no
// rays; moved, added and removed objects and lights retrace only the affected rays. Rays are traced
// over several frames; the first frame uses few rays per sample. When all rays are traced, the
// result is bitwise equal to that of a new start.
#pragma once

#include "renderer/surface_light/bounced_light.h"
#include "renderer/surface_light/direct_factors.h"

namespace lamplighter {

struct SurfaceLightOptions {
  int bounces = 2;
  float edge = 0.25f;    // longest edge of an element, if memory allows it [m]
  int gatherRays = 256;  // per sample; at least 32 if memory is limited
  size_t linkBytes = size_t{64} << 20;
  int mask = 0;  // see DirectFactors::Scene
  uint32_t seed = 1;
  GatherProjection projection = GatherProjection::hemisphere;
  SurfaceLightPart part = SurfaceLightPart::bounced;
  bool operator==(const SurfaceLightOptions&) const = default;
};

class SurfaceLight {
 public:
  // Work of the last update, and current sizes.
  struct Counts {
    uint64_t rays = 0;         // traced
    size_t samplesTraced = 0;  // samples with at least one traced ray
    size_t masks = 0;          // masks drawn
    size_t factorsFound = 0;   // pairs of emitter and element whose direct light was computed
    size_t samples = 0, leaves = 0, bytes = 0;
    float edge = 0.0f;  // longest edge [m]
  };

  static constexpr uint64_t kAllRays = ~uint64_t{0};
  // Continues the computation. `changes`: since the last update. `mostRays`: approximate maximum
  // number of rays. Returns whether the light may have changed.
  bool update(const RenderScene& scene, const RenderSceneChanges& changes, const RayCaster& rays,
              const SurfaceLightOptions& options, uint64_t mostRays = kAllRays);
  // Whether the light is complete: bitwise equal to that of a new start with all rays.
  bool isDone() const { return isDone_; }
  // Whether the last update did not change the elements and the links of pixels.
  bool keptMesh() const { return keptMesh_; }
  void forget() { *this = SurfaceLight(); }

  // Irradiance by value of the mesh [W/m²], of part(). SurfacePicture shows it.
  const std::vector<vec3>& values() const { return bounced_; }
  // By sample: its weight in the bounced light of a value of an object. The light of a sample is
  // the mean of reflected() over its first linksGathered() links.
  std::map<uint32_t, double> sharesOf(uint32_t object, uint32_t value) const;
  size_t linksGathered() const { return gathered_; }
  // Light that elements reflect, for other points that gather it.
  const ReflectedLight& reflected() const { return reflected_; }
  // Irradiance of the sky without suns at a point of an object along its known links, per unit of
  // skyBrightness() [W/m²]. `directions`: of these links. Ray i started at spot i modulo the number
  // of spots.
  vec3 skyAlong(const RenderScene& scene, uint32_t object, std::span<const SurfaceSpot> spots,
                std::span<const vec3> directions, std::span<const GatherLink> links) const;
  // Radiance of the sky without suns, per unit of skyBrightness().
  vec3 skyTowards(const vec3& direction) const;
  vec3 skyBrightness() const { return skyBrightness_; }
  // Changes when skyAlong() changes for the same links.
  uint32_t skyVersion() const { return skyVersion_; }
  SurfaceLightPart part() const { return options_.part; }
  // Whether a part of an element is buried or behind a wall.
  bool isMixed(uint32_t leaf) const { return state_.isMixed.empty() || state_.isMixed[leaf] != 0; }
  // How well the mesh represents the light at a point, from 0 to 1: low if surfaces are near
  // compared with the size of the element, and on elements that are cut by walls or represent many
  // small triangles.
  float trustAt(const MeshPoint& point) const;
  // Whether a sample lies inside an object or behind a wall, so that it uses the light of its
  // neighbours.
  bool isBuried(uint32_t sample) const { return state_.smoothing.isBuried(sample); }
  // If the last update kept the numbers of elements: the objects that moved, and boxes that contain
  // them before and after.
  const std::vector<uint32_t>& movedObjects() const { return moved_; }
  const std::vector<Bounds>& movedBoxes() const { return boxes_; }
  // Whether the last update changed the numbers of elements.
  bool hasOtherElements() const { return hasOtherElements_; }

  const SurfaceMesh& mesh() const { return mesh_; }
  const CutLeaves& cuts() const { return cuts_; }
  const GatherLinks& links() const { return links_; }
  const Counts& counts() const { return counts_; }

 private:
  void findAlbedo(const RenderScene& scene);
  void smooth(const RenderScene& scene, bool isNewMesh);
  void findMixed();
  void findSky(const RenderScene& scene, std::span<const uint32_t> samples);
  void findLight(int bounces, int most);

  SurfaceLightOptions options_;
  LightSet lights_;
  SurfaceMesh mesh_;
  CutLeaves cuts_;
  GatherLinks links_;
  DirectFactors direct_;
  SurfaceState state_;
  std::vector<vec3> bounced_;  // by value
  ReflectedLight reflected_;
  size_t gathered_ = 0;  // links per sample used for bounced_
  std::vector<uint32_t> moved_;
  std::vector<Bounds> boxes_;
  bool hasOtherElements_ = false;
  std::vector<vec3> sky_;  // by sample: irradiance of the sky, per unit of its brightness
  Sky seenSky_;            // the sky for which sky_ was computed, at unit brightness
  uint32_t skyVersion_ = 0;
  vec3 skyBrightness_{0.0f};
  std::vector<uint8_t> isUnsmoothed_;  // by sample: traced since the last smoothing
  bool isStarted_ = false, isDone_ = false, keptMesh_ = false;
  Counts counts_;
};

}  // namespace lamplighter
