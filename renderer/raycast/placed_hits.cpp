#include "renderer/raycast/placed_hits.h"

#include "renderer/base/simd.h"
#include "renderer/raycast/triangle_hit.h"

namespace lamplighter {

namespace {

const uint32_t* cornersOf(const RenderScene& scene, uint32_t object, uint32_t triangle) {
  return &scene.indices[scene.objects[object].firstIndex + 3 * triangle];
}

// Calls take(lane, corners) with the three vertex indices of the triangle that each lane hit. A
// lane without a hit gets those of the previous lane, or null.
template <typename Take>
void forEachLane(const RenderScene& scene, const RTCRayHit8& r, const Take& take) {
  const uint32_t* corners = nullptr;
  uint32_t object = RTC_INVALID_GEOMETRY_ID, triangle = 0;
  for (size_t lane = 0; lane < 8; ++lane) {
    if (r.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID &&
        (r.hit.primID[lane] != triangle || r.hit.geomID[lane] != object)) {
      object = r.hit.geomID[lane];
      triangle = r.hit.primID[lane];
      corners = cornersOf(scene, object, triangle);
    }
    take(lane, corners);
  }
}

// Eight points or directions, one per lane.
struct Lanes3 {
  alignas(32) float x[8], y[8], z[8];
  void set(size_t lane, const vec3& v) {
    x[lane] = v.x;
    y[lane] = v.y;
    z[lane] = v.z;
  }
};
SimdVec3<Floats8> load(const float* x, const float* y, const float* z) {
  constexpr FloatTag tag;
  return {hn::Load(tag, x), hn::Load(tag, y), hn::Load(tag, z)};
}
SimdVec3<Floats8> load(const Lanes3& v) { return load(v.x, v.y, v.z); }

}  // namespace

Hit placed(const RenderScene& scene, const Ray& ray, uint32_t object, uint32_t triangle) {
  const uint32_t* i = cornersOf(scene, object, triangle);
  const TriangleHit at =
      triangleHit(ray.origin, ray.direction, ray.tNear, ray.tFar, scene.positions[i[0]],
                  scene.positions[i[1]], scene.positions[i[2]]);
  return {at.t, object, triangle, at.u, at.v};
}

void placeLanes(const RenderScene& scene, const RTCRayHit8& r, const float* tFar,
                PlacedLanes& out) {
  constexpr FloatTag tag;
  Lanes3 corner[3];
  forEachLane(scene, r, [&](size_t lane, const uint32_t* corners) {
    for (int i = 0; i < 3; ++i)
      corner[i].set(lane, corners != nullptr ? scene.positions[corners[i]] : vec3(0.0f));
  });
  const auto direction = load(r.ray.dir_x, r.ray.dir_y, r.ray.dir_z);
  const auto a = load(corner[0]), ab = load(corner[1]) - a, ac = load(corner[2]) - a;
  const auto oa = a - load(r.ray.org_x, r.ray.org_y, r.ray.org_z);
  // Bit-equal to triangleHit().
  const auto normal = cross(ab, ac), side = cross(oa, direction);
  const auto along = dotUnfused(direction, normal);
  const auto zero = hn::Zero(tag), one = hn::Set(tag, 1.0f);
  const auto nearest = hn::Load(tag, r.ray.tnear);
  const auto inPlane = hn::Eq(along, zero);
  const auto inverse = hn::Div(one, along);
  const auto u = hn::Min(hn::Max(hn::Mul(dotUnfused(side, ac), inverse), zero), one);
  const auto v =
      hn::Min(hn::Max(hn::Mul(hn::Neg(dotUnfused(side, ab)), inverse), zero), hn::Sub(one, u));
  const auto t =
      hn::Min(hn::Max(hn::Mul(dotUnfused(oa, normal), inverse), nearest), hn::Load(tag, tFar));
  hn::Store(hn::IfThenZeroElse(inPlane, u), tag, out.u);
  hn::Store(hn::IfThenZeroElse(inPlane, v), tag, out.v);
  hn::Store(hn::IfThenElse(inPlane, nearest, t), tag, out.t);
}

}  // namespace lamplighter
