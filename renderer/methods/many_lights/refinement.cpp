#include "renderer/methods/many_lights/refinement.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/bias_compensation/bias_compensation_filter.h"
#include "renderer/methods/many_lights/add_scaled.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/vpl_footprints.h"

namespace lamplighter {
namespace {

// Approximate number of VPLs per batch: enough that each light gets its share, and few enough that
// there are a hundred pixel jitters until 65536 VPLs.
constexpr int kBatchVpls = 512;

// Each batch has four jitters, each with a quarter of its VPLs. Otherwise the first batches would
// undo the antialiasing.
constexpr int kShifts = 4;

// Sun shadow tiles per sun (sun_shadow_tiles.h): fewer than for live lights, because each batch
// rotates them; but light leaks along edges occur in each of them.
constexpr int kSunMaps = 64;

// Maps in memory: enough to fill a draw of the gl backend well, within this number of bytes.
constexpr int kMostSlots = 64;
constexpr size_t kMostMapBytes = size_t{64} << 20;

// Direct light needs fewer VPLs than indirect light, whose VPLs lie close to what they light. The
// live picture can need another share, when a light is moved.
constexpr float kDirectShare = 0.125f;

// Rays per pixel and batch for bias compensation.
constexpr uint32_t kNearPaths = 2;
constexpr uint32_t kJitterSet = 0x3d, kNearSet = 0x4d;

// The pixel jitter of a part of a batch. Never zero: that is the sample of the live picture.
vec2 jitterOf(uint32_t shift, uint32_t seed) {
  const vec2 jitter = sobol2(shift, hash4(seed, 0, 0, kJitterSet)) - 0.5f;
  return jitter == vec2(0.0f) ? vec2(0.25f) : jitter;
}

}  // namespace

int Refinement::slots(const Options& options) {
  if (options.vpls == 0) return 0;
  const size_t mapBytes = sizeof(float) * options.mapResolution * options.mapResolution;
  const int fitting = static_cast<int>(std::clamp<size_t>(kMostMapBytes / mapBytes, 1, kMostSlots));
  return std::clamp(options.mostMaps, 1, fitting);
}

void Refinement::restart() {
  if (started_) *this = Refinement();
}

int Refinement::goOn(const FrameInputs& in, ManyLightsKernels& kernels, const Options& options,
                     RadianceImage& live, int liveVpls, int firstSlot, MapSize size, int most) {
  if (done_) return 0;
  if (!started_) {
    started_ = true;
    vpls_ = liveVpls;
    counts_ = options.counts;
    counts_.total = kBatchVpls;
    if (counts_.directShare < 1.0f)
      counts_.directShare = std::min(counts_.directShare, kDirectShare);
    counts_.sunMaps = std::min(counts_.sunMaps, kSunMaps);
    // Finds the number of paths that gives about the wanted number of VPLs.
    lights_ = LightSet(in.scene);
    const VplSet set = generateVpls(in.scene, in.services.rays(), lights_, counts_);
    counts_.paths = set.paths;
    sum_ = Image(live.width(), live.height());
    addScaled(sum_, live.pixels(), static_cast<float>(liveVpls));
    weight_ = liveVpls;
    done_ = set.vpls.empty() || vpls_ >= options.vpls;
    if (done_) return 0;
  }
  if (!batch_) begin(in, options);
  Batch& batch = *batch_;
  if (batch.shift < 0 || batch.summed >= endOfShift(batch.shift)) {
    // In a small batch, a share may be empty.
    do {
      ++batch.shift;
    } while (batch.shift + 1 < kShifts && batch.summed >= endOfShift(batch.shift));
    batch.jitter =
        jitterOf(kShifts * counts_.batch + static_cast<uint32_t>(batch.shift), counts_.seed);
    in.backend.renderGBuffer(in.view, batch.jitter);
  }
  const size_t left = endOfShift(batch.shift) - batch.summed;
  const size_t count =
      std::min({left, static_cast<size_t>(std::max(most, 1)), static_cast<size_t>(slots(options))});
  addPart(in, kernels, options, firstSlot, size, count);
  if (batch.summed == batch.vpls.size()) finishBatch(options.vpls);
  return static_cast<int>(count);
}

void Refinement::begin(const FrameInputs& in, const Options& options) {
  ++counts_.batch;
  batch_ = std::make_unique<Batch>();
  Batch& batch = *batch_;
  // Distributes the VPLs of each light and bounce evenly over the jitters.
  VplSet set = generateVpls(in.scene, in.services.rays(), lights_, counts_, &in.view);
  findFootprints(lights_, set.vpls);
  batch.samples = sampleCount(set.vpls);
  // The lobes become sharper with each batch, so that the mean converges to the exact highlights.
  // The radii follow Knaus and Zwicker, "Progressive Photon Mapping: A Probabilistic Approach",
  // 2011, with α = 2/3, area ∝ batch^(α−1).
  const float sharper = std::pow(static_cast<float>(counts_.batch), -1.0f / 3.0f);
  for (SceneVpl& v : set.vpls) v.vpl.footprint.x *= sharper;
  batch.vpls.reserve(set.vpls.size());
  for (size_t shift = 0; shift < kShifts; ++shift)
    for (size_t i = shift; i < set.vpls.size(); i += kShifts) batch.vpls.push_back(set.vpls[i]);
  batch.image = Image(in.view.width, in.view.height);
  if (options.clampDistance > 0.0f) {
    batch.nearPixels.resize(batch.image.pixels.size());
    batch.biasCompensation.emplace(
        in.scene, in.services.rays(), batch.vpls,
        BiasCompensation::Options{counts_.directShare < 1.0f ? counts_.bounces : 0,
                                  counts_.directShare > 0.0f || counts_.bounces == 0,
                                  options.clampDistance, kNearPaths,
                                  hash4(counts_.seed, 0, 0, kNearSet), counts_.batch, in.lightOnly,
                                  options.speculars, options.leastRoughness});
  }
}

// The number of VPLs of the batch that are summed when this jitter is complete.
size_t Refinement::endOfShift(int shift) const {
  return batch_->vpls.size() * static_cast<size_t>(shift + 1) / kShifts;
}

// Sums a part of the batch's VPLs, scaled to the brightness of all; the picture is weighted by
// their share. So every picture is complete, with emission and sky.
void Refinement::addPart(const FrameInputs& in, ManyLightsKernels& kernels, const Options& options,
                         int firstSlot, MapSize size, size_t count) {
  Batch& batch = *batch_;
  const size_t all = batch.vpls.size(), end = batch.summed + count;
  const float share = all == 0 ? 1.0f : static_cast<float>(count) / static_cast<float>(all);
  std::vector<shared::Vpl> part;
  for (size_t i = batch.summed; i < end; ++i) {
    shared::Vpl vpl = batch.vpls[i].vpl;
    vpl.intensity /= share;
    vpl.slot = firstSlot + static_cast<int>(part.size());
    part.push_back(vpl);
  }
  kernels.renderShadowMaps(part, size);
  kernels.sumVpls(part,
                  {vec4(options.clampDistance, options.shadowBias, 0.0f,
                        static_cast<float>(options.lightsPerPass)),
                   vec4(1.0f, 0.0f, 0.0f, 0.0f),
                   vec4(options.speculars ? 1.0f : 0.0f, options.leastRoughness, 0.0f, 0.0f)},
                  nullptr);
  addScaled(batch.image, kernels.compose(in.lightOnly)->pixels(), share);
  if (batch.biasCompensation) {
    const auto row = [&](size_t vpls) {
      return all == 0 ? in.view.height
                      : static_cast<int>(static_cast<size_t>(in.view.height) * vpls / all);
    };
    batch.biasCompensation->findRows(in.view, batch.jitter, row(batch.summed), row(end),
                                     batch.nearPixels);
  }
  batch.summed = end;
}

void Refinement::finishBatch(int target) {
  if (batch_->biasCompensation)
    addSmoothed(batch_->nearPixels, filterRadius(counts_.batch, batch_->image.height),
                batch_->image);
  // All batches have equal weight, whatever the number of VPLs of their paths.
  addScaled(sum_, batch_->image, static_cast<float>(kBatchVpls));
  weight_ += kBatchVpls;
  vpls_ += std::max(batch_->samples, 1);
  batch_.reset();
  Image mean(sum_.width, sum_.height);
  addScaled(mean, sum_, static_cast<float>(1.0 / weight_));
  mean_ = std::make_shared<HostImage>(std::move(mean));
  done_ = vpls_ >= target;
  if (done_) sum_ = Image();
}

}  // namespace lamplighter
