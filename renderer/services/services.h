// Services that methods share: each is created when a method requests it for the first time, kept
// between frames, and updated from the changes of the scene.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/surface_sampler.h"
#include "renderer/services/object_charts.h"
#include "renderer/shadow_maps/refresh_scheduler.h"

namespace lamplighter {

enum class Service : uint8_t { rays, movers, surfaces, charts };
inline constexpr Service kServices[] = {Service::rays, Service::movers, Service::surfaces,
                                        Service::charts};
const char* nameOf(Service service);  // "rays"

// Work limits of a frame in addition to the budgets in the parameters of a method.
struct FrameBudget {
  // If true, slow precomputations may finish some frames later. If false, the frame waits for them,
  // so that every run gives the same frames.
  bool inBackground = false;
  // Number of light samples, or rows of paths, by which this frame may improve a settled picture;
  // 0: none.
  int refineUpdates = 0;
  // Number of rows of paths that this frame may trace to repair a picture before it has settled; 0:
  // none.
  int previewUpdates = 0;
  // Number of frames after a frame of the method that may only trace these paths, as long as the
  // picture is far from settled and has a large error.
  int previewFrames = 0;
  // The work on light on surfaces (elements, links or a field), as a share of the usual work of a
  // frame. Not set: the value of the parameter `updates` divided by its default.
  std::optional<float> surfaceWork = {};
};

class Services {
 public:
  // Called by FrameRenderer before each frame, with the changes since the previous one. The scene
  // and the rays must stay valid during the frame. `isOtherScene`: nothing of the previous scene
  // may remain.
  void beginFrame(const RenderScene& scene, const RenderSceneChanges& changes,
                  const RayCaster& rays, const FrameBudget& budget, bool isOtherScene);
  // The folder where slow precomputations are kept between runs; created when needed. Empty (the
  // default): not kept.
  void setCacheFolder(std::filesystem::path folder) { cacheFolder_ = std::move(folder); }

  const FrameBudget& budget() const { return budget_; }
  const std::filesystem::path& cacheFolder() const { return cacheFolder_; }

  const RayCaster& rays();
  // The objects that moved or changed their shape since the last frame in which a method requested
  // them; the first time all objects.
  std::span<const MoverFinder::Mover> movers();
  // Points on all surfaces, uniform by area.
  const SurfaceSampler& surfaces();
  // By object: its charts and texel layout in object space. Valid until the next call.
  std::span<const ObjectAtlas> charts(float texelsPerMetre);

  // Whether a method has requested the service since construction.
  bool hasAsked(Service service) const { return (asked_ >> static_cast<int>(service) & 1u) != 0; }

 private:
  void note(Service service) { asked_ |= 1u << static_cast<int>(service); }

  const RenderScene* scene_ = nullptr;
  const RayCaster* rays_ = nullptr;
  FrameBudget budget_;
  std::filesystem::path cacheFolder_;
  uint32_t asked_ = 0;  // one bit per service

  MoverFinder moverFinder_;
  std::optional<std::vector<MoverFinder::Mover>> movers_;  // of this frame
  std::optional<SurfaceSampler> surfaces_;
  std::unique_ptr<ObjectCharts> charts_;
  // Since the finder and the sampler were updated.
  RenderSceneChanges unseenByMovers_, unseenBySurfaces_;
};

}  // namespace lamplighter
