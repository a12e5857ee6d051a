#include "renderer/light_maps/light_maps.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <numeric>

#include <tbb/parallel_for.h>

#include "renderer/light_maps/accumulate.h"

namespace lamplighter {
namespace {

constexpr size_t kLanes = 8;      // of accumulate()
constexpr int kMostTexels = 33;   // a side
constexpr float kFlat = 0.9999f;  // cos 0.8°
// Between texels n texels from a light, interpolation is wrong by up to 1/n².
constexpr float kNearTexels = 10.0f;
// A patch that begins so many texels behind a light, at a wall that meets its own, is before it.
constexpr float kBehindTexels = 0.05f;
constexpr float kBrightest = 2048.0f;  // W/m²: 65536 such lights still fit the sums

bool isLight(const shared::Vpl& vpl) { return vec3(vpl.normal) != vec3(0.0f); }

// All that a contribution depends on.
bool sameContribution(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent &&
         vec3(a.intensity) == vec3(b.intensity);
}

// Its surface shades as its plane does: neither smooth normals nor a normal texture, nor bumps.
bool isShadedFlat(const RenderScene& s, const Chart& chart) {
  if (chart.isRough) return false;
  const RenderObject& o = s.objects[chart.object];
  if (s.materials[static_cast<size_t>(o.material)].normalTexture.texture != kNone) return false;
  return std::all_of(chart.triangles.begin(), chart.triangles.end(), [&](uint32_t t) {
    for (uint32_t c = 0; c < 3; ++c) {
      const vec3& n = s.normals[s.indices[o.firstIndex + 3 * t + c]];
      const float length = glm::length(n);
      if (length > 0.0f && std::abs(glm::dot(n, chart.normal)) < kFlat * length) return false;
    }
    return true;
  });
}

// Where a tile's patch is.
struct TilePlace {
  const Chart& chart;
  const Patch& patch;
  float spacing;  // of its texels [m]
  vec3 corners[4];

  TilePlace(const Chart& c, const Patch& p, float texelSpacing)
      : chart(c),
        patch(p),
        spacing(texelSpacing),
        corners{c.at(p.min), c.at({p.max.x, p.min.y}), c.at(p.max), c.at({p.min.x, p.max.y})} {}
};

// Whether the light's plane crosses the patch: there is none of its light behind it, and before it
// it grows from nothing, which texels on both sides would round off.
bool isCrossed(const shared::Vpl& vpl, const TilePlace& tile) {
  const vec3 position(vpl.position), normal(vpl.normal);
  float least = std::numeric_limits<float>::infinity(), most = -least;
  for (const vec3& corner : tile.corners) {
    const float height = glm::dot(corner - position, normal);
    least = std::min(least, height);
    most = std::max(most, height);
  }
  return least < -kBehindTexels * tile.spacing && most > kBehindTexels * tile.spacing;
}

// Whether its light is smooth enough over the patch to be interpolated, and not too bright to be
// summed.
bool isMappable(const shared::Vpl& vpl, const TilePlace& tile, float clampDistance) {
  const float brightest = std::max({vpl.intensity.r, vpl.intensity.g, vpl.intensity.b});
  const vec3 position(vpl.position), normal(vpl.normal), tangent(vpl.tangent);
  if (vpl.position.w == shared::kVplDirectional) {
    const vec3 bitangent = glm::cross(normal, tangent);
    vec2 least(std::numeric_limits<float>::infinity()), most(-least);
    for (const vec3& corner : tile.corners) {
      const vec3 v = corner - position;
      const vec2 q(glm::dot(v, tangent), glm::dot(v, bitangent));
      least = glm::min(least, q);
      most = glm::max(most, q);
    }
    const float inner = 0.999f * vpl.tangent.w, outer = 1.001f * vpl.tangent.w;
    const bool isWithin = least.x > -inner && least.y > -inner && most.x < inner && most.y < inner;
    const bool isOutside = least.x > outer || least.y > outer || most.x < -outer || most.y < -outer;
    return brightest <= kBrightest && (isWithin || isOutside);
  }
  const bool isSpot = vpl.position.w == shared::kVplUniform && vpl.normal.w != 0.0f;
  if (isSpot) return false;  // its edge may fall between two texels
  if (isCrossed(vpl, tile)) return false;
  const vec2 p = tile.chart.project(position);
  const vec2 off = p - glm::clamp(p, tile.patch.min, tile.patch.max);
  const float height = glm::dot(position - tile.chart.origin, tile.chart.normal);
  const float distance2 = glm::dot(off, off) + height * height;
  const float bounded = vpl.position.w == shared::kVplCosine
                            ? std::max(distance2, clampDistance * clampDistance)
                            : distance2;
  const float nearest = kNearTexels * tile.spacing;
  return distance2 >= nearest * nearest && brightest <= kBrightest * bounded;
}

// Texels of a tile, with those behind the last that are there for whole vectors.
size_t paddedCount(const LightMapTile& tile) {
  return (static_cast<size_t>(tile.columns * tile.rows) + kLanes - 1) / kLanes * kLanes;
}

float spacingOf(const LightMapTile& tile, const Patch& patch) {
  const vec2 size = patch.max - patch.min;
  return std::max(size.x / static_cast<float>(tile.columns - 1),
                  size.y / static_cast<float>(tile.rows - 1));
}

}  // namespace

LightMaps::Object LightMaps::makeObject(const RenderScene& scene, const ObjectPatches& patches,
                                        float texel) {
  Object out;
  out.tileOfPatch.assign(patches.patches.size(), kNone);
  std::vector<bool> flat(patches.charts.size());
  for (size_t i = 0; i < flat.size(); ++i) flat[i] = isShadedFlat(scene, patches.charts[i]);
  const auto texelsAlong = [&](float length) {
    const float steps = std::ceil(std::min(length / texel, static_cast<float>(kMostTexels)));
    return std::clamp(static_cast<int>(steps) + 1, 2, kMostTexels);
  };
  uint32_t texels = 0;
  for (size_t p = 0; p < patches.patches.size(); ++p) {
    const Patch& patch = patches.patches[p];
    if (!patch.isLeaf() || patch.chart == kNone || !flat[static_cast<size_t>(patch.chart)])
      continue;
    const vec2 size = patch.max - patch.min;
    const LightMapTile tile{static_cast<int>(p), texels, texelsAlong(size.x), texelsAlong(size.y)};
    out.tileOfPatch[p] = static_cast<int>(out.tiles.size());
    out.tiles.push_back(tile);
    texels += static_cast<uint32_t>(paddedCount(tile));
  }
  for (auto* v : {&out.x, &out.y, &out.z}) v->assign(texels, 0.0f);
  for (const LightMapTile& tile : out.tiles) {
    const Patch& patch = patches.patches[static_cast<size_t>(tile.patch)];
    const Chart& chart = patches.charts[static_cast<size_t>(patch.chart)];
    const vec2 steps(static_cast<float>(tile.columns - 1), static_cast<float>(tile.rows - 1));
    size_t i = tile.first;
    for (int row = 0; row < tile.rows; ++row) {
      for (int column = 0; column < tile.columns; ++column, ++i) {
        const vec2 share = vec2(static_cast<float>(column), static_cast<float>(row)) / steps;
        const vec3 p = chart.at(glm::mix(patch.min, patch.max, share));
        out.x[i] = p.x;
        out.y[i] = p.y;
        out.z[i] = p.z;
      }
    }
    // Those behind the last are like it, so that all lie in the patch.
    for (; i < tile.first + paddedCount(tile); ++i) {
      out.x[i] = out.x[i - 1];
      out.y[i] = out.y[i - 1];
      out.z[i] = out.z[i - 1];
    }
  }
  out.sums.assign(size_t{3} * texels, 0.0);
  out.irradiance.assign(texels, vec4(0.0f));
  return out;
}

void LightMaps::resize(size_t slots) {
  const size_t words = (slots + 63) / 64;
  if (words <= words_) return;
  for (Object& o : objects_) {
    std::vector<uint64_t> wider(o.tiles.size() * words, 0);
    for (size_t t = 0; words_ > 0 && t < o.tiles.size(); ++t)
      std::copy_n(&o.held[t * words_], words_, &wider[t * words]);
    o.held = std::move(wider);
  }
  words_ = words;
}

void LightMaps::update(const RenderScene& scene, const VisibilityDatabase& visibility,
                       std::span<const shared::Vpl> given, const Options& options) {
  // Slots that are no longer given are empty.
  std::vector<shared::Vpl> bySlot(given.begin(), given.end());
  bySlot.resize(std::max(bySlot.size(), lights_.size()));
  if (!(options == options_)) objects_.clear();
  options_ = options;
  std::vector<Object> objects(scene.objects.size());
  std::vector<uint32_t> fresh;
  for (uint32_t i = 0; i < objects.size(); ++i) {
    const int from = visibility.cameFrom()[i];
    if (from != kNone && static_cast<size_t>(from) < objects_.size()) {
      objects[i] = std::move(objects_[static_cast<size_t>(from)]);
    } else {
      fresh.push_back(i);
    }
  }
  objects_ = std::move(objects);
  resize(bySlot.size());
  tbb::parallel_for(size_t{0}, fresh.size(), [&](size_t i) {
    Object& o = objects_[fresh[i]];
    o = makeObject(scene, visibility.patches(fresh[i]), options.texel);
    o.held.assign(o.tiles.size() * words_, 0);
  });
  std::vector<bool> isFresh(objects_.size(), false);
  for (const uint32_t i : fresh) isFresh[i] = true;
  std::vector<uint32_t> changedObjects = fresh;

  lights_.resize(bySlot.size());
  std::vector<uint32_t> changedSlots, allSlots(bySlot.size());
  std::iota(allSlots.begin(), allSlots.end(), 0u);
  std::vector<bool> isNew(bySlot.size(), false);
  for (uint32_t i = 0; i < bySlot.size(); ++i) {
    if (sameContribution(lights_[i], bySlot[i])) continue;
    isNew[i] = true;
    changedSlots.push_back(i);
  }

  struct Job {
    uint32_t object, tile;
    bool everySlot;
  };
  std::vector<Job> jobs;
  for (uint32_t object = 0; object < objects_.size(); ++object) {
    const Object& o = objects_[object];
    for (uint32_t t = 0; t < o.tiles.size(); ++t) {
      const bool every = isFresh[object] || visibility.rowChanged(object, o.tiles[t].patch);
      if (every || !changedSlots.empty()) jobs.push_back({object, t, every});
    }
  }
  std::vector<TexelLight> taken, added;  // by slot
  if (!jobs.empty()) {
    for (const shared::Vpl& vpl : lights_) taken.emplace_back(vpl, -1.0f);
    for (const shared::Vpl& vpl : bySlot) added.emplace_back(vpl, 1.0f);
  }
  std::atomic<uint64_t> written = 0;
  std::vector<uint8_t> wrote(jobs.size(), 0);
  tbb::parallel_for(size_t{0}, jobs.size(), [&](size_t j) {
    const Job& job = jobs[j];
    Object& o = objects_[job.object];
    const LightMapTile& tile = o.tiles[job.tile];
    const ObjectPatches& patches = visibility.patches(job.object);
    const Patch& patch = patches.patches[static_cast<size_t>(tile.patch)];
    const Chart& chart = patches.charts[static_cast<size_t>(patch.chart)];
    const auto states = visibility.row(job.object, tile.patch);  // of those given
    const TilePlace place(chart, patch, spacingOf(tile, patch));
    const size_t count = paddedCount(tile);
    const TexelPlaces places{{&o.x[tile.first], count},
                             {&o.y[tile.first], count},
                             {&o.z[tile.first], count},
                             chart.normal};
    double* sums = &o.sums[size_t{3} * tile.first];
    std::vector<const TexelLight*> changes;
    for (const uint32_t slot : job.everySlot ? allSlots : changedSlots) {
      uint64_t& word = o.held[job.tile * words_ + slot / 64];
      const uint64_t bit = uint64_t{1} << slot % 64;
      const bool has = (word & bit) != 0;
      // What is held and the same is as mappable as it was.
      const bool wants =
          isLight(bySlot[slot]) && static_cast<Occlusion>(states[slot]) != Occlusion::full &&
          ((has && !isNew[slot]) || isMappable(bySlot[slot], place, options.clampDistance));
      if (has && (!wants || isNew[slot])) changes.push_back(&taken[slot]);
      if (wants && (!has || isNew[slot])) changes.push_back(&added[slot]);
      word = wants ? word | bit : word & ~bit;
    }
    if (changes.empty()) return;
    accumulate(changes, places, options.clampDistance, sums, sums + count, sums + 2 * count);
    written += changes.size() * count;
    wrote[j] = 1;
    for (size_t i = 0; i < count; ++i)
      o.irradiance[tile.first + i] = vec4(sums[i], sums[count + i], sums[2 * count + i], 0.0);
  });
  written_ += written;
  for (size_t j = 0; j < jobs.size(); ++j)
    if (wrote[j] != 0 && (changedObjects.empty() || changedObjects.back() != jobs[j].object))
      changedObjects.push_back(jobs[j].object);
  for (const uint32_t i : changedObjects) objects_[i].revision.advance();
  lights_.assign(given.begin(), given.end());
}

LightMaps::Sampler::Sampler(const LightMaps& maps, const ObjectPatches& patches, uint32_t object,
                            int leaf)
    : chart_(
          patches.charts[static_cast<size_t>(patches.patches[static_cast<size_t>(leaf)].chart)]) {
  const Patch& patch = patches.patches[static_cast<size_t>(leaf)];
  const LightMapTile& tile = *maps.tile(object, leaf);
  min_ = patch.min;
  size_ = patch.max - patch.min;
  last_ = vec2(static_cast<float>(tile.columns - 1), static_cast<float>(tile.rows - 1));
  columns_ = tile.columns;
  texels_ = &maps.objects_[object].irradiance[tile.first];
}

size_t LightMaps::texels() const {
  size_t n = 0;
  for (const Object& o : objects_) n += o.irradiance.size();
  return n;
}

uint64_t LightMaps::bytes() const {
  uint64_t n = 0;
  for (const Object& o : objects_)
    n += o.irradiance.size() * (sizeof(vec4) + 3 * sizeof(double) + 3 * sizeof(float)) +
         o.held.size() * sizeof(uint64_t);
  return n;
}

// FNV-1a over the words.
uint64_t LightMaps::hash() const {
  uint64_t hash = 14695981039346656037u;
  for (const Object& o : objects_) {
    for (const double sum : o.sums) {
      uint64_t bits;
      std::memcpy(&bits, &sum, sizeof bits);
      hash = (hash ^ bits) * 1099511628211u;
    }
  }
  return hash;
}

}  // namespace lamplighter
