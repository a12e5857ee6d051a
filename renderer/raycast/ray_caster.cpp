#include "renderer/raycast/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include <embree3/rtcore.h>

#include "renderer/base/simd.h"
#include "renderer/raycast/placed_hits.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

// An error that Embree reported. Not in the unnamed namespace, since Impl has one.
struct EmbreeError {
  RTCError code = RTC_ERROR_NONE;
  std::string text;
};

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

// Whether Embree may hit another triangle at the same edge too, due to rounding. A shared edge
// needs a bound of a few 2⁻²⁴; this one includes edges that meet without common vertices. About one
// hit in a thousand is this close to an edge.
bool isAtEdge(float u, float v) { return std::min({u, v, 1.0f - u - v}) < 0x1p-13f; }

RTCRay toEmbree(const Ray& r) {
  RTCRay e{};
  e.org_x = r.origin.x;
  e.org_y = r.origin.y;
  e.org_z = r.origin.z;
  e.tnear = r.tNear;
  e.dir_x = r.direction.x;
  e.dir_y = r.direction.y;
  e.dir_z = r.direction.z;
  e.tfar = r.tFar;
  e.mask = 0xffffffffu;
  return e;
}

// Lanes whose tFar is negative get 0 in `valid`, others −1.
void setRays(std::span<const Ray, 8> rays, RTCRayHit8& r, int (&valid)[8]) {
  for (size_t i = 0; i < 8; ++i) {
    const Ray& ray = rays[i];
    valid[i] = ray.tFar < 0.0f ? 0 : -1;
    r.ray.org_x[i] = ray.origin.x;
    r.ray.org_y[i] = ray.origin.y;
    r.ray.org_z[i] = ray.origin.z;
    r.ray.tnear[i] = ray.tNear;
    r.ray.dir_x[i] = ray.direction.x;
    r.ray.dir_y[i] = ray.direction.y;
    r.ray.dir_z[i] = ray.direction.z;
    r.ray.tfar[i] = ray.tFar;
    r.ray.mask[i] = 0xffffffffu;
    r.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
}

// Of eight ray segments, keeps −1 in `valid` for those that touch the box (conservative).
void keepTouching(const RTCRay8& r, const Bounds& box, int (&valid)[8]) {
  constexpr hn::FixedTag<float, 8> tag;
  constexpr hn::FixedTag<int32_t, 8> ints;
  // A direction almost perpendicular to an axis is replaced by a slightly less perpendicular one.
  // The test stays conservative, and there is no division by zero.
  const auto least = hn::Set(tag, 1e-30f), one = hn::Set(tag, 1.0f);
  auto from = hn::Zero(tag), to = hn::Load(tag, r.tfar);
  auto slack = from;
  const float* const origins[3] = {r.org_x, r.org_y, r.org_z};
  const float* const directions[3] = {r.dir_x, r.dir_y, r.dir_z};
  for (const float* origin : origins) slack = hn::Max(slack, hn::Abs(hn::Load(tag, origin)));
  // Like rayEpsilon().
  slack = hn::Max(hn::Mul(slack, hn::Set(tag, 0x1p-17f)), hn::Set(tag, 1e-5f));
  for (int axis = 0; axis < 3; ++axis) {
    const auto origin = hn::Load(tag, origins[axis]);
    auto way = hn::Load(tag, directions[axis]);
    way = hn::IfThenElse(hn::Lt(hn::Abs(way), least), least, way);
    const auto inverse = hn::Div(one, way);
    const auto low = hn::Sub(hn::Sub(hn::Set(tag, box.min[axis]), slack), origin),
               high = hn::Sub(hn::Add(hn::Set(tag, box.max[axis]), slack), origin);
    const auto a = hn::Mul(low, inverse), b = hn::Mul(high, inverse);
    from = hn::Max(from, hn::Min(a, b));
    to = hn::Min(to, hn::Max(a, b));
  }
  // Negated test for a certain miss, so that NaN counts as touching.
  const auto misses = hn::Gt(from, hn::MulAdd(to, hn::Set(tag, 1.0002f), slack));
  const auto all = hn::Load(ints, valid);
  hn::Store(hn::IfThenZeroElse(hn::RebindMask(ints, misses), all), ints, valid);
}

// Relative. Above the error of Embree's approximate reciprocal, which is a few 2⁻²⁴.
constexpr float kRounding = 0x1p-19f;

// Number of triangles for which the tree is built in about 10 ms, acceptable during an edit.
constexpr size_t kQuicklyBuilt = 50000;

}  // namespace

// One geometry per object, with the object's index as its id, in two Embree scenes. The first has
// one tree over all triangles, built with medium quality (surface area heuristic); it accepts
// packets flagged as coherent. The second is small: a tree of trees for the objects that moved
// since, which is updated quickly. If the first scene can be rebuilt quickly, the moved objects are
// removed from it; otherwise a filter ignores them there. The hits do not depend on the scene in
// which an object is.
//
// Embree 3.13 does not return from coherent packets in a tree of trees.
struct RayCaster::Impl {
  const RenderScene& scene;
  EmbreeError error;  // the first one since check()
  RTCDevice device = nullptr;
  RTCScene still = nullptr, moving = nullptr;
  std::vector<uint8_t> isMoving;  // by object: it is in the scene `moving`
  std::vector<uint32_t> movers;
  Bounds movingBounds;  // bounds of the movers, slightly enlarged
  struct Passing {
    bool isClear, isMasked;
    bool operator==(const Passing&) const = default;
  };
  std::vector<Passing> passing;  // by object, when the tree was built

  explicit Impl(const RenderScene& s) : scene(s) {
    // A fixed instruction set, so that rays give bit-equal results on all machines.
    device = rtcNewDevice("isa=avx2,set_affinity=0");
    if (device == nullptr)
      throw std::runtime_error("Embree cannot start: it needs a processor with AVX2");
    rtcSetDeviceErrorFunction(device, onError, &error);
  }
  ~Impl() {
    release();
    rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void release() {
    for (RTCScene* s : {&still, &moving})
      if (*s != nullptr) rtcReleaseScene(std::exchange(*s, nullptr));
  }

  void check() {
    if (error.code == RTC_ERROR_NONE) return;
    const EmbreeError e = std::exchange(error, {});
    if (e.code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error("Embree error " + std::to_string(static_cast<int>(e.code)) + ": " +
                             e.text);
  }

  void commit(RTCScene embree) {
    rtcCommitScene(embree);
    check();
  }

  Passing passingOf(uint32_t object) const {
    const Material& m = scene.materials[static_cast<size_t>(scene.objects[object].material)];
    return {m.isClear(), m.alphaMode == AlphaMode::mask};
  }

  void copyVertices(RTCGeometry geometry, const RenderObject& o) const {
    auto* to = static_cast<vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
    std::copy_n(scene.positions.begin() + o.firstVertex, o.vertexCount, to);
  }
  // Copies the indices too: a mirrored object has a different vertex order.
  void copyIndices(RTCGeometry geometry, const RenderObject& o) const {
    auto* to = static_cast<uint32_t*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_INDEX, 0));
    std::transform(scene.indices.begin() + o.firstIndex,
                   scene.indices.begin() + o.firstIndex + o.indexCount, to,
                   [&](uint32_t i) { return i - o.firstVertex; });
  }

  void add(RTCScene embree, uint32_t object) {
    if (passing[object].isClear) return;
    const RenderObject& o = scene.objects[object];
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3),
                            o.vertexCount);
    rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                            3 * sizeof(uint32_t), o.triangleCount());
    if (error.code != RTC_ERROR_NONE) {  // no memory for the buffers
      rtcReleaseGeometry(geometry);
      check();
    }
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    copyVertices(geometry, o);
    copyIndices(geometry, o);
    // The scene belongs to the FrameRenderer, which outlives this object; the filter only reads it.
    rtcSetGeometryUserData(geometry, const_cast<RenderScene*>(&scene));
    if (passing[object].isMasked) {
      rtcSetGeometryIntersectFilterFunction(geometry, alphaFilter);
      rtcSetGeometryOccludedFilterFunction(geometry, alphaFilter);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(embree, geometry, object);
    rtcReleaseGeometry(geometry);
  }

  void build() {
    release();
    still = rtcNewScene(device);
    moving = rtcNewScene(device);
    const RTCSceneFlags flags = RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
    rtcSetSceneFlags(still, flags);
    rtcSetSceneFlags(moving, flags | RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(moving, RTC_BUILD_QUALITY_LOW);
    isMoving.assign(scene.objects.size(), 0);
    movers.clear();
    movingBounds = Bounds();
    passing.clear();
    for (uint32_t i = 0; i < scene.objects.size(); ++i) passing.push_back(passingOf(i));
    for (uint32_t i = 0; i < scene.objects.size(); ++i) add(still, i);
    commit(still);
    commit(moving);
  }

  // Objects at rest return to the first scene when other objects start to move, if they are large
  // enough to slow rays down.
  bool shouldJoin(const std::vector<uint32_t>& moved) const {
    constexpr size_t kFew = 10000, kShare = 20;  // triangles; one in this many
    if (std::any_of(moved.begin(), moved.end(), [&](uint32_t i) { return isMoving[i] != 0; }))
      return false;
    size_t triangles = 0;
    for (const uint32_t i : movers) triangles += scene.objects[i].triangleCount();
    return triangles > std::max(kFew, scene.triangleCount() / kShare);
  }

  void update(const RenderSceneChanges& changes) {
    bool anew = changes.rebuilt;
    for (uint32_t i = 0; !anew && changes.materials && i < passing.size(); ++i)
      anew = passing[i] != passingOf(i);
    if (anew || shouldJoin(changes.movedObjects)) {
      build();
      return;
    }
    if (changes.movedObjects.empty()) return;
    bool hasMore = false;
    for (const uint32_t i : changes.movedObjects) {
      if (passing[i].isClear) continue;
      if (isMoving[i] == 0) {
        isMoving[i] = 1;
        movers.push_back(i);
        add(moving, i);
        hasMore = true;
        if (isQuicklyBuilt()) rtcDisableGeometry(rtcGetGeometry(still, i));
        continue;
      }
      RTCGeometry geometry = rtcGetGeometry(moving, i);
      copyVertices(geometry, scene.objects[i]);
      copyIndices(geometry, scene.objects[i]);
      rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
      rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0);
      rtcCommitGeometry(geometry);
    }
    if (hasMore && isQuicklyBuilt()) commit(still);
    commit(moving);
    movingBounds = Bounds();
    for (const uint32_t i : movers) movingBounds.add(scene.objects[i].bounds);
    const vec3 slack(rayEpsilon(movingBounds.min) + rayEpsilon(movingBounds.max));
    movingBounds.min -= slack;
    movingBounds.max += slack;
  }
  // Otherwise a filter ignores moved objects at their old position, with a cost per hit.
  bool isQuicklyBuilt() const { return scene.triangleCount() <= kQuicklyBuilt; }

  // Whether the ray may hit a moved object: most rays do not and skip the second scene.
  bool mayMeetMovers(const Ray& ray) const {
    return !movers.empty() && mayTouch(ray, movingBounds);
  }

  // A query in one of the two scenes.
  struct Query {
    RTCIntersectContext embree;
    const Impl* impl;
    bool isOfStill, seenOnly;
    const Ray* rays = nullptr;  // for keepLeast(), by lane
    Hit* least = nullptr;       // for keepLeast(), by lane
  };
  Query query(Surfaces which, bool ofStill, bool isCoherent = false) const {
    Query q{{}, this, ofStill, which == Surfaces::seen};
    rtcInitIntersectContext(&q.embree);
    if (isCoherent) q.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    if (q.seenOnly || (ofStill && !movers.empty() && !isQuicklyBuilt())) q.embree.filter = passOver;
    return q;
  }

  // Of all triangles that the ray hits at Embree's distance `t` within rounding, returns the hit
  // with the least computed distance, then the least object and triangle.
  Hit leastHitAt(const Ray& ray, Surfaces which, float t) const;

  // leastHitAt() for eight rays. Lanes of `t` that are infinite are left out.
  void leastHitsAt(std::span<const Ray, 8> rays, std::span<const float, 8> t, Hit* least) const;

  // Traces eight rays in both scenes; `tFar` gets their tFar, which Embree overwrites in `r`.
  void cast8(std::span<const Ray, 8> rays, Surfaces which, RTCRayHit8& r, float* tFar) const;

  // Rejects hits on objects that have moved away, and on back faces that cameras do not see. N is 1
  // or 8; valid lanes are −1.
  static void passOver(const RTCFilterFunctionNArguments* a) {
    const auto& q = *reinterpret_cast<const Query*>(a->context);
    for (unsigned int i = 0; i < a->N; ++i) {
      if (a->valid[i] != -1) continue;
      const uint32_t object = RTCHitN_geomID(a->hit, a->N, i);
      if (q.isOfStill && q.impl->isMoving[object] != 0) {
        a->valid[i] = 0;
        continue;
      }
      if (!q.seenOnly || !q.impl->scene.backIsUnseen(object)) continue;
      const float along = RTCHitN_Ng_x(a->hit, a->N, i) * RTCRayN_dir_x(a->ray, a->N, i) +
                          RTCHitN_Ng_y(a->hit, a->N, i) * RTCRayN_dir_y(a->ray, a->N, i) +
                          RTCHitN_Ng_z(a->hit, a->N, i) * RTCRayN_dir_z(a->ray, a->N, i);
      if (along > 0.0f) a->valid[i] = 0;
    }
  }

  // Filter of leastHitAt(), N is 1, and of leastHitsAt(), N is 8: keeps the least hit and rejects
  // every hit, so that Embree continues the traversal.
  static void keepLeast(const RTCFilterFunctionNArguments* a) {
    passOver(a);
    const auto& q = *reinterpret_cast<const Query*>(a->context);
    const auto key = [](const Hit& h) { return std::tuple(h.t, h.object, h.triangle); };
    for (unsigned int i = 0; i < a->N; ++i) {
      if (a->valid[i] != -1) continue;
      a->valid[i] = 0;
      const Hit hit = placed(q.impl->scene, q.rays[i], RTCHitN_geomID(a->hit, a->N, i),
                             RTCHitN_primID(a->hit, a->N, i));
      if (key(hit) < key(q.least[i])) q.least[i] = hit;
    }
  }
};

RayCaster::RayCaster(const RenderScene& scene) : impl_(std::make_unique<Impl>(scene)) {
  impl_->build();
}

RayCaster::~RayCaster() = default;

void RayCaster::update(const RenderSceneChanges& changes) { impl_->update(changes); }

Hit RayCaster::intersect(const Ray& ray, Surfaces which) const {
  RTCRayHit r{toEmbree(ray), {}};
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  Impl::Query still = impl_->query(which, true);
  rtcIntersect1(impl_->still, &still.embree, &r);
  if (impl_->mayMeetMovers({ray.origin, ray.tNear, ray.direction, r.ray.tfar})) {
    Impl::Query moving = impl_->query(which, false);
    rtcIntersect1(impl_->moving, &moving.embree, &r);
  }
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  if (isAtEdge(r.hit.u, r.hit.v)) {
    if (const Hit least = impl_->leastHitAt(ray, which, r.ray.tfar)) return least;
  }
  return placed(impl_->scene, ray, r.hit.geomID, r.hit.primID);
}

bool RayCaster::occluded(const Ray& ray) const {
  RTCRay r = toEmbree(ray);
  Impl::Query still = impl_->query(Surfaces::all, true);
  rtcOccluded1(impl_->still, &still.embree, &r);
  if (!(r.tfar < 0.0f) && impl_->mayMeetMovers(ray)) {
    Impl::Query moving = impl_->query(Surfaces::all, false);
    rtcOccluded1(impl_->moving, &moving.embree, &r);
  }
  return r.tfar < 0.0f;
}

Hit RayCaster::Impl::leastHitAt(const Ray& ray, Surfaces which, float t) const {
  Hit least;
  for (const bool ofStill : {true, false}) {
    if (!ofStill && movers.empty()) break;
    RTCRayHit r{toEmbree(ray), {}};
    r.ray.tnear = std::max(ray.tNear, t * (1.0f - kRounding));
    r.ray.tfar = std::min(ray.tFar, t * (1.0f + kRounding));
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    Query q = query(which, ofStill);
    q.embree.filter = keepLeast;
    q.rays = &ray;
    q.least = &least;
    rtcIntersect1(ofStill ? still : moving, &q.embree, &r);
  }
  return least;
}

void RayCaster::Impl::leastHitsAt(std::span<const Ray, 8> rays, std::span<const float, 8> t,
                                  Hit* least) const {
  alignas(32) RTCRayHit8 r{};
  alignas(32) int valid[8];
  setRays(rays, r, valid);
  for (size_t i = 0; i < 8; ++i) {
    if (std::isinf(t[i])) valid[i] = 0;
    r.ray.tnear[i] = std::max(rays[i].tNear, t[i] * (1.0f - kRounding));
    r.ray.tfar[i] = std::min(rays[i].tFar, t[i] * (1.0f + kRounding));
  }
  for (const bool ofStill : {true, false}) {
    if (!ofStill) keepTouching(r.ray, movingBounds, valid);
    if (std::none_of(valid, valid + 8, [](int lane) { return lane != 0; })) break;
    Query q = query(Surfaces::all, ofStill, ofStill);
    q.embree.filter = keepLeast;
    q.rays = rays.data();
    q.least = least;
    rtcIntersect8(valid, ofStill ? still : moving, &q.embree, &r);
    if (movers.empty()) break;
  }
}

void RayCaster::Impl::cast8(std::span<const Ray, 8> rays, Surfaces which, RTCRayHit8& r,
                            float* tFar) const {
  alignas(32) int valid[8];
  setRays(rays, r, valid);
  std::copy_n(r.ray.tfar, 8, tFar);
  Query ofStill = query(which, true, true);
  rtcIntersect8(valid, still, &ofStill.embree, &r);
  if (movers.empty()) return;
  keepTouching(r.ray, movingBounds, valid);
  Query ofMoving = query(which, false);
  if (std::any_of(valid, valid + 8, [](int lane) { return lane != 0; }))
    rtcIntersect8(valid, moving, &ofMoving.embree, &r);
}

void RayCaster::intersect8(std::span<const Ray, 8> rays, std::span<Hit, 8> hits,
                           Surfaces which) const {
  alignas(32) RTCRayHit8 r{};
  alignas(32) float tFar[8];
  impl_->cast8(rays, which, r, tFar);
  PlacedLanes at;
  placeLanes(impl_->scene, r, tFar, at);
  for (size_t i = 0; i < 8; ++i) {
    hits[i] = Hit();
    if (r.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    if (isAtEdge(r.hit.u[i], r.hit.v[i]))
      hits[i] = impl_->leastHitAt(rays[i], which, r.ray.tfar[i]);
    if (!hits[i]) hits[i] = {at.t[i], r.hit.geomID[i], r.hit.primID[i], at.u[i], at.v[i]};
  }
}

void RayCaster::distance8(std::span<const Ray, 8> rays, std::span<float, 8> distances) const {
  alignas(32) RTCRayHit8 r{};
  alignas(32) float tFar[8];
  impl_->cast8(rays, Surfaces::all, r, tFar);
  for (size_t i = 0; i < 8; ++i)
    distances[i] = r.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                       ? std::numeric_limits<float>::infinity()
                       : r.ray.tfar[i];
  Hit least[8];
  impl_->leastHitsAt(rays, distances, least);
  for (size_t i = 0; i < 8; ++i)
    if (least[i]) distances[i] = least[i].t;
}

bool mayTouch(const Ray& ray, const Bounds& box) {
  if (box.empty()) return false;
  float from = 0.0f, to = ray.tFar;
  const float slack = rayEpsilon(ray.origin);
  for (int i = 0; i < 3; ++i) {
    const float low = box.min[i] - slack - ray.origin[i], high = box.max[i] + slack - ray.origin[i];
    if (ray.direction[i] == 0.0f) {
      if (low > 0.0f || high < 0.0f) return false;
      continue;
    }
    const float a = low / ray.direction[i], b = high / ray.direction[i];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b) * 1.0001f);
  }
  return from <= to * 1.0001f + slack;
}

float rayEpsilon(const vec3& p) {
  // Coordinates have a relative error of 2⁻²⁴; transforms, barycentrics and the intersection add
  // tens of such errors. The minimum is a hundredth of a millimetre, for points near the origin.
  const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return std::max(1e-5f, largest * 0x1p-17f);
}

}  // namespace lamplighter
