#include "renderer/light_field/light_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Memory of a texel besides its partners, about [bytes].
constexpr size_t kTexelBytes = 400;
// Lines cost as much as rays where a texel has so many triangles (README).
constexpr size_t kTrianglesATexel = 32;
// Places of a direction's part of the sphere at which the sky is taken.
constexpr uint32_t kSkyPlaces = 32;
constexpr uint32_t kSkyPlaceSet = 0x51ce;
// Seeds of the turns of sets with different seeds do not meet.
constexpr uint32_t kSeedsASet = 0x100000;

size_t directionsOf(const LightFieldOptions& options) {
  return 2 * static_cast<size_t>(options.divisions) * static_cast<size_t>(options.divisions) + 1;
}

vec4 sending(const vec3& radiance) { return {radiance, 0.0f}; }

// Of the places of an area light: the mean over some points of each.
std::vector<vec4> emissionOfLamp(const RenderScene& scene, uint32_t object) {
  constexpr uint32_t kPoints = 1024, kLeastPoints = 16, kPointSet = 0x1a3b;
  const RenderObject& o = scene.objects[object];
  std::vector<vec4> sums(FieldSurface::kLampPlaces, vec4(0.0f));
  const Material& material = scene.materials[static_cast<size_t>(o.material)];
  if (material.emissiveTexture.texture == kNone) {
    const vec4 even = sending(surfaceAt(scene, object, 0, 0.0f, 0.0f).emission);
    return std::vector<vec4>(FieldSurface::kLampPlaces, even);
  }
  const uint32_t points = std::max(kLeastPoints, kPoints / std::max(o.triangleCount(), 1u));
  for (uint32_t t = 0; t < o.triangleCount(); ++t) {
    const uint32_t* i = &scene.indices[o.firstIndex + 3 * t];
    for (uint32_t k = 0; k < points; ++k) {
      vec2 w = sobol2(k, kPointSet + t);  // weights of the second and third corner
      if (w.x + w.y > 1.0f) w = 1.0f - w;
      const vec2 uv =
          (1.0f - w.x - w.y) * scene.uv0[i[0]] + w.x * scene.uv0[i[1]] + w.y * scene.uv0[i[2]];
      const glm::ivec2 at = glm::clamp(glm::ivec2(static_cast<float>(FieldSurface::kLampSide) * uv),
                                       0, FieldSurface::kLampSide - 1);
      sums[static_cast<size_t>(at.y * FieldSurface::kLampSide + at.x)] +=
          vec4(surfaceAt(scene, object, t, w.x, w.y).emission, 1.0f);
    }
  }
  for (vec4& sum : sums) sum = sum.w > 0.0f ? sending(vec3(sum) / sum.w) : vec4(0.0f);
  return sums;
}

// Mean over the area of a texel of an emissive surface.
vec3 emissionOf(const RenderScene& scene, const SurfaceTexel& texel) {
  const uint32_t triangles = scene.objects[texel.object].triangleCount();
  vec3 sum(0.0f);
  for (const SurfacePlace& place : texel.spread) {
    const bool isBack = place.triangle >= triangles;
    const Surface s =
        surfaceAt(scene, texel.object, place.triangle - (isBack ? triangles : 0), place.u, place.v);
    if (!isBack || s.emitsBothSides) sum += s.emission;
  }
  return sum / static_cast<float>(texel.spread.size());
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
    // Texels have the numbers of before.
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
      // The light of before fades while partners are found from nothing.
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
  const bool isSame = options == options_ && changes.none() && ground_.version() > 0;
  if (isSame && isDone()) return;
  if (directions_.size() != directionsOf(options) || options.seed != options_.seed)
    directions_ = FieldDirections(options.divisions, options.seed);
  options_ = options;
  const RayCaster& rays = services.rays();
  if (!isSame) {
    lights_ = LightSet(scene, lights_);
    isLit_ = false;
    hasSources_ = hasSources_ && !changes.sky && !changes.gains && !options.withLamps;
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

// What the sky sends from the part of the sphere of each direction, without its suns; then of the
// opposite ones [W/(m² sr)].
std::vector<vec4> LightField::skyOf(const FieldDirections& directions) const {
  std::vector<vec4> out(2 * directions.size(), vec4(0.0f));
  if (skyBrightness() == vec3(0.0f)) return out;
  tbb::parallel_for(size_t{0}, out.size(), [&](size_t end) {
    const size_t d = end % directions.size();
    const float radius = std::sqrt(directions.weightOf(d) / kPi);
    const Frame frame(end == d ? directions[d] : -directions[d]);
    vec3 sum(0.0f);
    for (uint32_t k = 0; k < kSkyPlaces; ++k) {
      const vec2 u = sobol2(k, kSkyPlaceSet);
      const float far = radius * std::sqrt(u.x), turn = 2.0f * kPi * u.y;
      const vec3 at =
          glm::normalize(frame.toWorld({far * std::cos(turn), far * std::sin(turn), 1.0f}));
      sum += lights_.referenceSky().withoutSuns(at) / lights_.skyReference();
    }
    out[end] = sending(skyBrightness() * sum / static_cast<float>(kSkyPlaces));
  });
  return out;
}

vec3 LightField::skyBrightness() const {
  if (lights_.unitSky().isBlack()) return vec3(0.0f);
  for (const Emitter& e : lights_.emitters())
    if (e.kind == EmitterKind::sky && e.skySun == 0) return e.brightness();
  return vec3(0.0f);
}

vec3 LightField::skyTowards(const vec3& direction) const {
  if (!options_.showsSky || skyBrightness() == vec3(0.0f)) return vec3(0.0f);
  return skyBrightness() * lights_.referenceSky().withoutSuns(direction) / lights_.skyReference();
}

// What is sent without a bounce.
void LightField::findSources(const RenderScene& scene) {
  sources_.assign(receivers_.size(), vec4(0.0f));
  const std::vector<vec4> sky = skyOf(directions_);
  sources_.insert(sources_.end(), sky.begin(), sky.end());
  sources_.emplace_back(0.0f);  // PartnerNumbers::dark()
  if (!options_.withLamps) return;
  for (const uint32_t object : surface_.lamps()) {
    const std::vector<vec4> lamp = emissionOfLamp(scene, object);
    sources_.insert(sources_.end(), lamp.begin(), lamp.end());
  }
  for (const Emitter& e : lights_.emitters()) {
    if (e.kind != EmitterKind::surface || scene.objects[e.object].isAreaLight) continue;
    for (const size_t side : {2 * e.object, 2 * e.object + 1}) {
      const TexelSet::Part& part = ground_.set().parts()[side];
      for (uint32_t t = part.first; t < part.first + part.count; ++t)
        sources_[t] = sending(emissionOf(scene, ground_.set()[t]));
    }
  }
}

// Sets what texels send: what they reflect of the light of lamps, of the sky and of bounced light,
// which is found by block.
void LightField::send() {
  sent_.assign(sources_.size(), vec4(0.0f));
  tbb::parallel_for(size_t{0}, receivers_.size(), [&](size_t t) {
    vec3 light = lampLight_[t] + irradianceOf(sourceSums_[t]);
    if (!bounced_.empty()) light += bounced_[blocks_.blockOf[t]];
    sent_[t] = sending(albedo_[t] * light / kPi);
  });
}

// From nothing: light of the sky, then each bounce.
void LightField::bounce(const RenderScene& scene) {
  const std::vector<PartnerRow> rows = table_.rows();
  if (rows.empty() || receivers_.empty()) {
    isLit_ = receivers_.empty();
    return;
  }
  if (!hasSources_) {
    findSources(scene);
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
  // While partners are found from nothing, the light of before fades.
  if (table_.isFull()) former_.clear();
  if (former_.size() == now.size()) {
    const float share = table_.shareKnown();
    for (size_t t = 0; t < now.size(); ++t) now[t] = glm::mix(former_[t], now[t], share);
  }
  findReflected();
  irradiance_ = std::move(now);
  ++version_;
}

// The light of all bounces but the last is known by block. Within a block it is spread like that of
// the last, so that mirrors show no blocks.
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

// Turned sets of directions: each adds to the sums of all texels, so that none shows its
// directions.
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
        std::ranges::copy(skyOf(turned), sent.begin() + static_cast<ptrdiff_t>(receivers_.size()));
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

float LightField::progress() const {
  const auto all = static_cast<float>(directions_.size() + directionsOfSets());
  const float first = table_.shareCurrent() * static_cast<float>(directions_.size());
  return all > 0.0f ? (first + static_cast<float>(nextOfSets_)) / all : 1.0f;
}

uint64_t LightField::samplesLeft() const {
  const auto first = static_cast<uint64_t>((1.0f - table_.shareCurrent()) *
                                           static_cast<float>(directions_.size()));
  return receivers_.size() *
         (first + directionsOfSets() - std::min(nextOfSets_, directionsOfSets()));
}

}  // namespace lamplighter
