#include "renderer/light_field/light_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/light_field/field_sources.h"
#include "renderer/scene/light_linking.h"

namespace lamplighter {
namespace {

// Approximate memory of a texel without its partners [bytes].
constexpr size_t kTexelBytes = 400;
// Number of triangles per texel at which lines cost as much as rays (docs/results/light_field.md:
// the bathroom has 13).
constexpr size_t kTrianglesATexel = 16;
// Distance of seeds, so that the rotations of sets with different seeds differ.
constexpr uint32_t kSeedsASet = 0x100000;

size_t directionsOf(const LightFieldOptions& options) {
  return 2 * static_cast<size_t>(options.divisions) * static_cast<size_t>(options.divisions) + 1;
}

vec4 sending(const vec3& radiance) { return {radiance, 0.0f}; }

bool changesOnlyPlaces(RenderSceneChanges changes) {
  changes.movedObjects.clear();
  return changes.none() && !changes.references;
}

}  // namespace

void LightField::takeGeometry(const RenderScene& scene, Services& services,
                              const RenderSceneChanges& changes) {
  const auto sideOf = [&] {
    const size_t bytes = directionsOf(options_) * sizeof(uint32_t) + kTexelBytes;
    return texelSideFor(scene, options_.texel, options_.memory / bytes);
  };
  const SceneTexels::Update update =
      ground_.take(scene, services, changes, sideOf, TexelOrder::zigzag);
  const TexelSet& texels = ground_.set();
  if (update.change == SceneTexels::Change::lamps) {
    lamps_.outdate(update.moves, false);
    if (options_.withLamps) {
      surface_ = FieldSurface(scene, ground_.atlases(), texels, true);
      table_.outdate();
      nextOfSets_ = 0;
      hasSources_ = isLit_ = false;
    }
  } else if (update.change == SceneTexels::Change::found) {
    const size_t before = receivers_.size();
    surface_ = FieldSurface(scene, ground_.atlases(), texels, options_.withLamps);
    findReceivers(scene);
    blocks_ = SenderBlocks(texels);
    const bool areLines = surface_.triangles().size() <= kTrianglesATexel * texels.size();
    const FieldSight sight =
        options_.sight == FieldSightChoice::automatic
            ? (areLines ? FieldSight::lines : FieldSight::rays)
            : (options_.sight == FieldSightChoice::lines ? FieldSight::lines : FieldSight::rays);
    // Whether texels have the same numbers as before.
    bool areSame = !update.isAnew && before == texels.size() && sight == sight_;
    for (uint32_t t = 0; areSame && t < before; ++t) areSame = update.moves.sameTexel[t] == t;
    sight_ = sight;
    if (update.isAnew) {
      irradiance_.clear();
      lamps_.restart();
    } else {
      irradiance_ = update.moves.carried(irradiance_);
      lamps_.outdate(update.moves, true);
    }
    if (areSame) {
      table_.outdate();
    } else {
      // The previous light is faded out while all partners are computed again.
      former_ = former_.empty() ? irradiance_ : update.moves.carried(former_);
      if (update.isAnew) former_.clear();
      table_.restart(texels.size(), texels.size() > 0 ? directions_.size() : 0);
    }
    nextOfSets_ = 0;
    hasSources_ = isLit_ = false;
  }
  if (update.change == SceneTexels::Change::found || changes.materials || changes.objects)
    albedo_ = albedoOf(scene, texels);
}

void LightField::findReceivers(const RenderScene& scene) {
  const TexelSet& texels = ground_.set();
  receivers_.resize(texels.size());
  tbb::parallel_for(size_t{0}, texels.size(), [&](size_t t) {
    const SurfaceTexel& texel = texels[t];
    const SurfaceSpot& spot = texel.spot;
    receivers_[t] = {spot.position,
                     spot.rayOrigin(),
                     spot.normal,
                     spot.geometricNormal,
                     texel.object,
                     texel.place.triangle >= scene.objects[texel.object].triangleCount(),
                     !isLeftOut(scene.objects[texel.object].leftOutBy, scene.skyLink),
                     texels.isBuried(t)};
  });
}

FieldGeometry LightField::geometryOf(const RenderScene& scene, const RayCaster& rays,
                                     const FieldDirections& directions, uint32_t set) const {
  return {scene,
          rays,
          ground_.atlases(),
          surface_,
          receivers_,
          directions,
          set,
          options_.cell * ground_.side(),
          sight_};
}

void LightField::update(const RenderScene& scene, Services& services,
                        const LightFieldOptions& options, uint64_t mostWork) {
  counts_ = {{}, 0, counts_.bytes};
  const RenderSceneChanges changes = std::exchange(unseen_, {});
  LightFieldOptions other = options;
  other.bounces = options_.bounces;
  other.sets = options_.sets;
  other.showsSky = options_.showsSky;
  other.showsBounces = options_.showsBounces;
  if (other != options_) ground_.restart();
  const LightFieldOptions former = options_;
  const bool isSame = options == options_ && changes.none() && ground_.version() > 0;
  if (isSame && isDone()) return;
  if (directions_.size() != directionsOf(options) || options.seed != options_.seed)
    directions_ = FieldDirections(options.divisions, options.seed);
  options_ = options;
  const RayCaster& rays = services.rays();
  if (!isSame) {
    lights_ = LightSet(scene, lights_);
    // While objects move, light is computed again only if lamps moved, too.
    isLit_ = isLit_ && options == former && changesOnlyPlaces(changes);
    hasSources_ = hasSources_ && !changes.sky && !changes.gains &&
                  (!options.withLamps || changesOnlyPlaces(changes));
  }
  takeGeometry(scene, services, changes);
  // A ray takes as long as some samples.
  constexpr uint64_t kSamplesARay = 8;
  counts_.lampRays = lamps_.update(scene, rays, lights_, ground_.set(), changes.movedObjects,
                                   options.seed, mostWork / kSamplesARay / 2, options.withLamps);
  isLit_ = isLit_ && !lamps_.changed();
  if (!table_.isDone() && !ground_.isStale()) {
    counts_.partners = table_.goOn(geometryOf(scene, rays, directions_, 0), mostWork);
    hasSources_ = isLit_ = false;
  }
  if (!isLit_) bounce(scene);
  if (isLit_ && table_.isDone() && changes.none()) findSets(scene, rays, mostWork);
  counts_.bytes = table_.bytes() + surface_.bytes() + lamps_.bytes() +
                  receivers_.size() * sizeof(FieldReceiver) +
                  (sourceSums_.size() + bounceSums_.size() + setSums_.size()) * sizeof(vec4);
}

vec3 LightField::skyTowards(const vec3& direction) const {
  return options_.showsSky ? skyRadiance(lights_, direction) : vec3(0.0f);
}

// Sets the radiance of texels: reflected light of lamps, of the sky, and bounced light, which is
// computed by block.
void LightField::send() {
  sent_.assign(sources_.size(), vec4(0.0f));
  tbb::parallel_for(size_t{0}, receivers_.size(), [&](size_t t) {
    vec3 light = lampLight_[t] + irradianceOf(sourceSums_[t]);
    if (!bounced_.empty()) light += bounced_[blocks_.blockOf[t]];
    sent_[t] = sending(albedo_[t] * light / kPi);
  });
}

// From scratch: light of the sky, then each bounce.
void LightField::bounce(const RenderScene& scene) {
  const std::vector<PartnerRow> rows = table_.rows();
  if (rows.empty() || receivers_.empty()) {
    isLit_ = receivers_.empty();
    return;
  }
  if (!hasSources_) {
    sources_ =
        fieldSources(scene, lights_, ground_.set(), surface_, options_.withLamps, directions_);
    sourceSums_.assign(receivers_.size(), vec4(0.0f));
    addGathered(receivers_, directions_, rows, sources_, sourceSums_);
    hasSources_ = table_.isDone();
  }
  lampLight_.resize(receivers_.size());
  lamps_.sum(lights_, lampLight_);
  bounced_.clear();
  const int bounces = options_.showsBounces ? options_.bounces : 0;
  for (int b = 1; b < bounces; ++b) {
    send();
    FieldSums sums(blocks_.texels.size(), vec4(0.0f));
    addGathered(receivers_, blocks_.texels, directions_, rows, sent_, sums);
    bounced_.resize(sums.size());
    std::ranges::transform(sums, bounced_.begin(), irradianceOf);
  }
  bounceSums_.assign(receivers_.size(), vec4(0.0f));
  if (bounces > 0) {
    send();
    addGathered(receivers_, directions_, rows, sent_, bounceSums_);
  } else {
    sent_.assign(sources_.size(), vec4(0.0f));
  }
  if (options_.showsSky)
    for (size_t k = 0; k < sent_.size(); ++k) sent_[k] += sources_[k];
  isLit_ = lamps_.isDone() && table_.isDone();
  nextOfSets_ = 0;
  setSums_.clear();
  show();
}

void LightField::show() {
  const bool hasSets = nextOfSets_ > 0 && nextOfSets_ == directionsOfSets();
  std::vector<vec3> now(receivers_.size());
  tbb::parallel_for(size_t{0}, now.size(), [&](size_t t) {
    const vec4& bounced = bounceSums_[t];
    const vec4& sky = sourceSums_[t];
    vec4 sum(0.0f, 0.0f, 0.0f, sky.w);
    if (options_.showsBounces) sum += vec4(vec3(bounced), 0.0f);
    if (options_.showsSky) sum += vec4(vec3(sky), 0.0f);
    if (hasSets) sum += setSums_[t];
    now[t] = irradianceOf(sum);
  });
  // While all partners are computed again, the previous light is faded out.
  if (table_.isFull()) former_.clear();
  if (former_.size() == now.size()) {
    const float share = table_.shareKnown();
    for (size_t t = 0; t < now.size(); ++t) now[t] = glm::mix(former_[t], now[t], share);
  }
  findReflected();
  irradiance_ = std::move(now);
  ++version_;
}

// The light of all bounces except the last is known by block. Within a block it is distributed like
// that of the last bounce, so that mirrors show no blocks.
void LightField::findReflected() {
  reflected_.assign(receivers_.size(), vec3(0.0f));
  if (!options_.showsBounces) return;
  std::vector<vec3> shares(blocks_.texels.size(), vec3(0.0f));
  for (size_t b = 0; b < bounced_.size(); ++b) {
    const vec3 last = irradianceOf(bounceSums_[blocks_.texels[b]]);
    for (int c = 0; c < 3; ++c)
      shares[b][c] = last[c] > 0.0f ? std::min(1.0f, bounced_[b][c] / last[c]) : 0.0f;
  }
  tbb::parallel_for(size_t{0}, reflected_.size(), [&](size_t t) {
    reflected_[t] = albedo_[t] * (lampLight_[t] + irradianceOf(sourceSums_[t]) +
                                  shares[blocks_.blockOf[t]] * irradianceOf(bounceSums_[t]));
  });
}

// Rotated sets of directions: each adds to the sums of all texels, so that single directions are
// not visible.
void LightField::findSets(const RenderScene& scene, const RayCaster& rays, uint64_t mostWork) {
  if (nextOfSets_ >= directionsOfSets() || receivers_.empty()) return;
  if (nextOfSets_ == 0) setSums_.assign(receivers_.size(), vec4(0.0f));
  const size_t each = directions_.size();
  const size_t drawn = sight_ == FieldSight::lines ? surface_.triangles().size() : 0;
  std::vector<LineRaster> rasters(kDirectionsATime);
  std::vector<uint32_t> partners(kDirectionsATime * receivers_.size());
  FieldDirections turned;
  PartnerRadiance sent = sent_;
  for (uint64_t work = 0; nextOfSets_ < directionsOfSets() && work < mostWork;) {
    const auto set = static_cast<uint32_t>(1 + nextOfSets_ / each);
    const size_t first = nextOfSets_ % each, end = std::min(each, first + kDirectionsATime);
    if (turned.size() == 0 || first == 0) {
      turned = FieldDirections(options_.divisions, options_.seed + kSeedsASet * set);
      if (options_.showsSky)
        std::ranges::copy(skyOf(lights_, turned),
                          sent.begin() + static_cast<ptrdiff_t>(receivers_.size()));
    }
    std::vector<PartnerTarget> targets;
    std::vector<PartnerRow> rows;
    for (size_t d = first; d < end; ++d) {
      uint32_t* row = partners.data() + (d - first) * receivers_.size();
      targets.push_back({static_cast<uint32_t>(d), row});
      rows.push_back({static_cast<uint32_t>(d), row});
    }
    const PartnerCounts found =
        findPartners(geometryOf(scene, rays, turned, set), targets, rasters);
    counts_.partners.add(found);
    work += workOf(found, drawn * rows.size());
    addGathered(receivers_, turned, rows, sent, setSums_);
    nextOfSets_ += rows.size();
  }
  if (nextOfSets_ == directionsOfSets()) show();
}

bool LightField::isDone() const {
  return ground_.isCurrent() && isLit_ && table_.isDone() && unseen_.none() &&
         (receivers_.empty() || nextOfSets_ >= directionsOfSets());
}

uint64_t LightField::samplesLeft() const {
  const auto first = static_cast<uint64_t>((1.0f - table_.shareCurrent()) *
                                           static_cast<float>(directions_.size()));
  return receivers_.size() *
         (first + directionsOfSets() - std::min(nextOfSets_, directionsOfSets()));
}

}  // namespace lamplighter
