#include "renderer/backends/cpu/many_lights/picture_sums.h"

#include "renderer/backends/cpu/many_lights/packet_limit.h"
#include "shaders/shared/low_resolution.h"

namespace lamplighter::cpu {
namespace {

std::vector<SpecularLight> specularLights(const PictureSums::Input& in) {
  std::vector<SpecularLight> lights;
  lights.reserve(in.lights.size());
  for (size_t i = 0; i < in.lights.size(); ++i) lights.push_back({in.lights[i], in.footprints[i]});
  return lights;
}

SumCounts update(IrradianceAccumulator& sums, const GBuffer& points, const PictureSums::Input& in,
                 std::span<const uint32_t> wanted) {
  return sums.update(points, in.lights, in.constants, in.patches, wanted, in.leftOutBy);
}

}  // namespace

SumCounts PictureSums::sum(const Input& in, int side, bool isQuick, uint64_t mostAtEdges,
                           const SeenPoints* before) {
  // Where all edges can be summed there is nothing to take over.
  if (before != nullptr && (side == 1 || !low.isLong())) {
    before = nullptr;
    forgetCarried();
  }
  if (before != nullptr) takeCarried(before->px.size() / kTilePixels);
  block = side;
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
  if (before != nullptr) carried.find(in.gbuffer, *before, low.edges());
  low.useCarried(carried.isOf(in.gbuffer.tiles()) ? &carried : nullptr);
  if (mostAtEdges != UINT64_MAX) low.limitEdges(in.gbuffer, sums, in.lights, mostAtEdges, isQuick);
  if (!isQuick && !low.isLimited()) forgetCarried();
  return counts + update(sums, in.gbuffer, in, low.summed());
}

// Stores the light of the last sum.
void PictureSums::takeCarried(size_t tiles) {
  std::vector<uint32_t> open(tiles, 0);
  if (block != 1)
    for (size_t t = 0; t < tiles; ++t) open[t] = low.edges()[t] & ~low.summed()[t];
  carried.take(diffuse(), open);
}

SumCounts PictureSums::sumAt(const Input& in, std::span<const uint32_t> packets) {
  return update(sums, in.gbuffer, in, packets);
}

std::vector<uint32_t> PictureSums::fitting(const Input& in, std::span<const uint32_t> packets,
                                           uint64_t mostLightPixels) const {
  PacketLimit limit(in.gbuffer, sums, in.lights, mostLightPixels);
  std::vector<uint32_t> some(packets.size(), 0);
  for (size_t t = 0; t < packets.size(); ++t) some[t] = limit.goOn(t, packets[t]);
  for (size_t t = 0; t < packets.size() && !limit.isReached(); ++t)
    some[t] |= limit.begin(t, packets[t] & ~some[t]);
  return some;
}

uint64_t PictureSums::sumSpeculars(const Input& in, float leastRoughness, bool isKept,
                                   uint64_t mostLightPixels) {
  sampledSpeculars.clear();
  if (leastRoughness < 0.0f) {
    speculars.clear();
    return 0;
  }
  return speculars.update(in.scene, in.gbuffer, in.eye, specularLights(in), in.constants,
                          leastRoughness, in.patches, isKept, mostLightPixels);
}

uint64_t PictureSums::sampleSpeculars(const Input& in, float leastRoughness) {
  speculars.clear();
  if (leastRoughness < 0.0f) {
    sampledSpeculars.clear();
    return 0;
  }
  return sampledSpeculars.update(in.scene, in.gbuffer, low, in.eye, specularLights(in),
                                 in.constants, leastRoughness, in.patches);
}

void PictureSums::addSpeculars(const GBuffer& gbuffer, Image& picture) const {
  if (sampledSpeculars.isOn())
    sampledSpeculars.addTo(gbuffer, low, picture);
  else
    speculars.addTo(gbuffer, picture);
}

void PictureSums::forgetMaps() {
  forEachSums([](IrradianceAccumulator& s) { s.forgetMaps(); });
  speculars.forgetMaps();
  sampledSpeculars.forgetMaps();
}

void PictureSums::forgetPlaces() {
  forEachSums([](IrradianceAccumulator& s) { s.forgetPlaces(); });
  speculars.forgetPlaces();
  sampledSpeculars.forgetPlaces();
}

size_t PictureSums::bytes() const {
  return sums.bytes() + low.bytes() + sampleSums.bytes() + lowSamples.bytes() + coarseSums.bytes() +
         carried.bytes() + speculars.bytes() + sampledSpeculars.bytes();
}

}  // namespace lamplighter::cpu
