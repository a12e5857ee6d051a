#include "renderer/backends/cpu/many_lights/picture_sums.h"

#include "shaders/shared/low_resolution.h"

namespace lamplighter::cpu {
namespace {

// In quick pictures one in so many light samples has a highlight.
constexpr size_t kQuickShare = 4;

SumCounts update(IrradianceAccumulator& sums, const GBuffer& points, const PictureSums::Input& in,
                 std::span<const uint32_t> wanted) {
  return sums.update(points, in.lights, in.constants, in.patches, wanted, in.leftOutBy);
}

SumCounts operator+(const SumCounts& a, const SumCounts& b) {
  return {a.lightPixels + b.lightPixels, a.lookUps + b.lookUps};
}

}  // namespace

SumCounts PictureSums::sum(const Input& in, int pixelsPerBlock, bool isQuick,
                           uint64_t mostAtEdges) {
  block = pixelsPerBlock;
  if (block == 1) return update(sums, in.gbuffer, in, {});
  SumCounts counts;
  low.update(in.gbuffer, block, in.leftOutBy);
  if (isQuick) {
    lowSamples.update(low.samples(), shared::kSampleBlock, in.leftOutBy);
    counts = update(coarseSums, lowSamples.samples(), in, {});
    lowSamples.findEdges(low.samples(), {coarseSums});
    coarseSums.forgetMaps();
    counts = counts + update(sampleSums, low.samples(), in, lowSamples.edges());
    low.findEdges(in.gbuffer, {sampleSums, &lowSamples});
  } else {
    counts = update(sampleSums, low.samples(), in, {});
    low.findEdges(in.gbuffer, {sampleSums});
  }
  if (mostAtEdges != UINT64_MAX) low.limitEdges(in.gbuffer, sums, in.lights, mostAtEdges);
  return counts + update(sums, in.gbuffer, in, low.summed());
}

SumCounts PictureSums::sumAt(const Input& in, std::span<const uint32_t> packets) {
  return update(sums, in.gbuffer, in, packets);
}

uint64_t PictureSums::sumSpeculars(const Input& in, float leastRoughness, bool isKept,
                                   bool isQuick) {
  if (leastRoughness < 0.0f) {
    speculars.clear();
    return 0;
  }
  std::vector<SpecularLight> lights;
  lights.reserve(in.lights.size());
  size_t samples = 0;
  for (size_t i = 0; i < in.lights.size(); ++i) {
    SpecularLight light{in.lights[i], in.footprints[i]};
    // Others light only a part of the scene, or are the whole light.
    if (isQuick && light.record.kind == LightRecord::Kind::cosine) {
      if (samples++ % kQuickShare != 0) continue;
      light.record.intensity *= static_cast<float>(kQuickShare);
      light.footprint *= static_cast<float>(kQuickShare);
    }
    lights.push_back(light);
  }
  return speculars.update(in.scene, in.gbuffer, in.eye, std::move(lights), in.constants,
                          leastRoughness, in.patches, isKept);
}

void PictureSums::forgetMaps() {
  forEachSums([](IrradianceAccumulator& s) { s.forgetMaps(); });
  speculars.forgetMaps();
}

void PictureSums::forgetPlaces() {
  forEachSums([](IrradianceAccumulator& s) { s.forgetPlaces(); });
  speculars.forgetPlaces();
}

size_t PictureSums::bytes() const {
  return sums.bytes() + low.bytes() + sampleSums.bytes() + lowSamples.bytes() + coarseSums.bytes() +
         speculars.bytes();
}

}  // namespace lamplighter::cpu
