#include "renderer/backends/cpu/many_lights/cpu_many_lights.h"

#include <algorithm>
#include <optional>

#include <tbb/parallel_invoke.h>

#include "renderer/backends/cpu/composition.h"
#include "renderer/backends/cpu/many_lights/adaptive_antialiasing.h"
#include "renderer/backends/cpu/many_lights/picture_sums.h"
#include "renderer/backends/cpu/many_lights/share_sums.h"
#include "renderer/backends/cpu/shadow_maps/map_store.h"

namespace lamplighter::cpu {
namespace {

class CpuManyLights final : public ManyLightsKernels {
 public:
  explicit CpuManyLights(CpuBackend& backend) : backend_(backend) {
    still_.forEachSums([](IrradianceAccumulator& sums) { sums.cacheShadowMasks(); });
  }

  const ManyLightsTraits& traits() const override { return traits_; }

  ManyLightsCounts lightCounts() const override {
    ManyLightsCounts counts = counts_;
    counts.mapsHeld = maps_.held();
    counts.mapBytes = maps_.bytes();
    return counts;
  }

  BackendCounts counts() const override {
    return {rayCount_,
            maps_.bytes() + still_.bytes() + shifted_.bytes() + (shares_ ? shares_->bytes() : 0)};
  }

  void takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                 const RayCaster& rays) override {
    const bool isOther = changes.rebuilt || scene_ != &scene;
    if (isOther || !changes.none()) {
      summedView_.reset();
      still_.forgetCarried();
    }
    scene_ = &scene;
    rays_ = &rays;
    if (isOther || changes.rebuilt || changes.materials)
      maps_.castersChange();
    else
      maps_.castersMove(scene, changes);
    if (isOther || changes.objects) {
      leftOutBy_.clear();
      for (const RenderObject& o : scene.objects)
        if (scene.hasLinks) leftOutBy_.push_back(o.leftOutBy);
    }
    if (!changes.rebuilt && !changes.materials) return;
    still_.forgetPlaces();
    shifted_.forgetPlaces();
    if (shares_) shares_->forgetPlaces();
  }

  void reserveShadowMaps(int slots, const MapRoom& coarse, const MapRoom& fine) override {
    if (!maps_.reserve(slots, coarse, fine)) return;
    still_.forgetMaps();
    shifted_.forgetMaps();
  }

  void renderShadowMaps(std::span<const shared::Vpl> vpls, MapSize size) override {
    shifted_.forgetMaps();
    const auto slotOf = [](const shared::Vpl& vpl) { return vpl.slot; };
    const auto tellOfOld = [&](auto& sums) {
      for (const shared::Vpl& vpl : vpls)
        if (const auto map = maps_.map(slotOf(vpl)); !map.empty())
          sums.mapChanges(slotOf(vpl), map);
    };
    tbb::parallel_invoke([&] { tellOfOld(still_.sums); }, [&] { tellOfOld(still_.sampleSums); },
                         [&] { tellOfOld(still_.speculars); });
    std::vector<ShadowMapDiff> changes(vpls.size());
    rayCount_ += maps_.render(*scene_, *rays_, vpls, size, changes);
    counts_.shadowMaps += vpls.size();
    still_.forEachSums([&](IrradianceAccumulator& sums) {
      for (size_t i = 0; i < vpls.size(); ++i) sums.mapChanged(slotOf(vpls[i]), changes[i]);
    });
  }

  void dropShadowMaps(std::span<const int> slots) override {
    for (const int slot : slots) {
      const std::span<const float> map = maps_.map(slot);
      if (map.empty()) continue;
      still_.forEachSums([&](IrradianceAccumulator& sums) { sums.mapChanges(slot, map); });
      still_.speculars.mapChanges(slot, map);
      shifted_.forgetMaps();
      maps_.drop(slot);
    }
  }

  void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
               const PatchLights* patches) override {
    const Lights lights = lightsOf(vpls, patches);
    const PictureSums::Input in = inputOf(lights, params, patches);
    PictureSums& p = shown();
    const int block = std::max(1, static_cast<int>(params.block.x));
    const bool isQuick = block != 1 && (params.block.y != 0.0f || params.block.w != 0.0f);
    const bool isNext = showsStill() && summedView_ && *summedView_ + 1 == backend_.views();
    const SeenPoints* before = isNext ? backend_.seenBefore() : nullptr;
    if (showsStill()) summedView_ = backend_.views();
    shared_ = {};
    if (showsStill()) antialiasing_.forget();
    if (block != 1 && isStillOf(in, block)) {
      if (!antialiasing_.isTaken()) antialiasing_.take(backend_.still().gbuffer, still_.diffuse());
      p.block = block;
      shared_ = antialiasing_.findOwn(backend_.still().gbuffer, in.gbuffer);
      counts_.pixelsInterpolated += still_.pixelsInterpolated();
      add(p.sumAt(in, shared_));
    } else {
      add(p.sum(in, block, params.block.y != 0.0f, mostOf(params), before));
      counts_.pixelsInterpolated += p.pixelsInterpolated();
    }
    const float roughness = leastRoughnessOf(params);
    counts_.lightPixels +=
        isQuick ? p.sampleSpeculars(in, roughness) : p.sumSpeculars(in, roughness, showsStill());
    isLong_ = block != 1 && (p.low.isLong() || vpls.size() * p.glossyPixels() > mostOf(params));
  }

  std::shared_ptr<RadianceImage> shareOf(size_t group, std::span<const shared::Vpl> vpls,
                                         const shared::ShadingParams& params,
                                         const PatchLights* patches, bool white) override {
    if (!shares_) shares_ = std::make_unique<ShareSums>();
    const Lights lights = lightsOf(vpls, patches);
    const PictureSums::Input in = inputOf(lights, params, patches);
    SumCounts counts;
    const uint64_t most = mostOf(params);
    const bool isSummed =
        showsStill() ? shares_->sumStill(group, in, std::max(1, static_cast<int>(params.block.x)),
                                         most, counts)
                     : shares_->sumShifted(group, in, backend_.still().gbuffer, most, counts);
    const uint64_t left = most - std::min(most, counts.lightPixels);
    const bool isComplete =
        isSummed && shares_->sumSpeculars(in, leastRoughnessOf(params), left, counts);
    add(counts);
    if (!isComplete) return nullptr;
    const auto image = backend_.takeImage();
    const auto lightAt = [&](int tile, int packet, PacketIrradiance&) {
      return shares_->at(tile, packet);
    };
    cpu::compose(in.gbuffer, lightAt, nullptr, white, image->image);
    if (!white) shares_->speculars().addTo(in.gbuffer, image->image, false);
    return image;
  }

  void dropShares(std::span<const vec3> weights) override {
    if (shares_ && !weights.empty() && summedView_ == backend_.views())
      still_.carried.know(shares_->total(weights));
    shares_.reset();
  }

  std::shared_ptr<RadianceImage> compose(bool white) override {
    const GBuffer& gbuffer = backend_.shown().gbuffer;
    const PictureSums& p = shown();
    const auto image = backend_.takeImage();
    const PictureLight still = still_.diffuse();
    const PictureLight light =
        shared_.empty() ? p.diffuse() : PictureLight{p.sums, nullptr, &still, shared_};
    const auto lightAt = [&](int tile, int packet, PacketIrradiance& room) {
      return light.at(tile, packet, room);
    };
    const Background background = backend_.background();
    cpu::compose(gbuffer, lightAt, &background, white, image->image);
    if (!white) p.addSpeculars(gbuffer, image->image);
    return image;
  }

  bool sumIsLimited() const override { return showsStill() && still_.isLimited(); }
  bool sumIsLong() const override { return showsStill() && isLong_; }

  std::vector<float> readShadowMap(int slot) override {
    const std::span<const float> map = maps_.map(slot);
    return {map.begin(), map.end()};
  }

  std::vector<uint8_t> readInterpolated() override {
    const PictureSums& p = shared_.empty() ? shown() : still_;
    const GBuffer& g = (shared_.empty() ? backend_.shown() : backend_.still()).gbuffer;
    if (p.block <= 1) return {};
    std::vector<uint8_t> interpolated;
    interpolated.reserve(static_cast<size_t>(g.width) * static_cast<size_t>(g.height));
    for (int y = 0; y < g.height; ++y) {
      for (int x = 0; x < g.width; ++x) {
        const size_t packet = g.index(x, y) / kLanes;
        const uint32_t edges = p.low.summed()[packet / kPacketsPerTile];
        interpolated.push_back((edges >> packet % kPacketsPerTile & 1) == 0 ? 1 : 0);
      }
    }
    return interpolated;
  }

 private:
  bool showsStill() const { return &backend_.shown() == &backend_.still(); }
  PictureSums& shown() { return showsStill() ? still_ : shifted_; }

  struct Lights {
    std::vector<LightRecord> records;
    std::vector<float> footprints;
  };
  Lights lightsOf(std::span<const shared::Vpl> vpls, const PatchLights* patches) const {
    Lights lights;
    lights.records.reserve(vpls.size());
    for (const shared::Vpl& vpl : vpls) {
      const int slot = vpl.slot;
      const int mapSlot = patches == nullptr || slot < 0 ? slot : patches->mapSlot(slot);
      lights.records.push_back(makeLightRecord(vpl, mapOf(mapSlot), maps_.resolution(mapSlot)));
      lights.records.back().mapSlot = mapSlot;
      lights.footprints.push_back(vpl.footprint.x);
    }
    return lights;
  }
  PictureSums::Input inputOf(const Lights& lights, const shared::ShadingParams& params,
                             const PatchLights* patches) const {
    const float d0 = params.clampAndBias.x;
    return {*scene_,
            backend_.shown().gbuffer,
            backend_.shown().view.eye,
            lights.records,
            lights.footprints,
            {d0 * d0, params.clampAndBias.y, 1.0f},
            patches,
            leftOutBy_};
  }
  static float leastRoughnessOf(const shared::ShadingParams& params) {
    return params.speculars.x == 0.0f ? -1.0f : params.speculars.y;
  }
  // Limit of lights × pixels.
  static uint64_t mostOf(const shared::ShadingParams& params) {
    return params.block.z > 0.0f ? static_cast<uint64_t>(params.block.z * shared::kLightPixelsUnit)
                                 : UINT64_MAX;
  }
  void add(const SumCounts& counts) {
    counts_.lookUps += counts.lookUps;
    counts_.lightPixels += counts.lightPixels;
  }

  // Whether the light of the unjittered picture is valid for these arguments.
  bool isStillOf(const PictureSums::Input& in, int block) const {
    return !showsStill() && backend_.stillIsCurrent() && still_.block == block &&
           still_.sums.isOf(backend_.still().gbuffer, in.lights, in.constants, in.patches);
  }

  // Null: the slot has no map.
  const float* mapOf(int slot) const {
    const std::span<const float> map = maps_.map(slot);
    return map.empty() ? nullptr : map.data();
  }

  CpuBackend& backend_;
  const ManyLightsTraits traits_{.tracesShadowMaps = true, .sharesNeedMiddle = true};
  ManyLightsCounts counts_;
  uint64_t rayCount_ = 0;
  const RenderScene* scene_ = nullptr;
  const RayCaster* rays_ = nullptr;
  MapStore maps_;
  PictureSums still_, shifted_;  // of the pictures of the backend
  std::unique_ptr<ShareSums> shares_;
  bool isLong_ = false;                 // of the last sum
  std::optional<uint64_t> summedView_;  // CpuBackend::views() of the last sum of the present scene
  AdaptiveAntialiasing antialiasing_;   // of still_
  std::span<const uint32_t> shared_;    // packets shown that need their own light; empty: all
  std::vector<uint32_t> leftOutBy_;     // by object, with light linking; else empty
};

}  // namespace

std::unique_ptr<ManyLightsKernels> makeManyLightsKernels(CpuBackend& backend) {
  return std::make_unique<CpuManyLights>(backend);
}

}  // namespace lamplighter::cpu
