#include "renderer/raycast/embree_scenes.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

#include "renderer/raycast/placed_hits.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

namespace {

// Stores the first error for RayCaster::Impl::check(): exceptions must not pass through Embree.
void onError(void* first, RTCError code, const char* message) {
  auto& error = *static_cast<EmbreeError*>(first);
  if (error.code == RTC_ERROR_NONE) error = {code, message != nullptr ? message : ""};
}

// Rejects hits in holes of the alpha mask. N is 1 or 8; valid lanes are −1.
void alphaFilter(const RTCFilterFunctionNArguments* a) {
  const auto& scene = *static_cast<const RenderScene*>(a->geometryUserPtr);
  for (unsigned int i = 0; i < a->N; ++i) {
    if (a->valid[i] != -1) continue;
    const uint32_t object = RTCHitN_geomID(a->hit, a->N, i);
    const uint32_t triangle = RTCHitN_primID(a->hit, a->N, i);
    const Ray ray{{RTCRayN_org_x(a->ray, a->N, i), RTCRayN_org_y(a->ray, a->N, i),
                   RTCRayN_org_z(a->ray, a->N, i)},
                  0.0f,
                  {RTCRayN_dir_x(a->ray, a->N, i), RTCRayN_dir_y(a->ray, a->N, i),
                   RTCRayN_dir_z(a->ray, a->N, i)}};
    const Hit at = placed(scene, ray, object, triangle);
    const float alpha = alphaAt(scene, object, triangle, at.u, at.v);
    if (alpha < scene.materials[scene.objects[object].material].alphaCutoff) a->valid[i] = 0;
  }
}

// Number of triangles for which the tree is built in about 10 ms, acceptable during an edit.
constexpr size_t kQuicklyBuilt = 50000;

}  // namespace

EmbreeScenes::EmbreeScenes(const RenderScene& scene) : scene_(scene) {
  // A fixed instruction set, so that rays give bit-equal results on all machines.
  device_ = rtcNewDevice("isa=avx2,set_affinity=0");
  if (device_ == nullptr)
    throw std::runtime_error("Embree cannot start: it needs a processor with AVX2");
  rtcSetDeviceErrorFunction(device_, onError, &error_);
}
EmbreeScenes::~EmbreeScenes() {
  release();
  rtcReleaseDevice(device_);
}

void EmbreeScenes::release() {
  for (RTCScene* s : {&still_, &moving_})
    if (*s != nullptr) rtcReleaseScene(std::exchange(*s, nullptr));
}

void EmbreeScenes::check() {
  if (error_.code == RTC_ERROR_NONE) return;
  const EmbreeError e = std::exchange(error_, {});
  if (e.code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw std::runtime_error("Embree error " + std::to_string(static_cast<int>(e.code)) + ": " +
                           e.text);
}

void EmbreeScenes::commit(RTCScene embree) {
  rtcCommitScene(embree);
  check();
}

EmbreeScenes::Passing EmbreeScenes::passingOf(uint32_t object) const {
  if (scene_.objects[object].isEmpty()) return {};
  const Material& m = scene_.materials[static_cast<size_t>(scene_.objects[object].material)];
  return {true, m.isClear(), m.alphaMode == AlphaMode::mask};
}

void EmbreeScenes::copyVertices(RTCGeometry geometry, const RenderObject& o) const {
  auto* to = static_cast<vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
  std::copy_n(scene_.positions.begin() + o.firstVertex, o.vertexCount, to);
}

// Copies the indices too: a mirrored object has a different vertex order.
void EmbreeScenes::copyIndices(RTCGeometry geometry, const RenderObject& o) const {
  auto* to = static_cast<uint32_t*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_INDEX, 0));
  std::transform(scene_.indices.begin() + o.firstIndex,
                 scene_.indices.begin() + o.firstIndex + o.indexCount, to,
                 [&](uint32_t i) { return i - o.firstVertex; });
}

void EmbreeScenes::add(RTCScene embree, uint32_t object) {
  const RenderObject& o = scene_.objects[object];
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3),
                          o.vertexCount);
  rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                          3 * sizeof(uint32_t), o.triangleCount());
  if (error_.code != RTC_ERROR_NONE) {  // no memory for the buffers
    rtcReleaseGeometry(geometry);
    check();
  }
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  copyVertices(geometry, o);
  copyIndices(geometry, o);
  // The scene belongs to the FrameRenderer, which outlives this object; the filter only reads it.
  rtcSetGeometryUserData(geometry, const_cast<RenderScene*>(&scene_));
  if (passing_[object].isMasked) {
    rtcSetGeometryIntersectFilterFunction(geometry, alphaFilter);
    rtcSetGeometryOccludedFilterFunction(geometry, alphaFilter);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree, geometry, object);
  rtcReleaseGeometry(geometry);
}

void EmbreeScenes::build() {
  release();
  still_ = rtcNewScene(device_);
  moving_ = rtcNewScene(device_);
  const RTCSceneFlags flags = RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
  rtcSetSceneFlags(still_, flags);
  rtcSetSceneFlags(moving_, flags | RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(moving_, RTC_BUILD_QUALITY_LOW);
  places_.assign(scene_.objects.size(), Place::nowhere);
  inStill_.assign(scene_.objects.size(), InStill::no);
  movers_.clear();
  toIgnore_ = 0;
  isQuicklyBuilt_ = scene_.triangleCount() <= kQuicklyBuilt;
  movingBounds_ = Bounds();
  passing_.clear();
  for (uint32_t i = 0; i < scene_.objects.size(); ++i) passing_.push_back(passingOf(i));
  for (uint32_t i = 0; i < scene_.objects.size(); ++i) {
    if (!mayHit(i)) continue;
    add(still_, i);
    places_[i] = Place::inStill;
    inStill_[i] = inStillAs(i);
  }
  commit(still_);
  commit(moving_);
}

// Objects at rest return to the first scene when other objects start to move, if they are large
// enough to slow rays down.
bool EmbreeScenes::shouldJoin(const std::vector<uint32_t>& moved) const {
  constexpr size_t kFew = 10000, kShare = 20;  // triangles; one in this many
  if (std::any_of(moved.begin(), moved.end(),
                  [&](uint32_t i) { return i < places_.size() && places_[i] == Place::inMoving; }))
    return false;
  size_t triangles = 0;
  for (const uint32_t i : movers_) triangles += scene_.objects[i].triangleCount();
  return triangles > std::max(kFew, scene_.triangleCount() / kShare);
}

void EmbreeScenes::update(const RenderSceneChanges& changes) {
  bool anew = changes.rebuilt;
  for (uint32_t i = 0; !anew && changes.materials && i < passing_.size(); ++i)
    anew = passing_[i].isThere && passingOf(i).isThere && passing_[i] != passingOf(i);
  if (anew || shouldJoin(changes.movedObjects)) {
    build();
    return;
  }
  if (changes.movedObjects.empty()) return;
  places_.resize(scene_.objects.size(), Place::nowhere);
  inStill_.resize(scene_.objects.size(), InStill::no);
  passing_.resize(scene_.objects.size());
  bool stillChanged = false;
  for (const uint32_t i : changes.movedObjects) stillChanged |= move(i);
  if (stillChanged && isQuicklyBuilt_) commit(still_);
  commit(moving_);
  movingBounds_ = Bounds();
  for (const uint32_t i : movers_) movingBounds_.add(scene_.objects[i].bounds);
  const vec3 slack(rayEpsilon(movingBounds_.min) + rayEpsilon(movingBounds_.max));
  movingBounds_.min -= slack;
  movingBounds_.max += slack;
}

// Updates the trees for one object that moved, came or went. Returns whether objects of `still_`
// came or went.
bool EmbreeScenes::move(uint32_t object) {
  const Place before = places_[object];
  passing_[object] = passingOf(object);
  if (!mayHit(object)) {
    places_[object] = Place::nowhere;
    if (before == Place::inMoving) {
      rtcDetachGeometry(moving_, object);
      std::erase(movers_, object);
    }
    if (before == Place::inStill) leave(object);
    return before == Place::inStill;
  }
  if (before == Place::inMoving) {
    RTCGeometry geometry = rtcGetGeometry(moving_, object);
    copyVertices(geometry, scene_.objects[object]);
    copyIndices(geometry, scene_.objects[object]);
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0);
    rtcCommitGeometry(geometry);
    return false;
  }
  if (before == Place::nowhere && isAsInStill(object)) {
    places_[object] = Place::inStill;
    --toIgnore_;
    if (isQuicklyBuilt_) rtcEnableGeometry(rtcGetGeometry(still_, object));
    return true;
  }
  places_[object] = Place::inMoving;
  movers_.push_back(object);
  add(moving_, object);
  if (before == Place::inStill) leave(object);
  return before == Place::inStill;
}

void EmbreeScenes::leave(uint32_t object) {
  ++toIgnore_;
  if (isQuicklyBuilt_) rtcDisableGeometry(rtcGetGeometry(still_, object));
}

// Whether an object that comes back is where `still_` has it.
bool EmbreeScenes::isAsInStill(uint32_t object) const {
  if (inStill_[object] != inStillAs(object)) return false;
  const RenderObject& o = scene_.objects[object];
  RTCGeometry geometry = rtcGetGeometry(still_, object);
  const auto* vertices =
      static_cast<const vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
  const auto* indices =
      static_cast<const uint32_t*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_INDEX, 0));
  return std::equal(vertices, vertices + o.vertexCount, scene_.positions.begin() + o.firstVertex) &&
         std::equal(indices, indices + o.indexCount, scene_.indices.begin() + o.firstIndex,
                    [&](uint32_t a, uint32_t b) { return a == b - o.firstVertex; });
}

}  // namespace lamplighter
