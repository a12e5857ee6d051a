#include "editor/error_meter/reference_sampler.h"

#include <algorithm>
#include <atomic>

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/image/average_blocks.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {
namespace {

// Seeds that differ between the halves and from pictures of the method `reference`.
uint32_t seedOfHalf(uint32_t seed, uint32_t half) { return hash4(seed, half, 0x6d657465u, 1u); }

}  // namespace

Image ReferenceHalves::mean() const {
  Image mean = first;
  for (size_t i = 0; i < mean.pixels.size(); ++i)
    mean.pixels[i] = 0.5f * (first.pixels[i] + second.pixels[i]);
  return mean;
}

void ReferenceSampler::begin(const MeterSubject& subject) {
  const bool sameLevel = world_.rays() != nullptr && subject.level == subject_.level;
  const SceneChanges changes = sameLevel ? compare(scene_, *subject.scene) : SceneChanges::all();
  const RenderSceneChanges moved = world_.update(*subject.scene, changes);
  if (!sameLevel || !moved.none()) lights_ = LightSet::forPaths(world_.scene(), lights_);
  scene_ = *subject.scene;
  subject_ = subject;
  subject_.view = world_.viewOf(subject.view);
  const View& view = subject_.view;
  block_ = std::min({std::max(subject_.block, 1), view.width, view.height});
  first_ = second_ = Image(blocksOf(view.width, block_), blocksOf(view.height, block_));
  samples_ = 0;
  leaveOutLamps();
}

// Finds the lamps with four rays per block. Also excludes the neighbours of their blocks, because
// the outline may lie there.
void ReferenceSampler::leaveOutLamps() {
  const int width = first_.width, height = first_.height;
  std::vector<uint8_t> seen(first_.pixels.size(), 0);
  const auto showsLamp = [&](float x, float y) {
    const Hit hit = world_.rays()->intersect(
        {subject_.view.eye, 0.0f, subject_.view.rayDirection(x, y)}, Surfaces::seen);
    return hit && lights_.emitterOfObject(hit.object) != kNone;
  };
  const tbb::blocked_range2d<int> blocks(0, height, 8, 0, width, 8);
  tbb::parallel_for(blocks, [&](const tbb::blocked_range2d<int>& tile) {
    for (int y = tile.rows().begin(); y < tile.rows().end(); ++y)
      for (int x = tile.cols().begin(); x < tile.cols().end(); ++x)
        for (int i = 0; i < 4; ++i) {
          const float dx = i % 2 == 0 ? 0.25f : 0.75f, dy = i / 2 == 0 ? 0.25f : 0.75f;
          const auto side = static_cast<float>(block_);
          if (showsLamp(side * (static_cast<float>(x) + dx), side * (static_cast<float>(y) + dy)))
            seen[static_cast<size_t>(y * width + x)] = 1;
        }
  });
  counts_.assign(seen.size(), 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
          if (seen[static_cast<size_t>(j * width + i)] != 0)
            counts_[static_cast<size_t>(y * width + x)] = 0;
}

// Each step samples one pixel of the block and visits all pixels in turn. The first pixel is random
// for each block. After any number of steps all pixels are therefore equally likely, and the mean
// of the paths is the mean of the block.
bool ReferenceSampler::step(const std::function<bool()>& stop) {
  const int pixels = block_ * block_;
  const View& view = subject_.view;
  std::atomic<bool> stopped = false;
  const auto add = [&](Image& sum, uint32_t half, int x, int y) {
    PathTracerOptions options = subject_.paths;
    options.seed = seedOfHalf(options.seed, half);
    const uint32_t begin =
        hash4(static_cast<uint32_t>(x), static_cast<uint32_t>(y), options.seed, 2u);
    const int turn =
        static_cast<int>((begin + static_cast<uint32_t>(samples_)) % static_cast<uint32_t>(pixels));
    const auto path = static_cast<uint32_t>(samples_ / pixels);
    sum.at(x, y) +=
        tracePath(world_.scene(), *world_.rays(), lights_, view, x * block_ + turn % block_,
                  y * block_ + turn / block_, path, options);
  };
  const tbb::blocked_range2d<int> blocks(0, first_.height, 8, 0, first_.width, 8);
  tbb::parallel_for(blocks, [&](const tbb::blocked_range2d<int>& tile) {
    if (stopped || (stop && stop())) {
      stopped = true;
      return;
    }
    for (int y = tile.rows().begin(); y < tile.rows().end(); ++y) {
      for (int x = tile.cols().begin(); x < tile.cols().end(); ++x) {
        add(first_, 0u, x, y);
        add(second_, 1u, x, y);
      }
    }
  });
  if (stopped) return false;
  ++samples_;
  return true;
}

ReferenceHalves ReferenceSampler::halves() const {
  ReferenceHalves halves{subject_.number, block_, samples_, first_, second_, counts_};
  const float share = 1.0f / static_cast<float>(std::max(samples_, 1));
  for (vec3& p : halves.first.pixels) p *= share;
  for (vec3& p : halves.second.pixels) p *= share;
  return halves;
}

}  // namespace lamplighter
