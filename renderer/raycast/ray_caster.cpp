#include "renderer/raycast/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <embree3/rtcore.h>

#include "renderer/base/simd.h"
#include "renderer/raycast/embree_scenes.h"
#include "renderer/raycast/placed_hits.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

namespace {

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

// Keeps −1 in `valid` for those of eight ray segments that touch the box (conservative).
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

}  // namespace

struct RayCaster::Impl {
  const RenderScene& scene;
  EmbreeScenes embree;

  explicit Impl(const RenderScene& s) : scene(s), embree(s) {}

  // Whether the ray may hit a moved object: most rays do not and skip the second scene.
  bool mayMeetMovers(const Ray& ray) const {
    return embree.hasMovers() && mayTouch(ray, embree.movingBounds());
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
    if (q.seenOnly || (ofStill && embree.mustFilterStill())) q.embree.filter = passOver;
    return q;
  }

  // Returns the hit with the smallest computed distance, then the smallest object and triangle,
  // among all triangles that the ray hits at Embree's distance `t` within rounding.
  Hit leastHitAt(const Ray& ray, Surfaces which, float t) const;

  // leastHitAt() for eight rays. Lanes of `t` that are infinite are left out.
  void leastHitsAt(std::span<const Ray, 8> rays, std::span<const float, 8> t, Hit* least) const;

  // Traces eight rays in both scenes; `tFar` gets their tFar, which Embree overwrites in `r`.
  void cast8(std::span<const Ray, 8> rays, Surfaces which, RTCRayHit8& r, float* tFar) const;

  // Traces eight rays, then leastHitsAt() for them. `near`: distances of the first hits as Embree
  // has them; infinity for a miss.
  void castLeast8(std::span<const Ray, 8> rays, RTCRayHit8& r, float* near, Hit* least) const;

  // Rejects hits on objects that have moved away, and on back faces that cameras do not see. N is 1
  // or 8; valid lanes are −1.
  static void passOver(const RTCFilterFunctionNArguments* a) {
    const auto& q = *reinterpret_cast<const Query*>(a->context);
    for (unsigned int i = 0; i < a->N; ++i) {
      if (a->valid[i] != -1) continue;
      const uint32_t object = RTCHitN_geomID(a->hit, a->N, i);
      if (q.isOfStill && !q.impl->embree.isInStill(object)) {
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
  impl_->embree.build();
}

RayCaster::~RayCaster() = default;

void RayCaster::update(const RenderSceneChanges& changes) { impl_->embree.update(changes); }

Hit RayCaster::intersect(const Ray& ray, Surfaces which) const {
  RTCRayHit r{toEmbree(ray), {}};
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  Impl::Query still = impl_->query(which, true);
  rtcIntersect1(impl_->embree.still(), &still.embree, &r);
  if (impl_->mayMeetMovers({ray.origin, ray.tNear, ray.direction, r.ray.tfar})) {
    Impl::Query moving = impl_->query(which, false);
    rtcIntersect1(impl_->embree.moving(), &moving.embree, &r);
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
  rtcOccluded1(impl_->embree.still(), &still.embree, &r);
  if (!(r.tfar < 0.0f) && impl_->mayMeetMovers(ray)) {
    Impl::Query moving = impl_->query(Surfaces::all, false);
    rtcOccluded1(impl_->embree.moving(), &moving.embree, &r);
  }
  return r.tfar < 0.0f;
}

std::array<bool, 8> RayCaster::occluded8(std::span<const Ray, 8> rays) const {
  alignas(32) RTCRayHit8 r{};
  alignas(32) int valid[8];
  setRays(rays, r, valid);
  Impl::Query still = impl_->query(Surfaces::all, true, true);
  rtcOccluded8(valid, impl_->embree.still(), &still.embree, &r.ray);
  if (impl_->embree.hasMovers()) {
    for (size_t i = 0; i < 8; ++i)
      if (r.ray.tfar[i] < 0.0f) valid[i] = 0;
    keepTouching(r.ray, impl_->embree.movingBounds(), valid);
    Impl::Query moving = impl_->query(Surfaces::all, false);
    if (std::any_of(valid, valid + 8, [](int lane) { return lane != 0; }))
      rtcOccluded8(valid, impl_->embree.moving(), &moving.embree, &r.ray);
  }
  std::array<bool, 8> occluded;
  for (size_t i = 0; i < 8; ++i) occluded[i] = rays[i].tFar >= 0.0f && r.ray.tfar[i] < 0.0f;
  return occluded;
}

Hit RayCaster::Impl::leastHitAt(const Ray& ray, Surfaces which, float t) const {
  Hit least;
  for (const bool ofStill : {true, false}) {
    if (!ofStill && !embree.hasMovers()) break;
    RTCRayHit r{toEmbree(ray), {}};
    r.ray.tnear = std::max(ray.tNear, t * (1.0f - kRounding));
    r.ray.tfar = std::min(ray.tFar, t * (1.0f + kRounding));
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    Query q = query(which, ofStill);
    q.embree.filter = keepLeast;
    q.rays = &ray;
    q.least = &least;
    rtcIntersect1(ofStill ? embree.still() : embree.moving(), &q.embree, &r);
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
    if (!ofStill) keepTouching(r.ray, embree.movingBounds(), valid);
    if (std::none_of(valid, valid + 8, [](int lane) { return lane != 0; })) break;
    Query q = query(Surfaces::all, ofStill, ofStill);
    q.embree.filter = keepLeast;
    q.rays = rays.data();
    q.least = least;
    rtcIntersect8(valid, ofStill ? embree.still() : embree.moving(), &q.embree, &r);
    if (!embree.hasMovers()) break;
  }
}

void RayCaster::Impl::cast8(std::span<const Ray, 8> rays, Surfaces which, RTCRayHit8& r,
                            float* tFar) const {
  alignas(32) int valid[8];
  setRays(rays, r, valid);
  std::copy_n(r.ray.tfar, 8, tFar);
  Query ofStill = query(which, true, true);
  rtcIntersect8(valid, embree.still(), &ofStill.embree, &r);
  if (!embree.hasMovers()) return;
  keepTouching(r.ray, embree.movingBounds(), valid);
  Query ofMoving = query(which, false);
  if (std::any_of(valid, valid + 8, [](int lane) { return lane != 0; }))
    rtcIntersect8(valid, embree.moving(), &ofMoving.embree, &r);
}

void RayCaster::Impl::castLeast8(std::span<const Ray, 8> rays, RTCRayHit8& r, float* near,
                                 Hit* least) const {
  alignas(32) float tFar[8];
  cast8(rays, Surfaces::all, r, tFar);
  for (size_t i = 0; i < 8; ++i)
    near[i] = r.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                         : r.ray.tfar[i];
  std::fill_n(least, 8, Hit());
  leastHitsAt(rays, std::span<const float, 8>(near, 8), least);
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

void RayCaster::leastHits8(std::span<const Ray, 8> rays, std::span<Hit, 8> hits) const {
  alignas(32) RTCRayHit8 r{};
  float near[8];
  impl_->castLeast8(rays, r, near, hits.data());
  for (size_t i = 0; i < 8; ++i)
    if (!hits[i] && !std::isinf(near[i]))
      hits[i] = placed(impl_->scene, rays[i], r.hit.geomID[i], r.hit.primID[i]);
}

void RayCaster::distance8(std::span<const Ray, 8> rays, std::span<float, 8> distances) const {
  alignas(32) RTCRayHit8 r{};
  Hit least[8];
  impl_->castLeast8(rays, r, distances.data(), least);
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

bool isOnBack(const RenderScene& scene, const Hit& hit, const vec3& direction) {
  const uint32_t* i = &scene.indices[scene.objects[hit.object].firstIndex + 3 * hit.triangle];
  const vec3& a = scene.positions[i[0]];
  const vec3 cross = glm::cross(scene.positions[i[1]] - a, scene.positions[i[2]] - a);
  return glm::dot(cross, direction) > 0.0f;
}

}  // namespace lamplighter
