#include "renderer/sampling/vpl_footprints.h"

#include <algorithm>
#include <map>
#include <vector>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

constexpr size_t kNeighbours = 8;
constexpr size_t kMostCompared = 512;

struct Sample {
  vec3 position;
  float brightness;
};

Sample sampleOf(const shared::Vpl& vpl) {
  return {vec3(vpl.position), std::max({vpl.intensity.r, vpl.intensity.g, vpl.intensity.b})};
}

// every: the number of VPLs that each of the others represents.
float sharedArea(const Sample& at, std::span<const Sample> others, float every, float mostRadius) {
  struct Near {
    float d2, brightness;
    bool operator<(const Near& o) const { return d2 < o.d2; }
  };
  std::vector<Near> near;
  near.reserve(others.size());
  for (const Sample& s : others) {
    const vec3 d = s.position - at.position;
    const float d2 = glm::dot(d, d);
    if (d2 > 0.0f) near.push_back({d2, s.brightness});  // skips itself
  }
  if (near.empty() || !(at.brightness > 0.0f)) return kPi * mostRadius * mostRadius;
  const size_t count = std::min(kNeighbours, near.size());
  std::nth_element(near.begin(), near.begin() + static_cast<ptrdiff_t>(count - 1), near.end());
  float brightness = at.brightness;
  for (size_t i = 0; i < count; ++i) brightness += every * near[i].brightness;
  return kPi * near[count - 1].d2 * at.brightness / brightness;
}

}  // namespace

void findFootprints(const LightSet& lights, std::span<SceneVpl> vpls) {
  std::map<VplId, float> skyAngle;  // by set: solid angle [sr] of the sky
  std::map<NodeId, uint32_t> emittersOfNode;
  for (const Emitter& e : lights.emitters()) {
    const VplId id{e.node, emittersOfNode[e.node]++, 0, 0};
    if (e.kind == EmitterKind::sky) skyAngle[id] = 4.0f * kPi;
  }
  std::map<VplId, int> countOfSet;
  std::vector<Sample> bounced;
  for (const SceneVpl& v : vpls) {
    ++countOfSet[v.id.set()];
    if (v.id.bounce > 0) bounced.push_back(sampleOf(v.vpl));
  }
  const size_t every = (bounced.size() + kMostCompared - 1) / kMostCompared;
  std::vector<Sample> compared;
  for (size_t i = 0; i < bounced.size(); i += every) compared.push_back(bounced[i]);

  tbb::parallel_for(size_t{0}, vpls.size(), [&](size_t i) {
    SceneVpl& v = vpls[i];
    v.vpl.footprint.x = 0.0f;
    if (v.id.bounce > 0) {
      v.vpl.footprint.x =
          sharedArea(sampleOf(v.vpl), compared, static_cast<float>(every), lights.sceneRadius());
    } else if (v.area > 0.0f) {
      v.vpl.footprint.x = v.area;
    } else if (const auto it = skyAngle.find(v.id.set()); it != skyAngle.end()) {
      v.vpl.footprint.x = it->second / static_cast<float>(countOfSet.at(v.id.set()));
    }
  });
}

}  // namespace lamplighter
