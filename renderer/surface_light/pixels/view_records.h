// Records of irradiance at pixels of a view, where the elements of the surface mesh are too coarse:
// in corners, at contacts, on detailed meshes. They gather light from the mesh along stored rays,
// so that changed light on the mesh traces no rays. Distances between records follow Ward,
// Rubinstein and Clear, "A Ray Tracing Solution for Diffuse Interreflection" (1988).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/surface_light/gather_rays.h"
#include "renderer/surface_light/surface_light.h"

namespace lamplighter {

class ViewRecords {
 public:
  static constexpr size_t kRays = 64;  // rays per record

  // The records that show the light of a pixel, and their weights, whose sum is 1.
  struct Point {
    std::array<uint32_t, 4> records{};
    std::array<float, 4> weights{};
  };

  void restart(const View& view, uint32_t seed, GatherProjection projection);
  // Call after each SurfaceLight::update(): marks outdated rays.
  void outdate(const GatherScene& scene, const SurfaceLight& light);
  // Chooses records for the G-buffer of the view and traces up to about `most` rays, but at least
  // those of the first record. Call it until isDone().
  void choose(const GatherScene& scene, const SurfaceLight& light, const GBufferView& gbuffer,
              uint64_t most);
  // Traces only outdated rays, for frames in which objects move.
  void retrace(const GatherScene& scene, uint64_t most);
  // Computes the light of the records. Call after each of the above.
  void findLight(const RenderScene& scene, const SurfaceLight& light);
  // Whether all records have all rays.
  bool isDone() const { return isDone_; }
  // Missing rays of the known records. More may be needed after these are traced.
  uint64_t raysLeft() const { return raysLeft_; }
  bool isEmpty() const { return records_.empty(); }

  // The records for a pixel that shows this spot of an object. If no record is similar, other
  // records of the same object around the pixel. False if there are none.
  bool find(int x, int y, uint32_t object, const SurfaceSpot& spot, Point& out) const;
  // Irradiance by record [W/m²], of SurfaceLight::part().
  const std::vector<vec3>& values() const { return values_; }
  size_t bytes() const;

 private:
  struct Record {
    SurfaceSpot spot;
    MeshPoint onMesh;
    float trust = 0.0f;   // of onMesh
    float radius = 0.0f;  // maximum distance at which its light may be used [m]
    uint64_t stale = 0;   // one bit for each outdated ray
    vec3 sky{0.0f};       // SurfaceLight::skyAlong() of its links
    bool hasSky = false;
    uint32_t object = 0, place = 0, cell = 0;
    uint8_t level = 0, set = 0;

    // False if the object slid along its own surface, because another point of it is there.
    bool isSame(const Record& other) const {
      return spot.position == other.spot.position && spot.turn == other.spot.turn &&
             object == other.object && place == other.place;
    }
  };
  struct Near {
    std::array<uint32_t, 16> records{};
    std::array<float, 16> weights{};  // relative to that of the record itself
    uint32_t count = 0;
  };
  struct Level {
    int step = 0, width = 0, height = 0;
    std::vector<int32_t> records;  // by cell; kNone
  };

  void trace(const GatherScene& scene, std::span<const uint32_t> records);
  void findNear();
  float pixelSize(const vec3& position) const;
  std::span<const vec3> directionsOf(const Record& r) const {
    return std::span(directions_).subspan(r.set * kRays, kRays);
  }
  std::span<GatherLink> linksOf(size_t record) {
    return std::span(links_).subspan(record * kRays, kRays);
  }
  // Calls take(record, weight) for the records of the first `levels` levels around a pixel. The
  // weight is the weight of the cell times like(record), and larger than 0.
  template <typename Like, typename Take>
  void around(int x, int y, size_t levels, const Like& like, const Take& take) const;

  View view_;
  std::array<Level, 4> levels_;
  std::vector<vec3> directions_;  // by set
  std::vector<Record> records_;
  std::vector<GatherLink> links_;  // by record, then by ray
  std::vector<Near> near_;
  std::vector<vec3> values_;
  uint32_t skyVersion_ = 0;  // of sky
  uint64_t raysLeft_ = 0;
  bool isDone_ = false;
};

}  // namespace lamplighter
