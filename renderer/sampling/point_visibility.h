// Which of some points light samples see, and what would reach these, kept from edit to edit: of
// the samples of a light that is dragged most bounce where they did, and a ray that nothing moved
// across finds what it found.
#pragma once

#include <bitset>
#include <map>
#include <span>
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
  using Points = std::bitset<kMostPoints>;

  // A light sample, and what is known of it so far.
  class Row {
   public:
    // Whether nothing stands between it and the point with this index.
    bool sees(const SeenPoint& point, size_t index, const RayCaster& rays);
    // Irradiance at the point if nothing does, over the sample's intensity [1/m²].
    float geometry(const SeenPoint& point, size_t index);

   private:
    friend class PointVisibility;
    shared::Vpl vpl_{};
    float clampDistance_ = 0.0f;
    Points known_, seen_, measured_;
    std::vector<float> geometry_;  // by point
  };

  // To be called before the rows of a scene that changed are asked for again.
  void outdate(const RenderSceneChanges& changes, std::span<const MoverFinder::Mover> movers);
  // One for each light, whose ids differ; good until the next call. At most kMostPoints points;
  // 1/d² is bounded at clampDistance [m].
  std::vector<Row*> rows(std::span<const SceneVpl> lights, std::span<const SeenPoint> points,
                         float clampDistance);

 private:
  std::vector<SeenPoint> points_;
  std::map<VplId, Row> rows_;
};

}  // namespace lamplighter
