#include "renderer/raycast/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <embree3/rtcore.h>

#include "renderer/scene/surface.h"

namespace lamplighter {

namespace {

// Keeps the first error, for RayCaster::Impl::check(): nothing may be thrown through Embree itself.
void onError(void* first, RTCError code, const char* message) {
  auto& text = *static_cast<std::string*>(first);
  if (text.empty())
    text = "Embree error " + std::to_string(static_cast<int>(code)) + ": " +
           (message != nullptr ? message : "");
}

// Leaves out hits where the alpha mask has a hole. N is 1 or 8; valid lanes are −1.
void alphaFilter(const RTCFilterFunctionNArguments* a) {
  const auto& scene = *static_cast<const RenderScene*>(a->geometryUserPtr);
  for (unsigned int i = 0; i < a->N; ++i) {
    if (a->valid[i] != -1) continue;
    const uint32_t object = RTCHitN_geomID(a->hit, a->N, i);
    const float alpha = alphaAt(scene, object, RTCHitN_primID(a->hit, a->N, i),
                                RTCHitN_u(a->hit, a->N, i), RTCHitN_v(a->hit, a->N, i));
    if (alpha < scene.materials[scene.objects[object].material].alphaCutoff) a->valid[i] = 0;
  }
}

// Leaves out back faces that no camera sees. N is 1 or 8; valid lanes are −1.
void backFaceFilter(const RTCFilterFunctionNArguments* a) {
  const auto& scene = *static_cast<const RenderScene*>(a->geometryUserPtr);
  for (unsigned int i = 0; i < a->N; ++i) {
    if (a->valid[i] != -1 || !scene.backIsUnseen(RTCHitN_geomID(a->hit, a->N, i))) continue;
    const float along = RTCHitN_Ng_x(a->hit, a->N, i) * RTCRayN_dir_x(a->ray, a->N, i) +
                        RTCHitN_Ng_y(a->hit, a->N, i) * RTCRayN_dir_y(a->ray, a->N, i) +
                        RTCHitN_Ng_z(a->hit, a->N, i) * RTCRayN_dir_z(a->ray, a->N, i);
    if (along > 0.0f) a->valid[i] = 0;
  }
}

RTCIntersectContext contextFor(Surfaces which) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (which == Surfaces::seen) context.filter = backFaceFilter;
  return context;
}

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

}  // namespace

// One geometry an object, with the object's number as its id, in one scene without instances. At
// low build quality Embree keeps a tree a geometry and one above them all, so that a moved object
// costs its own tree and the upper one; rays cost the same within what could be measured
// (tests/bench/raycast_bench.cpp). The trees of the geometries are built at medium quality, by the
// surface area heuristic, and always anew: what a ray hits does not depend on where things were.
struct RayCaster::Impl {
  const RenderScene& scene;
  std::string error;  // the first that Embree reported
  RTCDevice device = nullptr;
  RTCScene embree = nullptr;

  explicit Impl(const RenderScene& s) : scene(s) {
    // One instruction set on every machine, so that rays give the same bits on all of them.
    device = rtcNewDevice("isa=avx2,set_affinity=0");
    if (device == nullptr)
      throw std::runtime_error("Embree cannot start: it needs a processor with AVX2");
    rtcSetDeviceErrorFunction(device, onError, &error);
  }
  ~Impl() {
    if (embree != nullptr) rtcReleaseScene(embree);
    rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void commit() {
    rtcCommitScene(embree);
    if (!error.empty()) throw std::runtime_error(std::exchange(error, {}));
  }

  const Material& materialOf(uint32_t object) const {
    return scene.materials[scene.objects[object].material];
  }

  void copyVertices(RTCGeometry geometry, const RenderObject& o) const {
    auto* to = static_cast<vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
    std::copy_n(scene.positions.begin() + o.firstVertex, o.vertexCount, to);
  }
  // Indices too: a mirrored object has its corners in another order.
  void copyIndices(RTCGeometry geometry, const RenderObject& o) const {
    auto* to = static_cast<uint32_t*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_INDEX, 0));
    std::transform(scene.indices.begin() + o.firstIndex,
                   scene.indices.begin() + o.firstIndex + o.indexCount, to,
                   [&](uint32_t i) { return i - o.firstVertex; });
  }

  void build() {
    if (embree != nullptr) rtcReleaseScene(embree);
    embree = rtcNewScene(device);
    rtcSetSceneFlags(embree,
                     static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST |
                                                RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    rtcSetSceneBuildQuality(embree, RTC_BUILD_QUALITY_LOW);
    for (uint32_t i = 0; i < scene.objects.size(); ++i) {
      const RenderObject& o = scene.objects[i];
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3),
                              o.vertexCount);
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), o.triangleCount());
      if (!error.empty()) {  // no room for the buffers
        rtcReleaseGeometry(geometry);
        commit();
      }
      rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
      copyVertices(geometry, o);
      copyIndices(geometry, o);
      // The scene belongs to the FrameRenderer, which outlives this; the filter only reads it.
      rtcSetGeometryUserData(geometry, const_cast<RenderScene*>(&scene));
      applyMaterial(geometry, i);
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(embree, geometry, i);
      rtcReleaseGeometry(geometry);
    }
    commit();
  }

  void applyMaterial(RTCGeometry geometry, uint32_t object) const {
    const Material& m = materialOf(object);
    const auto filter = m.alphaMode == AlphaMode::mask ? alphaFilter : nullptr;
    rtcSetGeometryIntersectFilterFunction(geometry, filter);
    rtcSetGeometryOccludedFilterFunction(geometry, filter);
    if (m.isClear()) {
      rtcDisableGeometry(geometry);
    } else {
      rtcEnableGeometry(geometry);
    }
  }

  void update(const RenderSceneChanges& changes) {
    if (changes.rebuilt) {
      build();
      return;
    }
    if (changes.movedObjects.empty() && !changes.materials) return;
    for (const uint32_t i : changes.movedObjects) {
      RTCGeometry geometry = rtcGetGeometry(embree, i);
      copyVertices(geometry, scene.objects[i]);
      copyIndices(geometry, scene.objects[i]);
      rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
      rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0);
      rtcCommitGeometry(geometry);
    }
    if (changes.materials) {
      for (uint32_t i = 0; i < scene.objects.size(); ++i) {
        RTCGeometry geometry = rtcGetGeometry(embree, i);
        applyMaterial(geometry, i);
        rtcCommitGeometry(geometry);
      }
    }
    commit();
  }
};

RayCaster::RayCaster(const RenderScene& scene) : impl_(std::make_unique<Impl>(scene)) {
  impl_->build();
}

RayCaster::~RayCaster() = default;

void RayCaster::update(const RenderSceneChanges& changes) { impl_->update(changes); }

Hit RayCaster::intersect(const Ray& ray, Surfaces which) const {
  RTCIntersectContext context = contextFor(which);
  RTCRayHit r{toEmbree(ray), {}};
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->embree, &context, &r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {r.ray.tfar, r.hit.geomID, r.hit.primID, r.hit.u, r.hit.v};
}

bool RayCaster::occluded(const Ray& ray) const {
  RTCIntersectContext context = contextFor(Surfaces::all);
  RTCRay r = toEmbree(ray);
  rtcOccluded1(impl_->embree, &context, &r);
  return r.tfar < 0.0f;
}

void RayCaster::intersect8(std::span<const Ray, 8> rays, std::span<Hit, 8> hits,
                           Surfaces which) const {
  RTCIntersectContext context = contextFor(which);
  alignas(32) int valid[8];
  alignas(32) RTCRayHit8 r{};
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
  rtcIntersect8(valid, impl_->embree, &context, &r);
  for (size_t i = 0; i < 8; ++i) {
    hits[i] = valid[i] == 0 || r.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                  ? Hit()
                  : Hit{r.ray.tfar[i], r.hit.geomID[i], r.hit.primID[i], r.hit.u[i], r.hit.v[i]};
  }
}

float rayEpsilon(const vec3& p) {
  // Coordinates carry a relative error of 2⁻²⁴; transforms, barycentrics and the intersection add
  // some tens of such. A floor of a hundredth of a millimetre for points near the origin.
  const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return std::max(1e-5f, largest * 0x1p-17f);
}

}  // namespace lamplighter
