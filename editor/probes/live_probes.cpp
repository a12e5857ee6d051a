#include "editor/probes/live_probes.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <spdlog/fmt/fmt.h>
#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

constexpr size_t kVisits = 128, kLeastVisits = 8, kMostVisits = 2048;  // probes a frame
constexpr double kWanted = 4e-3;                                       // of a frame [s]
// The last bounces are dim, and a frame has little time.
constexpr int kBounces = 3;

// Successive visits are far apart in the level, so that all of it follows an edit alike: steps of
// the golden section, without a common divisor, so that all nodes have their turn.
size_t strideOf(size_t count) {
  auto stride = static_cast<size_t>(0.618034 * static_cast<double>(count)) | size_t{1};
  while (std::gcd(stride, count) != 1) ++stride;
  return stride;
}

}  // namespace

void LiveProbes::setOn(bool on) {
  if (on == on_) return;
  on_ = on;
  if (!on) forget();
}

void LiveProbes::setOptions(const ProbeGridOptions& options) {
  options_ = options;
  options_.most = kMostNodes;
  ++surfaces_;  // all are placed and lit again
  ++lights_;
}

void LiveProbes::forget() {
  grid_ = {};
  nodes_.clear();
  light_.clear();
  next_ = finished_ = samples_ = 0;
  reference_.reset();
}

// Nodes that the new grid has as well keep what is known of them.
void LiveProbes::fitGrid(const RenderScene& scene) {
  ProbeGrid grid = probeNodes(scene.bounds, options_);
  if (grid.first == grid_.first && grid.size == grid_.size && grid.spacing == grid_.spacing) return;
  std::vector<Node> nodes(grid.probes.size());
  std::vector<ProbeSh> light(grid.probes.size());
  for (size_t i = 0; i < nodes.size() && grid.spacing == grid_.spacing; ++i) {
    const glm::ivec3 old = grid.nodeAt(i) + grid.first - grid_.first;
    if (glm::any(glm::lessThan(old, glm::ivec3(0))) ||
        glm::any(glm::greaterThanEqual(old, grid_.size)))
      continue;
    const size_t from = grid_.indexOf(old);
    grid.probes[i] = grid_.probes[from];
    nodes[i] = nodes_[from];
    light[i] = light_[from];
  }
  grid_ = std::move(grid);
  nodes_ = std::move(nodes);
  light_ = std::move(light);
  next_ = 0;
}

void LiveProbes::update(const RenderScene& scene, const RayCaster& rays,
                        const SceneChanges& changes) {
  if (!on_) return;
  const bool isNew = !reference_ || scene_ != &scene || rays_ != &rays;
  if (isNew || !changes.none()) {
    if (isNew || changes.everything || changes.structure || !changes.moved.empty() ||
        !changes.materials.empty())
      ++surfaces_;
    ++lights_;
    const std::optional<ProbeReference> before = std::exchange(reference_, std::nullopt);
    reference_.emplace(scene, rays, PathTracerOptions{.bounces = kBounces},
                       before ? before->lights() : LightSet());
    scene_ = &scene;
    rays_ = &rays;
  }
  fitGrid(scene);
  const size_t count = nodes_.size();
  std::vector<size_t> chosen;
  if (visits_ == 0) visits_ = kVisits;
  if (count > 0) {
    const size_t stride = strideOf(count);
    for (size_t i = 0; i < count && chosen.size() < visits_; ++i) {
      next_ = (next_ + stride) % count;
      if (!isDone(nodes_[next_])) chosen.push_back(next_);
    }
  }
  tbb::parallel_for(size_t{0}, chosen.size(), [&](size_t i) { refresh(scene, rays, chosen[i]); });
  finished_ = samples_ = 0;
  for (const Node& node : nodes_) {
    finished_ += isDone(node);
    if (node.litIn == lights_) samples_ += node.samples;
  }
}

void LiveProbes::refresh(const RenderScene& scene, const RayCaster& rays, size_t index) {
  Node& node = nodes_[index];
  Probe& probe = grid_.probes[index];
  if (node.placedIn != surfaces_) {
    const vec3 before = probe.position;
    probe = placedProbe(scene, rays, grid_, grid_.nodeAt(index), options_.padding);
    node.placedIn = surfaces_;
    node.isKnown = node.isKnown && probe.isValid() && probe.position == before;
  }
  if (!probe.isValid()) {
    node = {node.placedIn, lights_, kSamples, false, {}, {}};
    light_[index] = {};
    return;
  }
  if (node.litIn != lights_) {
    node.litIn = lights_;
    node.samples = 0;
    node.sum = {};
    node.punctual = reference_->punctualLight(probe.position);
  }
  reference_->addSamples(probe.position, node.samples, kSlice, node.sum);
  node.samples += kSlice;
  for (size_t c = 0; c < kProbeCoefficients; ++c)
    light_[index][c] = node.punctual[c] + node.sum[c] / static_cast<float>(node.samples);
  node.isKnown = true;
}

void LiveProbes::took(double seconds) {
  if (settled()) return;
  // At most twice as much or half as much as before, so that one slow frame does not count for all.
  const double factor = std::clamp(kWanted / std::max(seconds, 1e-6), 0.5, 2.0);
  visits_ = std::clamp(static_cast<size_t>(factor * static_cast<double>(visits_)), kLeastVisits,
                       kMostVisits);
}

std::string LiveProbes::text(float unit) const {
  if (!on_) return {};
  const size_t count = nodes_.size();
  if (count == 0) return "no probes";
  std::string text = fmt::format("probes {} of {}, {:.3g} m", grid_.count(ProbeState::valid), count,
                                 unit * grid_.spacing);
  if (!settled()) text += fmt::format(", {}%", 100 * samples_ / (count * kSamples));
  return text;
}

}  // namespace lamplighter
