#include "renderer/light_maps/light_proxies.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <tbb/parallel_for.h>

#include "renderer/scene/vpl.h"

namespace lamplighter {
namespace {

// Slots are added in steps of this size, because a change of their number needs a new sum.
constexpr size_t kStep = 64;

// Groups are the VPLs in a cell of a grid. Number of grids, and the cell size of the coarsest one
// [m].
constexpr int kGrids = 7;
constexpr float kCoarsest = 2.0f;
// A patch is far from a group if the group's radius is at most this share of its distance. The
// error of the distances of the VPLs is then of second order, because the proxy is near their
// centre.
constexpr float kFar = 0.3f;
// The same for lobes, relative to their width: the group covers less than half of a lobe.
constexpr float kFarForLobes = 0.5f;
// Smallest cosine between the normals of the VPLs of a group.
constexpr float kSameWay = 0.95f;
// The brightness of a light is clamped to this multiple of the median brightness.
constexpr float kMostOfMedian = 4.0f;

// Dissimilarity of two lights as shadow casters: the squared distance between them, plus, if their
// directions differ, between points one metre away along these directions [m²]. Lights of different
// kinds never match.
float unlikeness(const shared::Vpl& a, const shared::Vpl& b) {
  if (a.position.w != b.position.w) return std::numeric_limits<float>::max();
  const vec3 way = vec3(a.position) - vec3(b.position);
  const float turned = 1.0f - glm::dot(vec3(a.normal), vec3(b.normal));
  return glm::dot(way, way) + turned * turned;
}

// Key of the cell in grid `grid` (0 is the coarsest). Its bit fields are disjoint and below bit 62.
uint64_t cellOf(const shared::Vpl& v, int grid) {
  const float size = std::ldexp(kCoarsest, -grid);
  const auto along = [&](float x) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(x / size)) & 0x1ffff);
  };
  return static_cast<uint64_t>(grid) << 58 | static_cast<uint64_t>(v.position.w) << 54 |
         sideOf(vec3(v.normal)) << 51 | along(v.position.x) << 34 | along(v.position.y) << 17 |
         along(v.position.z);
}

// A point slightly above the light's surface, so that the surface does not hide others from it [m].
vec3 over(const shared::Vpl& v) { return vec3(v.position) + 0.01f * vec3(v.normal); }

// The total light without directional light. A few lights that are far brighter than most, for
// example on sunlit ground outside, count less, because they are no reason to neglect the others
// where they do not reach.
float allLight(std::span<const shared::Vpl> lights) {
  std::vector<float> each;
  for (const shared::Vpl& v : lights)
    if (v.position.w != shared::kVplDirectional) each.push_back(brightness(v));
  if (each.empty()) return 0.0f;
  std::sort(each.begin(), each.end());
  const float most = kMostOfMedian * each[each.size() / 2];
  float all = 0.0f;
  for (const float b : each) all += std::min(b, most);
  return all;
}

constexpr uint64_t kIsOfOne = uint64_t{1} << 62;

bool sameBits(std::span<const shared::Vpl> a, std::span<const shared::Vpl> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

}  // namespace

// Assigns the numbers of the proxies.
struct LightProxies::Numbers {
  std::map<uint64_t, int> before, now;
  std::vector<bool> isTaken;
  size_t free = 0;

  explicit Numbers(std::map<uint64_t, int> last) : before(std::move(last)) {
    int most = 0;
    for (const auto& [key, number] : before) most = std::max(most, number + 1);
    // Renumbers occasionally, so that a few proxies do not keep large numbers.
    if (static_cast<size_t>(most) > 4 * before.size() + kStep) before.clear();
    isTaken.assign(static_cast<size_t>(most), false);
    for (const auto& [key, number] : before) isTaken[static_cast<size_t>(number)] = true;
  }
  int take(uint64_t key) {
    const auto it = before.find(key);
    if (it != before.end()) return now[key] = it->second;
    while (free < isTaken.size() && isTaken[free]) ++free;
    if (free == isTaken.size()) isTaken.push_back(false);
    isTaken[free] = true;
    return now[key] = static_cast<int>(free);
  }
};

void LightProxies::update(const LightSampleTable& table, const Groups& groups) {
  std::vector<shared::Vpl> shown = table.summedInOrder();
  const size_t slots = table.slots();
  const bool seeOthers = groups.sceneChanged && groups.share > 0.0f;
  if (!seeOthers && slots == slots_ && table.hasMap == hasMap_ && table.needsMap == needsMap_ &&
      groups.share == groupShare_ && sameBits(shown, shown_))
    return;
  shown_ = std::move(shown);
  slots_ = slots;
  hasMap_ = table.hasMap;
  needsMap_ = table.needsMap;
  groupShare_ = groups.share;
  lights_.clear();
  groups_.clear();
  members_.clear();
  proxy_.assign(slots, -1);
  std::fill(mapSlots_.begin(), mapSlots_.end(), 0);
  std::fill(isGroup_.begin(), isGroup_.end(), uint8_t{0});
  Numbers numbers(std::move(numberOf_));
  addSingleProxies(numbers);
  if (groups.share > 0.0f) addGroupProxies(numbers, groups);
  numberOf_ = std::move(numbers.now);
  int most = 0;
  for (const auto& [key, number] : numberOf_) most = std::max(most, number + 1);
  room_ = (static_cast<size_t>(most) + kStep - 1) / kStep * kStep;
  mapSlots_.resize(room_, 0);
  isGroup_.resize(room_, 0);
}

void LightProxies::add(Numbers& numbers, uint64_t key, const shared::Vpl& at, const vec3& intensity,
                       bool isGroup) {
  const auto number = static_cast<size_t>(numbers.take(key));
  if (number >= mapSlots_.size()) {
    mapSlots_.resize(number + 1, 0);
    isGroup_.resize(number + 1, 0);
  }
  mapSlots_[number] = at.slot;
  isGroup_[number] = isGroup ? 1 : 0;
  shared::Vpl& vpl = lights_.emplace_back(at);
  vpl.intensity = intensity;
  vpl.slot = static_cast<int>(slots_ + number);
}

void LightProxies::addSingleProxies(Numbers& numbers) {
  std::vector<const shared::Vpl*> without, with;
  for (const shared::Vpl& vpl : shown_) {
    const auto slot = static_cast<size_t>(vpl.slot);
    if (hasMap_[slot] != 0)
      with.push_back(&vpl);
    else if (needsMap_[slot] != 0)
      without.push_back(&vpl);
  }
  std::vector<const shared::Vpl*> nearest(without.size(), nullptr);
  tbb::parallel_for(size_t{0}, without.size(), [&](size_t i) {
    float least = std::numeric_limits<float>::max();
    for (const shared::Vpl* vpl : with) {
      const float d = unlikeness(*without[i], *vpl);
      if (d >= least) continue;
      least = d;
      nearest[i] = vpl;
    }
  });
  for (size_t i = 0; i < without.size(); ++i) {
    if (nearest[i] == nullptr) continue;
    const auto slot = static_cast<size_t>(without[i]->slot);
    add(numbers, kIsOfOne | slot, *nearest[i], without[i]->intensity, false);
    lights_.back().footprint = without[i]->footprint;
    proxy_[slot] = lights_.back().slot;
  }
}

// Groups by cells of finer and finer grids; a group must not be too bright for one shadow.
void LightProxies::addGroupProxies(Numbers& numbers, const Groups& groups) {
  const float most = groups.share * allLight(shown_);
  std::vector<const shared::Vpl*> lights;  // candidates for groups
  for (const shared::Vpl& v : shown_) {
    if (v.position.w == shared::kVplDirectional || 2.0f * brightness(v) > most) continue;
    if (hasMap_[static_cast<size_t>(v.slot)] != 0) lights.push_back(&v);
  }
  std::vector<std::pair<uint64_t, uint32_t>> cells(lights.size());
  for (int grid = 0; grid < kGrids; ++grid) {
    for (uint32_t i = 0; i < lights.size(); ++i) cells[i] = {cellOf(*lights[i], grid), i};
    std::sort(cells.begin(), cells.end());
    for (size_t first = 0, last = 0; first < cells.size(); first = last) {
      float bright = 0.0f, footprint = 0.0f;
      vec3 middle(0.0f), intensity(0.0f);
      for (last = first; last < cells.size() && cells[last].first == cells[first].first; ++last) {
        const shared::Vpl& v = *lights[cells[last].second];
        bright += brightness(v);
        middle += brightness(v) * vec3(v.position);
        intensity += v.intensity;
        footprint += v.footprint.x;
      }
      if (last - first < 2 || !(bright > 0.0f) || bright > most) continue;
      middle /= bright;
      const shared::Vpl* at = nullptr;
      for (size_t i = first; i < last; ++i) {
        const shared::Vpl& v = *lights[cells[i].second];
        if (at == nullptr ||
            glm::distance(vec3(v.position), middle) < glm::distance(vec3(at->position), middle))
          at = &v;
      }
      Group group{0, vec3(at->position), 0.0f, members_.size(), last - first};
      bool areAlike = true;
      for (size_t i = first; i < last; ++i) {
        const shared::Vpl& v = *lights[cells[i].second];
        group.radius = std::max(group.radius, glm::distance(vec3(v.position), group.place));
        areAlike = areAlike && glm::dot(vec3(v.normal), vec3(at->normal)) >= kSameWay &&
                   v.normal.w == at->normal.w && v.tangent.w == at->tangent.w;
      }
      for (size_t i = first; i < last && areAlike && groups.sees; ++i) {
        const shared::Vpl& v = *lights[cells[i].second];
        areAlike = &v == at || groups.sees(over(v), over(*at));
      }
      if (!areAlike) continue;
      for (size_t i = first; i < last; ++i) members_.push_back(lights[cells[i].second]->slot);
      add(numbers, cells[first].first, *at, intensity, true);
      lights_.back().footprint.x = footprint;
      group.slot = lights_.back().slot;
      groups_.push_back(group);
    }
  }
}

void LightProxies::apply(const vec3& centre, float radius, const Lobes* lobes,
                         std::span<ShadowMode> bySlot, const std::vector<int>* only) const {
  std::fill(bySlot.begin() + static_cast<ptrdiff_t>(slots_), bySlot.end(), ShadowMode::skip);
  for (size_t k = 0; k < (only != nullptr ? only->size() : slots_); ++k) {
    const size_t i = only != nullptr ? static_cast<size_t>((*only)[k]) : k;
    if (hasMap_[i] != 0 || !readsShadowMap(bySlot[i])) continue;
    if (proxy_[i] >= 0) bySlot[static_cast<size_t>(proxy_[i])] = bySlot[i];
    bySlot[i] = ShadowMode::skip;
  }
  const float far = lobes == nullptr ? kFar : std::min(kFar, kFarForLobes * lobes->alpha);
  for (const Group& group : groups_) {
    const int* members = &members_[group.first];
    const ShadowMode use = bySlot[static_cast<size_t>(members[0])];
    // Unshadowed irradiance is in the light maps.
    if (lobes == nullptr ? !readsShadowMap(use) : use == ShadowMode::skip) continue;
    if (group.radius > far * (glm::distance(group.place, centre) - radius)) continue;
    if (!std::all_of(members + 1, members + group.count,
                     [&](int slot) { return bySlot[static_cast<size_t>(slot)] == use; }))
      continue;
    for (size_t i = 0; i < group.count; ++i)
      bySlot[static_cast<size_t>(members[i])] = ShadowMode::skip;
    bySlot[static_cast<size_t>(group.slot)] = use;
  }
}

}  // namespace lamplighter
