#include "renderer/sampling/choice/lamp_importance.h"

#include <algorithm>
#include <cmath>

#include "renderer/sampling/choice/point_blocks.h"
#include "renderer/sampling/direct_vpls.h"
#include "renderer/scene/vpl.h"

namespace lamplighter {
namespace {

constexpr int kTestPoints = static_cast<int>(PointVisibility::kMostPoints);
constexpr size_t kColumnsOfPoints = PointVisibility::kMostPoints;
// Up to this number of samples, all lamps keep their samples.
constexpr int kFewSamples = 32;
// Points on the surface of a lamp, and directions of the sky, for which rays are traced.
constexpr size_t kMostProbes = 2048;
constexpr size_t kProbesOfSurface = 4;
constexpr int kProbesOfSky = 16;
// Points darker than this fraction of the mean get the weight of this brightness: bounced light,
// which is not counted here, is mostly brighter.
constexpr double kDarkestLit = 0.1;
// The largest share of the light, without shadows, of a lamp that is left out.
constexpr double kMostUnshadowedShare = 1.0 / 3.0;
constexpr float kNearlyNone = 0.01f, kNearFactor = 4.0f;

}  // namespace

void LampImportance::outdate(const RenderSceneChanges& changes,
                             std::span<const MoverFinder::Mover> movers) {
  for (PointVisibility& v : visibility_) v.outdate(changes, movers);
}

std::vector<LampShare> LampImportance::of(const RenderScene& scene, const RayCaster& rays,
                                          const LightPaths& paths, const View& view,
                                          float clampDistance) {
  const std::vector<Emitter>& emitters = paths.lights().emitters();
  std::vector<size_t> wanted;
  int least = 0;
  bool isAnyOpen = false;
  for (size_t i = 0; i < emitters.size(); ++i) {
    const SampleShare share = directShareOf(scene, emitters[i], paths.counts());
    if (!(share.weight > 0.0f)) continue;
    wanted.push_back(i);
    least += share.least;
    isAnyOpen = isAnyOpen || !share.isFixed;
  }
  const bool isMany = least > kFewSamples;
  const bool mayMatter = isAnyOpen || isMany || least > directSamples(paths.counts());
  if (wanted.size() < 2 || !mayMatter) return {};
  const std::vector<SeenPoint> seen = seenPoints(scene, rays, view, kTestPoints);
  if (seen.empty()) return {};

  const std::vector<VplId> ids = emitterIds(paths.lights());
  const DirectVpls direct(scene, paths.lights(), paths.counts());
  const auto ofSurface =
      static_cast<int>(std::clamp<size_t>(kMostProbes / wanted.size(), 1, kProbesOfSurface));
  std::vector<SceneVpl> vpls;
  std::vector<Probes> probes;
  for (const size_t i : wanted) {
    const Emitter& e = emitters[i];
    const int count =
        e.kind == EmitterKind::surface ? std::max(ofSurface, e.bothSides ? 2 : 1) : kProbesOfSky;
    const size_t first = vpls.size();
    direct.add({static_cast<int>(i), ids[i]}, count, 1.0f, vpls);
    probes.push_back({i, first, vpls.size()});
  }
  const std::span<const float> irradiance =
      visibility_[0].irradiance(vpls, seen, rays, clampDistance);
  // The light of each emitter at each point, and of all.
  std::vector<double> light(probes.size() * kColumnsOfPoints, 0.0);
  std::array<double, kColumnsOfPoints> whole{};
  double mean = 0.0;
  for (size_t p = 0; p < probes.size(); ++p) {
    for (size_t v = probes[p].first; v < probes[p].end; ++v)
      for (size_t j = 0; j < seen.size(); ++j)
        light[p * kColumnsOfPoints + j] +=
            static_cast<double>(irradiance[v * kColumnsOfPoints + j]);
    for (size_t j = 0; j < seen.size(); ++j) whole[j] += light[p * kColumnsOfPoints + j];
  }
  const auto count = static_cast<double>(seen.size());
  for (const double sum : whole) mean += sum / count;
  if (!(mean > 0.0)) return {};
  for (double& sum : whole) sum = std::max(sum, kDarkestLit * mean);

  std::vector<LampShare> lamps(emitters.size());
  std::vector<Probes> dark;
  const PointBlocks at(seen);
  for (size_t p = 0; p < probes.size(); ++p) {
    double squares = 0.0, sum = 0.0;
    for (size_t j = 0; j < seen.size(); ++j) {
      const double share = light[p * kColumnsOfPoints + j] / whole[j];
      squares += share * share;
      sum += share;
    }
    lamps[probes[p].emitter] = {static_cast<float>(std::sqrt(squares / count)),
                                static_cast<float>(sum / count)};
    if (sum > 0.0 || !isMany) continue;
    alignas(32) std::array<float, kColumnsOfPoints> geometry{};
    std::array<double, kColumnsOfPoints> unshadowed{};
    for (size_t v = probes[p].first; v < probes[p].end; ++v) {
      at.geometries(vpls[v].vpl, clampDistance, 0, at.blocks(), geometry.data());
      const float brightness = luminance(vpls[v].vpl.intensity);
      for (size_t j = 0; j < seen.size(); ++j)
        unshadowed[j] += static_cast<double>(brightness * geometry[j]);
    }
    double most = 0.0;
    for (size_t j = 0; j < seen.size(); ++j) most = std::max(most, unshadowed[j] / whole[j]);
    if (most < kMostUnshadowedShare) dark.push_back(probes[p]);
  }
  leaveOut(scene, rays, view, clampDistance, vpls, std::move(dark), lamps);
  return lamps;
}

// Tests more points while there are lamps that light none.
void LampImportance::leaveOut(const RenderScene& scene, const RayCaster& rays, const View& view,
                              float clampDistance, std::span<const SceneVpl> vpls,
                              std::vector<Probes> dark, std::vector<LampShare>& lamps) {
  for (size_t test = 1; test < kTests && !dark.empty(); ++test) {
    const std::vector<SeenPoint> seen =
        seenPoints(scene, rays, view, kTestPoints, kTestPoints * static_cast<int>(test));
    if (seen.empty()) continue;
    std::vector<SceneVpl> tested;
    for (const Probes& p : dark)
      tested.insert(tested.end(), vpls.begin() + static_cast<ptrdiff_t>(p.first),
                    vpls.begin() + static_cast<ptrdiff_t>(p.end));
    const std::span<const float> irradiance =
        visibility_[test].irradiance(tested, seen, rays, clampDistance);
    size_t row = 0;
    std::erase_if(dark, [&](const Probes& p) {
      const size_t first = row;
      row += p.end - p.first;
      const auto lit =
          irradiance.subspan(first * kColumnsOfPoints, (row - first) * kColumnsOfPoints);
      return std::any_of(lit.begin(), lit.end(), [](float e) { return e > 0.0f; });
    });
  }
  for (const Probes& p : dark) lamps[p.emitter].isLeftOut = true;
}

bool isNear(std::span<const LampShare> a, std::span<const LampShare> b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const LampShare& x, const LampShare& y) {
        const auto [low, high] = std::minmax(x.importance, y.importance);
        const bool isSimilar = high < kNearFactor * low || (low > 0.0f && high < kNearlyNone);
        return x.isLeftOut == y.isLeftOut && (high == low || isSimilar);
      });
}

}  // namespace lamplighter
