#include "renderer/surface_light/surface_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Area lights reflect nothing.
bool hasShape(const RenderScene& scene, uint32_t object) {
  const RenderObject& o = scene.objects[object];
  return !o.isEmpty() && !o.isAreaLight && !scene.materials[static_cast<size_t>(o.material)].isClear();
}

bool wantsBacks(const RenderScene& scene, uint32_t object) {
  return scene.materials[static_cast<size_t>(scene.objects[object].material)].doubleSided;
}

}  // namespace

bool SurfaceMesh::update(const RenderScene& scene, const RenderSceneChanges& changes,
                         const SurfaceMeshOptions& options) {
  bool isSame = !changes.rebuilt && !changes.objects && options == options_ && parts_.size() == scene.objects.size();
  for (const uint32_t o : changes.movedObjects)
    isSame = isSame && keys_[o] == shapeOf(scene.objects[o]);
  for (uint32_t o = 0; isSame && changes.materials && o < parts_.size(); ++o)
    isSame =
        hasShape(scene, o) == (parts_[o].shape != nullptr) && wantsBacks(scene, o) == hasBacks_[o];
  if (isSame) return false;
  options_ = options;
  keys_.clear();
  hasBacks_.clear();
  for (uint32_t o = 0; o < scene.objects.size(); ++o) {
    keys_.push_back(shapeOf(scene.objects[o]));
    hasBacks_.push_back(wantsBacks(scene, o));
  }
  edge_ = options.edge;
  while (!findShapes(scene, edge_)) edge_ *= std::sqrt(2.0f);
  number();
  return true;
}

// Returns whether there are few enough samples. Edges longer than the scene are the last try,
// because each object needs at least one sample.
bool SurfaceMesh::findShapes(const RenderScene& scene, float edge) {
  const bool isLast = edge > scene.bounds.radius();
  std::atomic<size_t> samples = 0;
  parts_.assign(scene.objects.size(), {});
  tbb::parallel_for(size_t{0}, parts_.size(), [&](size_t o) {
    const auto object = static_cast<uint32_t>(o);
    if (!hasShape(scene, object) || (!isLast && samples > options_.mostSamples)) return;
    parts_[o].shape =
        std::make_shared<const SurfaceShape>(findSurfaceShape(scene, object, {edge, hasBacks_[o]}));
    samples += parts_[o].shape->samples.size();
  });
  return isLast || samples <= options_.mostSamples;
}

void SurfaceMesh::number() {
  objectOfSample_.clear();
  objectOfLeaf_.clear();
  blends_ = 0;
  for (uint32_t o = 0; o < parts_.size(); ++o) {
    Part& part = parts_[o];
    part.firstSample = static_cast<uint32_t>(objectOfSample_.size());
    part.firstLeaf = static_cast<uint32_t>(objectOfLeaf_.size());
    part.firstBlend = static_cast<uint32_t>(blends_);
    if (!part.shape) continue;
    objectOfSample_.resize(objectOfSample_.size() + part.shape->samples.size(), o);
    objectOfLeaf_.resize(objectOfLeaf_.size() + part.shape->leaves.size(), o);
    blends_ += part.shape->blends.size();
  }
  samples_ = objectOfSample_.size();
  leaves_ = objectOfLeaf_.size();
}

std::span<const SurfacePlace> SurfaceMesh::placesOfSample(uint32_t sample) const {
  const Part& part = parts_[objectOfSample_[sample]];
  const PlaceRange range = part.shape->samples[sample - part.firstSample];
  return std::span(part.shape->places).subspan(range.first, range.count);
}

std::span<const SurfacePlace> SurfaceMesh::placesOfLeaf(uint32_t leaf) const {
  const Part& part = parts_[objectOfLeaf_[leaf]];
  const PlaceRange range = part.shape->leaves[leaf - part.firstLeaf].places;
  return std::span(part.shape->places).subspan(range.first, range.count);
}

std::array<uint32_t, 3> SurfaceMesh::samplesOfLeaf(uint32_t leaf) const {
  const Part& part = parts_[objectOfLeaf_[leaf]];
  std::array<uint32_t, 3> samples = part.shape->leaves[leaf - part.firstLeaf].samples;
  for (uint32_t& s : samples) s += part.firstSample;
  return samples;
}

bool SurfaceMesh::isCluster(uint32_t leaf) const {
  const auto samples = samplesOfLeaf(leaf);
  return samples[0] == samples[1] && samples[1] == samples[2];
}

bool SurfaceMesh::find(const RenderScene& scene, uint32_t object, uint32_t triangle, bool isBack,
                       const vec2& weights, MeshPoint& out) const {
  const Part& part = parts_[object];
  if (!part.shape || (isBack && !part.shape->hasBacks)) return false;
  const RenderObject& o = scene.objects[object];
  const uint32_t* index = &scene.indices[o.firstIndex + 3 * triangle];
  const uint32_t first = o.firstVertex;
  out =
      pointOf(*part.shape, {triangle + (isBack ? part.shape->triangles : 0), weights.x, weights.y},
              {index[0] - first, index[1] - first, index[2] - first});
  const auto local = static_cast<uint32_t>(part.shape->samples.size());
  for (uint32_t& v : out.values)
    v = v < local ? part.firstSample + v
                  : static_cast<uint32_t>(samples_) + part.firstBlend + (v - local);
  out.leaf += part.firstLeaf;
  return true;
}

size_t SurfaceMesh::bytes() const {
  size_t bytes = (objectOfSample_.size() + objectOfLeaf_.size()) * sizeof(uint32_t);
  for (const Part& part : parts_) bytes += part.shape ? part.shape->bytes() : 0;
  return bytes;
}

SurfaceSpot spotAt(const RenderScene& scene, uint32_t object, const SurfacePlace& place) {
  const RenderObject& o = scene.objects[object];
  const bool isBack = place.triangle >= o.triangleCount();
  const uint32_t triangle = place.triangle - (isBack ? o.triangleCount() : 0);
  const uint32_t* i = &scene.indices[o.firstIndex + 3 * triangle];
  const vec3 w(1.0f - place.u - place.v, place.u, place.v);
  const vec3 &a = scene.positions[i[0]], &b = scene.positions[i[1]], &c = scene.positions[i[2]];
  SurfaceSpot out;
  out.position = w.x * a + w.y * b + w.z * c;
  const vec3 cross = glm::cross(b - a, c - a);
  const float length = glm::length(cross);
  out.geometricNormal = length > 0.0f ? cross / length : vec3(0.0f, 0.0f, 1.0f);
  const vec3 smooth =
      w.x * scene.normals[i[0]] + w.y * scene.normals[i[1]] + w.z * scene.normals[i[2]];
  out.normal =
      glm::dot(smooth, out.geometricNormal) > 0.0f ? glm::normalize(smooth) : out.geometricNormal;
  if (isBack) {
    out.normal = -out.normal;
    out.geometricNormal = -out.geometricNormal;
  }
  return out;
}

vec3 albedoAt(const RenderScene& scene, uint32_t object, const SurfacePlace& place) {
  const RenderObject& o = scene.objects[object];
  const uint32_t triangle =
      place.triangle - (place.triangle >= o.triangleCount() ? o.triangleCount() : 0);
  const Material& m = scene.materials[static_cast<size_t>(o.material)];
  if (m.alphaMode == AlphaMode::mask &&
      alphaAt(scene, object, triangle, place.u, place.v) < m.alphaCutoff)
    return vec3(0.0f);
  return surfaceAt(scene, object, triangle, place.u, place.v).albedo;
}

}  // namespace lamplighter
