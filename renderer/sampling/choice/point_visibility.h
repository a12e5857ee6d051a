// Which points are visible from VPLs, and the irradiance at the points, cached between edits. While
// a light is dragged, most VPLs stay in place, and rays that no moved object crosses stay valid.
// Points are processed eight at a time.
#pragma once

#include <array>
#include <span>
#include <unordered_map>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/choice/point_blocks.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/shadow_maps/refresh_scheduler.h"

namespace lamplighter {

class PointVisibility {
 public:
  static constexpr size_t kMostPoints = PointBlocks::kMostPoints;

  // Invalidates cached results after a change of the scene. Call it before the next irradiance().
  void outdate(const RenderSceneChanges& changes, std::span<const MoverFinder::Mover> movers);

  // Luminance of the irradiance at each point from each light; the ids of the lights must differ.
  // One row of kMostPoints values per light, 0 after the last point; at most kMostPoints points.
  // The result is valid until the next call. 1/d² is bounded at clampDistance [m].
  std::span<const float> irradiance(std::span<const SceneVpl> lights,
                                    std::span<const SeenPoint> points, const RayCaster& rays,
                                    float clampDistance);

 private:
  static constexpr size_t kLanes = PointBlocks::kLanes, kBlocks = PointBlocks::kBlocks;
  using Points = std::array<uint8_t, kBlocks>;  // one bit per point
  // A VPL and its cached results.
  struct Row {
    shared::Vpl vpl{};
    float clampDistance = 0.0f;
    size_t at = 0;           // index in known_
    Points known{}, seen{};  // visibility tested; VPL visible from the point
    uint32_t measured = 0;   // one bit per block whose geometry is computed
    alignas(
        32) std::array<float, kMostPoints> geometry{};  // E there if nothing does, over I [1/m²]
  };
  struct Obstacle;
  struct IdHash {
    size_t operator()(const VplId& id) const;
  };

  void takePoints(std::span<const SeenPoint> points);
  void findRows(std::span<const SceneVpl> lights);
  void take(const shared::Vpl& light, float clampDistance, size_t at, Row& row) const;
  void outdate(Row& row, std::span<const Obstacle> obstacles) const;
  void fill(Row& row, const RayCaster& rays, float* out) const;

  PointBlocks points_;
  Points same_{};  // points that are unchanged since the last call
  std::unordered_map<VplId, Row, IdHash> rows_;
  // All rows, in the order of the lights of the last call.
  struct Known {
    VplId id;
    Row* row;
  };
  std::vector<Known> known_;
  std::vector<float> irradiance_;
};

}  // namespace lamplighter
