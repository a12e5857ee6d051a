// Light probes of the edited level, by the path tracer over many frames: each frame does a part of
// the work. After an edit the probes are computed again one after the other; until then they keep
// their old light.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/probes/probe_light.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {

// Everything is in the unit of the scene.
class LiveProbes {
 public:
  static constexpr uint32_t kSamples = 256;  // number of paths of a settled probe
  static constexpr uint32_t kSlice = 16;     // number of paths per slice
  static constexpr int kMostNodes = 4096;    // of the grid

  bool on() const { return on_; }
  void setOn(bool on);
  // The spacing is larger if the grid would have more than kMostNodes nodes.
  const ProbeGridOptions& options() const { return options_; }
  void setOptions(const ProbeGridOptions& options);
  void forget();  // when another level is opened

  // Call after each frame with the changes of the scene since the last call. Off: does nothing. The
  // work is the given number of slices; the results depend only on the scene.
  void update(const RenderScene& scene, const RayCaster& rays, const SceneChanges& changes);
  // Call with the duration of the last update [s]: the next ones then fit into a few milliseconds.
  // Without this call all updates do the same amount of work.
  void took(double seconds);

  // Whether further frames leave the light unchanged.
  bool settled() const { return !on_ || finished_ == grid_.probes.size(); }
  const ProbeGrid& grid() const { return grid_; }
  // Light by probe; 0 where it is not known yet.
  const std::vector<ProbeSh>& light() const { return light_; }
  bool hasLight(size_t probe) const { return nodes_[probe].isKnown; }
  // For the status line: "probes 178 of 180, 43%". "": off. `unit`: of the scene [m].
  std::string text(float unit) const;

 private:
  struct Node {
    uint64_t placedIn = 0, litIn = 0;  // revisions
    uint32_t samples = 0;
    bool isKnown = false;       // light_ has some light, perhaps of an earlier revision
    ProbeSh sum{}, punctual{};  // of the samples; of punctual lights
  };
  bool isDone(const Node& node) const {
    return node.placedIn == surfaces_ && node.litIn == lights_ && node.samples >= kSamples;
  }
  void fitGrid(const RenderScene& scene);
  void refresh(const RenderScene& scene, const RayCaster& rays, size_t index);

  bool on_ = false;
  ProbeGridOptions options_{.most = kMostNodes};
  ProbeGrid grid_;
  std::vector<Node> nodes_;
  std::vector<ProbeSh> light_;
  uint64_t surfaces_ = 0, lights_ = 0;  // revisions of the scene
  size_t next_ = 0;                     // next probe in the order of visits
  size_t finished_ = 0;                 // nodes whose light is final
  size_t samples_ = 0;                  // of the current light, of all nodes
  size_t visits_ = 0;                   // visits of the next update; 0: the first one
  std::optional<ProbeReference> reference_;
  const RenderScene* scene_ = nullptr;  // of reference_
  const RayCaster* rays_ = nullptr;
};

}  // namespace lamplighter
