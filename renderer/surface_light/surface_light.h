// The service that finds light on surfaces by itself: bounced light, smooth, of any number of
// bounces, current in every frame.
//
// Elements of all surfaces (surface_mesh.h) get direct light from each emitter (direct_factors.h)
// and exchange it along kept rays (gather_links.h, bounced_light.h). Edits of brightness trace no
// ray; those of places and of structure trace again what they touch. Rays are traced over several
// frames: the first one has light of few rays. When all are traced, the result has the bits of a
// fresh start.
#pragma once

#include "renderer/surface_light/bounced_light.h"
#include "renderer/surface_light/direct_factors.h"

namespace lamplighter {

struct SurfaceLightOptions {
  int bounces = 2;
  float edge = 0.25f;    // longest edge of an element where memory allows it [m]
  int gatherRays = 256;  // of a sample; down to 32 if memory is short
  size_t linkBytes = size_t{64} << 20;
  int mask = 0;  // DirectFactors::Scene
  uint32_t seed = 1;
  GatherProjection projection = GatherProjection::hemisphere;
  SurfaceLightPart part = SurfaceLightPart::bounced;
  bool operator==(const SurfaceLightOptions&) const = default;
};

class SurfaceLight {
 public:
  // Work of the last update, and what there is.
  struct Counts {
    uint64_t rays = 0;         // traced
    size_t samplesTraced = 0;  // of which at least one ray was traced
    size_t masks = 0;          // of them, drawn
    size_t factorsFound = 0;   // direct light of an emitter on an element
    size_t samples = 0, leaves = 0, bytes = 0;
    float edge = 0.0f;  // longest edge [m]
  };

  static constexpr uint64_t kAllRays = ~uint64_t{0};
  // Goes on. `changes`: since the last update. `mostRays`: about so many are traced. Returns
  // whether the light may have changed.
  bool update(const RenderScene& scene, const RenderSceneChanges& changes, const RayCaster& rays,
              const SurfaceLightOptions& options, uint64_t mostRays = kAllRays);
  // Whether it has the bits of a fresh start with all rays.
  bool isDone() const { return isDone_; }
  // Whether the last update left the elements and the links of pixels as they were.
  bool keptMesh() const { return keptMesh_; }
  void forget() { *this = SurfaceLight(); }

  // Irradiance by value of the mesh [W/m²]: the part of the options. SurfacePicture shows it.
  const std::vector<vec3>& values() const { return bounced_; }
  // The bounced light of a value of an object is the sum, by these weights, of what links of
  // samples gather of reflected(): each sample's mean over its first linksGathered() links.
  std::map<uint32_t, double> sharesOf(uint32_t object, uint32_t value) const;
  size_t linksGathered() const { return gathered_; }
  // What elements reflect, for further points that gather light.
  const ReflectedLight& reflected() const { return reflected_; }
  // Irradiance of the sky without its suns at a point of an object along its known links
  // (`directions`: of these), per unit of skyBrightness() [W/m²]. Ray i left spot i modulo their
  // number.
  vec3 skyAlong(const RenderScene& scene, uint32_t object, std::span<const SurfaceSpot> spots,
                std::span<const vec3> directions, std::span<const GatherLink> links) const;
  // Its radiance, per unit of skyBrightness().
  vec3 skyTowards(const vec3& direction) const;
  vec3 skyBrightness() const { return skyBrightness_; }
  // Differs if skyAlong() does for the same links.
  uint32_t skyVersion() const { return skyVersion_; }
  SurfaceLightPart part() const { return options_.part; }
  // How well the mesh shows the light at a point, from 0 to 1: not where surfaces are near compared
  // with an element, nor on elements that are cut by walls or stand for many small triangles.
  // Whether a part of an element is buried or behind a wall.
  bool isMixed(uint32_t leaf) const { return state_.isMixed.empty() || state_.isMixed[leaf] != 0; }
  float trustAt(const MeshPoint& point) const;
  // Whether it lies inside of an object or behind a wall, and has the light of its neighbours.
  bool isBuried(uint32_t sample) const { return state_.smoothing.isBuried(sample); }
  // What the last update found to have moved, if it kept the elements' numbers: objects, and boxes
  // that contain them before and after.
  const std::vector<uint32_t>& movedObjects() const { return moved_; }
  const std::vector<Bounds>& movedBoxes() const { return boxes_; }
  // Whether elements have other numbers since the update before.
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
  size_t gathered_ = 0;  // links of a sample that bounced_ is found by
  std::vector<uint32_t> moved_;
  std::vector<Bounds> boxes_;
  bool hasOtherElements_ = false;
  std::vector<vec3> sky_;  // by sample: what rays see of the sky, per unit of its brightness
  Sky seenSky_;            // the sky of it, at unit brightness
  uint32_t skyVersion_ = 0;
  vec3 skyBrightness_{0.0f};
  std::vector<uint8_t> isUnsmoothed_;  // by sample: traced since smoothing was found
  bool isStarted_ = false, isDone_ = false, keptMesh_ = false;
  Counts counts_;
};

}  // namespace lamplighter
