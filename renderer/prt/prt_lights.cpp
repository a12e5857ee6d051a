#include "renderer/prt/prt_lights.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/prt/incident_light.h"
#include "renderer/prt/prt_memory.h"
#include "renderer/scene/vpl.h"
#include "renderer/visibility/hard_shadow_lights.h"

namespace lamplighter {
namespace {

constexpr double kUnit = 1.0 / 16777216.0;  // 2⁻²⁴ W/m²
// Pixels sum the lights that are nearer to an object's bounding box than this multiple of the
// spacing of its light points.
constexpr float kNear = 1.0f;

// Compares all but the slot of the map.
bool isSame(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent &&
         a.intensity == b.intensity && a.footprint.y == b.footprint.y;
}

// By slot: the light is one of the few that make hard shadows.
std::vector<bool> findHard(std::span<const shared::Vpl> bySlot) {
  std::vector<LightStrength> strengths;
  for (size_t slot = 0; slot < bySlot.size(); ++slot) {
    if (isLight(bySlot[slot]))
      strengths.push_back(strengthOf(bySlot[slot], static_cast<int>(slot)));
  }
  std::vector<bool> isHard(bySlot.size(), false);
  for (const int slot : hardLights(strengths)) isHard[static_cast<size_t>(slot)] = true;
  return isHard;
}

}  // namespace

struct PrtLights::Frame {
  const RenderScene& scene;
  const RayCaster& rays;
  const VisibilityDatabase& visibility;
  const std::vector<shared::Vpl>& bySlot;
};

// Finds the objects that need transfer, after some objects were renumbered or changed material or
// shape.
void PrtLights::findObjects(const Frame& frame, std::span<const uint32_t> others) {
  for (const uint32_t i : others) objects_[i].dropTransfer();
  const std::vector<uint32_t> come = findRoom(frame);
  tbb::parallel_for(size_t{0}, come.size(), [&](size_t k) {
    Object& o = objects_[come[k]];
    const auto space = ownSpaceOf(frame.scene.objects[come[k]]);
    o.own = std::make_shared<const RenderScene>(ownSceneOf(frame.scene, come[k], *space));
    o.key = transferKey(*o.own, options_.transfer);
    o.isWanted = true;
  });
  std::vector<Transfers::Wanted> wanted;
  for (const Object& o : objects_)
    if (o.isWanted) wanted.push_back({o.key, o.own});
  transfers_.want(std::move(wanted), options_.transfer);
  coverage_.advance();
}

// Uses the upper bounds of memory, so that the result does not depend on history. Objects that do
// not fit lose their data. Returns the objects that fit now but did not before.
std::vector<uint32_t> PrtLights::findRoom(const Frame& frame) {
  std::vector<uint32_t> candidates, come;
  std::vector<size_t> bytes;
  for (uint32_t i = 0; i < objects_.size(); ++i) {
    const PrtShape& shape = objects_[i].shape;
    if (!shape.mayHaveTransfer) continue;
    candidates.push_back(i);
    bytes.push_back(
        mostBytesOf({frame.scene.objects[i].vertexCount, static_cast<size_t>(shape.points),
                     frame.bySlot.size(), options_.mostError < 1.0f}));
  }
  const std::vector<bool> fits = fitting(bytes, options_.mostBytes);
  for (size_t k = 0; k < candidates.size(); ++k) {
    Object& o = objects_[candidates[k]];
    if (!fits[k])
      o.dropTransfer();
    else if (!o.isWanted)
      come.push_back(candidates[k]);
    o.lacksRoom = !fits[k];
  }
  return come;
}

// Returns those of the given objects whose shape changed.
std::vector<uint32_t> PrtLights::reshape(const Frame& frame, std::span<const uint32_t> some) {
  std::vector<uint8_t> isOther(some.size(), 0);
  tbb::parallel_for(size_t{0}, some.size(), [&](size_t k) {
    PrtShape shape =
        prtShapeOf(frame.scene, some[k], frame.visibility.patches(some[k]), options_.mostPoints);
    PrtShape& known = objects_[some[k]].shape;
    isOther[k] = shape == known ? 0 : 1;
    known = std::move(shape);
  });
  std::vector<uint32_t> others;
  for (size_t k = 0; k < some.size(); ++k)
    if (isOther[k] != 0) others.push_back(some[k]);
  return others;
}

// Updates the object's position and discards its light.
void PrtLights::placeObject(const Frame& frame, uint32_t object) {
  Object& o = objects_[object];
  const auto space = ownSpaceOf(frame.scene.objects[object]);
  o.space = space.value_or(OwnSpace());
  o.places.clear();
  for (const vec3& p : o.points.places)
    o.places.push_back(o.space.scale * (o.space.rotation * p) + o.space.translation);
  o.sums.assign(o.places.size() * 2 * kSums, 0.0);
  o.checked.assign(lights_.size(), {});
  o.takes.assign(lights_.size(), Take::own);
  o.held.assign(lights_.size(), 0);
  o.hidden.assign(lights_.size() * o.places.size(), 0);
  o.irradiance.assign(frame.scene.objects[object].vertexCount, vec3(0.0f));
}

PrtLights::Take PrtLights::takeOf(const Frame& frame, uint32_t object, size_t slot) const {
  const Object& o = objects_[object];
  const shared::Vpl& vpl = frame.bySlot[slot];
  if (!isLight(vpl)) return Take::own;
  if (vpl.position.w != shared::kVplDirectional) {
    const Bounds& box = frame.scene.objects[object].bounds;
    const vec3 position(vpl.position);
    const bool isOn = options_.transfer.bounces > 0 && liesOn(frame.rays, object, vpl);
    if (isOn) return Take::own;
    const float distance = glm::distance(position, glm::clamp(position, box.min, box.max));
    if (distance < kNear * o.space.scale * o.points.spacing) return Take::near;
  }
  return Take::all;
}

void PrtLights::addLight(Object& o, const shared::Vpl& vpl, Take take, size_t point, double sign) {
  const auto light = incidentLight(vpl, o.places[point], options_.clampDistance);
  if (!light) return;
  const ShVector y = shBasis(glm::transpose(o.space.rotation) * light->direction);
  double* reflected = &o.sums[point * 2 * kSums];
  double* straight = reflected + kSums;
  for (int channel = 0; channel < 3; ++channel) {
    for (size_t i = 0; i < kShCoefficients; ++i, ++reflected, ++straight) {
      const double part =
          sign * kUnit * std::round(double{y[i]} * double{light->irradiance[channel]} / kUnit);
      if (hasReflected(take)) *reflected += part;
      if (take == Take::straight) *straight += part;
      if (take == Take::reflected) *straight -= part;
    }
  }
}

// Whether object parts reflect this light onto each other.
bool PrtLights::isReflected(size_t slot) const {
  return options_.transfer.bounces > 0 && !areLast_[slot];
}

// For some slots: which light points other objects hide from the light, and the error of transfer.
PrtLights::Looked PrtLights::look(const Frame& frame, uint32_t object,
                                  std::span<const uint32_t> slots) {
  Object& o = objects_[object];
  const size_t points = o.places.size();
  const bool isChecked = options_.mostError < 1.0f;
  Looked out{std::vector<Take>(slots.size()), std::vector<uint8_t>(slots.size() * points, 0)};
  std::atomic<uint64_t> traced = 0, spared = 0;
  tbb::parallel_for(size_t{0}, slots.size(), [&](size_t i) {
    const size_t slot = slots[i];
    const shared::Vpl& vpl = frame.bySlot[slot];
    const Take take = out.takes[i] = takeOf(frame, object, slot);
    // If the database says that the object is hidden, no rays are needed.
    bool isFull = true;
    for (const int root : o.shape.looseRoots)
      if (frame.visibility.state(object, root, static_cast<int>(slot)) != Occlusion::full)
        isFull = false;
    const auto hidden = std::span(out.hidden).subspan(i * points, points);
    uint64_t rays = 0;
    if (mayTake(take) && isFull) {
      std::fill(hidden.begin(), hidden.end(), uint8_t{1});
      spared += points;
    } else if (mayTake(take)) {
      for (size_t point = 0; point < points; ++point) {
        const auto light = incidentLight(vpl, o.places[point], options_.clampDistance);
        hidden[point] = light && isHiddenByOthers(frame.rays, object, o.places[point], *light);
        if (light) ++rays;
      }
    }
    // A light that is too near says little about the light elsewhere.
    o.checked[slot] = isChecked && mayTake(take) && !isFull
                          ? checkLight(o.checks, o.space, frame.rays, vpl, o.places, hidden,
                                       options_.clampDistance, rays)
                          : LightErrors();
    traced += rays;
  });
  raysTraced_ += traced;
  raysSpared_ += spared;
  return out;
}

// Returns whether anything changed.
bool PrtLights::sumLights(const Frame& frame, uint32_t object, std::span<const uint32_t> slots) {
  Object& o = objects_[object];
  const size_t points = o.places.size();
  const Looked looked = look(frame, object, slots);

  // The target state of all lights; the visibility of the examined slots may have changed.
  constexpr size_t kKept = static_cast<size_t>(-1);
  std::vector<Take> takes = o.takes;
  std::vector<size_t> lookedAt(takes.size(), kKept);
  for (size_t i = 0; i < slots.size(); ++i) {
    takes[slots[i]] = looked.takes[i];
    lookedAt[slots[i]] = i;
  }
  std::vector<bool> mayHold(takes.size());
  for (size_t slot = 0; slot < takes.size(); ++slot)
    mayHold[slot] = mayTake(takes[slot]) && !isHard_[slot];
  const std::vector<bool> leaves = lightsToLeave(o.checked, mayHold, options_.mostError);
  for (size_t slot = 0; slot < takes.size(); ++slot)
    if (mayTake(takes[slot])) {
      const bool isHeld = mayHold[slot] && !leaves[slot];
      takes[slot] = isReflected(slot) ? (isHeld ? Take::all : Take::reflected)
                                      : (isHeld ? Take::straight : Take::left);
    }

  std::vector<size_t> touched;
  for (size_t slot = 0; slot < takes.size(); ++slot)
    if (lookedAt[slot] != kKept || takes[slot] != o.takes[slot]) touched.push_back(slot);
  std::atomic<bool> changed = false;
  tbb::parallel_for(size_t{0}, points, [&](size_t point) {
    for (const size_t slot : touched) {
      const size_t i = lookedAt[slot];
      uint8_t& hidden = o.hidden[slot * points + point];
      const uint8_t now = i == kKept ? hidden : looked.hidden[i * points + point];
      const bool isOther = i != kKept && !isSame(lights_[slot], frame.bySlot[slot]);
      const Take before = o.takes[slot], after = takes[slot];
      if (before == after && hidden == now && !(mayTake(after) && isOther)) continue;
      if (mayTake(before) && hidden == 0) addLight(o, lights_[slot], before, point, -1.0);
      hidden = now;
      const shared::Vpl& vpl = i == kKept ? lights_[slot] : frame.bySlot[slot];
      if (mayTake(after) && hidden == 0) addLight(o, vpl, after, point, 1.0);
      changed = true;
    }
  });
  o.takes = takes;
  for (size_t slot = 0; slot < takes.size(); ++slot)
    o.held[slot] = takes[slot] == Take::own || hasStraight(takes[slot]) ? 1 : 0;
  o.lightsLeft = static_cast<int>(std::count(leaves.begin(), leaves.end(), true));
  o.isLeft = o.lightsLeft > 0 && std::none_of(takes.begin(), takes.end(), hasStraight);
  o.countBytes();
  return changed;
}

void PrtLights::Object::countBytes() {
  bytes = transfer->vertices.size() *
              (sizeof(Transfer::Vertex) + sizeof(IncidentLightPoints::Blend) + sizeof(vec3)) +
          sums.size() * sizeof(double) + hidden.size();
  for (const ValidationPoint& check : checks)
    bytes += sizeof(ValidationPoint) + check.terms.size() * sizeof(ValidationPoint::Term);
  for (const LightErrors& lights : checked)
    bytes += sizeof(LightErrors) + lights.size() * sizeof(LightError);
}

void PrtLights::lightVertices(Object& o) {
  std::vector<std::array<float, 2 * kSums>> light(o.places.size());
  for (size_t p = 0; p < light.size(); ++p)
    for (size_t i = 0; i < 2 * kSums; ++i)
      light[p][i] = static_cast<float>(o.sums[p * 2 * kSums + i]);
  tbb::parallel_for(size_t{0}, o.irradiance.size(), [&](size_t v) {
    const IncidentLightPoints::Blend& blend = o.points.ofVertex[v];
    std::array<float, 2 * kSums> here{};
    for (size_t k = 0; k < IncidentLightPoints::kBlended; ++k) {
      if (!(blend.weight[k] > 0.0f)) continue;
      const std::array<float, 2 * kSums>& from = light[blend.point[k]];
      for (size_t i = 0; i < here.size(); ++i) here[i] += blend.weight[k] * from[i];
    }
    const Transfer::Vertex& t = o.transfer->vertices[v];
    vec3 e(0.0f);
    for (size_t i = 0; i < kShCoefficients; ++i) {
      const float* straight = &here[kSums + i];
      e.r += t.r[i] * here[i] + t.direct[i] * straight[0];
      e.g += t.g[i] * here[kShCoefficients + i] + t.direct[i] * straight[kShCoefficients];
      e.b += t.b[i] * here[2 * kShCoefficients + i] + t.direct[i] * straight[2 * kShCoefficients];
    }
    o.irradiance[v] = glm::max(e, 0.0f);  // the truncated series can be negative
  });
  o.revision.advance();
}

bool PrtLights::update(const RenderScene& scene, const RenderSceneChanges& changes,
                       const RayCaster& rays, const VisibilityDatabase& visibility,
                       const Lights& lights, const Options& options, bool waits) {
  scene_ = &scene;
  std::vector<shared::Vpl> bySlot(lights.vpls.begin(), lights.vpls.end());
  const Frame frame{scene, rays, visibility, bySlot};
  const bool anew = !isKnown_ || changes.rebuilt || changes.materials || !(options == options_) ||
                    bySlot.size() != lights_.size();
  options_ = options;
  std::vector<uint32_t> others;
  if (anew) {
    lights_.assign(bySlot.size(), shared::Vpl{});
    isStale_.assign(bySlot.size(), false);
    objects_ = std::vector<Object>(scene.objects.size());
    others.resize(objects_.size());
    std::iota(others.begin(), others.end(), 0u);
    reshape(frame, others);
    isKnown_ = true;
  } else {
    objects_.resize(scene.objects.size());
    others = reshape(frame, changes.movedObjects);
  }
  if (anew || !others.empty()) findObjects(frame, others);
  if (waits) transfers_.wait();

  std::vector<bool> isFresh(objects_.size(), false);
  for (uint32_t i = 0; i < objects_.size(); ++i) {
    Object& o = objects_[i];
    if (!o.isWanted || o.transfer) continue;
    o.transfer = transfers_.find(o.key);
    if (!o.transfer) continue;
    o.points = placeIncidentLightPoints(*o.own, o.shape.points);
    o.checks = placeValidationPoints(*o.own, *o.transfer, o.points, o.shape.isLoose);
    o.own.reset();
    isFresh[i] = true;
    coverage_.advance();
  }
  for (const uint32_t i : changes.rebuilt ? std::vector<uint32_t>() : changes.movedObjects)
    if (objects_[i].transfer) isFresh[i] = true;

  if (!changes.movedObjects.empty()) isStale_.assign(isStale_.size(), true);
  const std::vector<bool> wasHard = std::exchange(isHard_, findHard(bySlot));
  const std::vector<bool> wereLast = std::exchange(areLast_, lights.areLast);
  areLast_.resize(bySlot.size(), false);
  std::vector<uint32_t> all(bySlot.size()), some;
  std::iota(all.begin(), all.end(), 0u);
  for (const uint32_t slot : all) {
    const std::vector<bool>& upToDate = lights.areUpToDate;
    const bool catchesUp = isStale_[slot] && slot < upToDate.size() && upToDate[slot];
    if (catchesUp) isStale_[slot] = false;
    const bool isOther = !isSame(lights_[slot], bySlot[slot]) || slot >= wasHard.size() ||
                         wasHard[slot] != isHard_[slot] || wereLast[slot] != areLast_[slot];
    if (catchesUp || isOther) some.push_back(slot);
  }
  bool shows = anew || !others.empty();
  for (uint32_t i = 0; i < objects_.size(); ++i) {
    if (!objects_[i].transfer) continue;
    if (isFresh[i]) placeObject(frame, i);
    if (isFresh[i] || !some.empty()) {
      const bool changed = sumLights(frame, i, isFresh[i] ? all : some);
      if (!isFresh[i] && !changed) continue;
      lightVertices(objects_[i]);
      shows = true;
    }
  }
  lights_ = bySlot;
  return shows;
}

std::vector<uint8_t> PrtLights::reflecting() const {
  std::vector<uint8_t> out(objects_.size(), 0);
  for (size_t i = 0; i < out.size(); ++i)
    out[i] = options_.transfer.bounces > 0 && objects_[i].transfer ? 1 : 0;
  return out;
}

uint64_t PrtLights::raysPerLight() const {
  uint64_t rays = 0;
  for (const Object& o : objects_)
    if (o.transfer)
      rays += o.places.size() + (options_.mostError < 1.0f ? o.checks.size() : size_t{0});
  return rays;
}

PrtLights::Left PrtLights::left() const {
  Left out;
  for (const Object& o : objects_) {
    if (o.lacksRoom) ++out.withoutRoom;
    if (!o.transfer) continue;
    ++out.objects;
    if (o.isLeft)
      ++out.wholly;
    else
      out.lights += o.lightsLeft;
  }
  return out;
}

size_t PrtLights::bytes() const {
  size_t bytes = 0;
  for (const Object& o : objects_) bytes += o.bytes;
  return bytes;
}

bool PrtLights::isFront(uint32_t object, uint32_t triangle, const vec3& normal) const {
  const uint32_t* corner =
      &scene_->indices[scene_->objects[object].firstIndex + 3 * static_cast<size_t>(triangle)];
  const vec3& a = scene_->positions[corner[0]];
  return glm::dot(normal, glm::cross(scene_->positions[corner[1]] - a,
                                     scene_->positions[corner[2]] - a)) > 0.0f;
}

vec3 PrtLights::irradiance(uint32_t object, uint32_t triangle, const vec3& position) const {
  const RenderObject& o = scene_->objects[object];
  const uint32_t* corner = &scene_->indices[o.firstIndex + 3 * static_cast<size_t>(triangle)];
  const vec3& a = scene_->positions[corner[0]];
  const vec3 u = scene_->positions[corner[1]] - a, v = scene_->positions[corner[2]] - a,
             p = position - a;
  // Barycentric weights of the second and third corner by least squares.
  const float uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
  const float pu = glm::dot(p, u), pv = glm::dot(p, v), area2 = uu * vv - uv * uv;
  float second = 0.0f, third = 0.0f;
  if (area2 > 0.0f) {
    second = std::clamp((vv * pu - uv * pv) / area2, 0.0f, 1.0f);
    third = std::clamp((uu * pv - uv * pu) / area2, 0.0f, 1.0f - second);
  }
  const std::vector<vec3>& e = objects_[object].irradiance;
  return (1.0f - second - third) * e[corner[0] - o.firstVertex] +
         second * e[corner[1] - o.firstVertex] + third * e[corner[2] - o.firstVertex];
}

}  // namespace lamplighter
