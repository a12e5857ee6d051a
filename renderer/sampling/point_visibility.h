// Which of some points light samples see, and what reaches these, kept from edit to edit: of the
// samples of a light that is dragged most bounce where they did, and a ray that nothing moved
// across finds what it found. Points are taken eight at a time.
#pragma once

#include <array>
#include <span>
#include <unordered_map>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/shadow_maps/refresh_scheduler.h"

namespace lamplighter {

// A place that the camera sees: off its surface, on the side that is seen. World space, metres.
struct SeenPoint {
  vec3 position, normal;
  uint32_t leftOutBy = 0;  // light_linking.h
  bool operator==(const SeenPoint&) const = default;
};

class PointVisibility {
 public:
  static constexpr size_t kMostPoints = 128;

  // To be called before a scene that changed is asked about again.
  void outdate(const RenderSceneChanges& changes, std::span<const MoverFinder::Mover> movers);

  // Luminance of the irradiance that each point has from each light, whose ids differ: a row of
  // kMostPoints a light, 0 past the last of the points, which are no more. Good until the next
  // call. 1/d² is bounded at clampDistance [m].
  std::span<const float> irradiance(std::span<const SceneVpl> lights,
                                    std::span<const SeenPoint> points, const RayCaster& rays,
                                    float clampDistance);

 private:
  static constexpr size_t kLanes = 8, kBlocks = kMostPoints / kLanes;
  using Points = std::array<uint8_t, kBlocks>;  // a bit for each
  // A light sample, and what is known of it so far.
  struct Row {
    shared::Vpl vpl{};
    float clampDistance = 0.0f;
    size_t at = 0;           // in known_
    Points known{}, seen{};  // whether nothing stands between it and the point
    uint32_t measured = 0;   // blocks, a bit for each
    alignas(
        32) std::array<float, kMostPoints> geometry{};  // E there if nothing does, over I [1/m²]
  };
  // All x, all y, all z; what is past the last is nothing.
  struct Vectors {
    alignas(32) std::array<float, kMostPoints> x{}, y{}, z{};
    void set(size_t i, const vec3& v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
    vec3 at(size_t i) const { return {x[i], y[i], z[i]}; }
  };
  struct Obstacle;
  struct IdHash {
    size_t operator()(const VplId& id) const;
  };

  void takePoints(std::span<const SeenPoint> points);
  void findRows(std::span<const SceneVpl> lights);
  void take(const shared::Vpl& light, float clampDistance, size_t at, Row& row) const;
  void outdate(Row& row, std::span<const Obstacle> obstacles) const;
  void measure(Row& row, size_t block) const;
  uint32_t leftOut(uint32_t link, size_t block) const;
  void fill(Row& row, const RayCaster& rays, float* out) const;

  std::vector<SeenPoint> points_;
  Vectors positions_, normals_;
  float rounding_ = 0.0f;  // of their coordinates [m]
  Points same_{};          // of the points: as they were in the last call
  std::unordered_map<VplId, Row, IdHash> rows_;
  // All rows, in the order of the lights that were asked about last.
  struct Known {
    VplId id;
    Row* row;
  };
  std::vector<Known> known_;
  std::vector<float> irradiance_;
};

}  // namespace lamplighter
