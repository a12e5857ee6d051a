#include "renderer/surface_light/surface_mesh.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/scene/surface.h"
#include "renderer/surface_light/own_mesh.h"

namespace lamplighter {
namespace {

// Area lights reflect nothing.
bool hasShape(const RenderScene& scene, uint32_t object) {
  const RenderObject& o = scene.objects[object];
  return !o.isEmpty() && !o.isAreaLight &&
         !scene.materials[static_cast<size_t>(o.material)].isClear();
}

// No object has more than 1 / kLargestPart of the samples.
constexpr size_t kLargestPart = 8;

// The area [m²] and the longest side [m] of an object.
std::pair<float, float> sizeOf(const RenderScene& scene, uint32_t object) {
  const OwnMesh mesh(scene, object);
  double area = 0.0;
  for (uint32_t t = 0; t < mesh.triangles(); ++t) area += mesh.area(t);
  const vec3 size = mesh.bounds().extent();
  return {static_cast<float>(area), std::max({size.x, size.y, size.z})};
}

}  // namespace

SurfaceMesh::Identity SurfaceMesh::Identity::of(const RenderScene& scene, uint32_t object) {
  Identity out;
  out.hasShape = lamplighter::hasShape(scene, object);
  const RenderObject& o = scene.objects[object];
  if (o.isEmpty()) return out;
  const Material& m = scene.materials[static_cast<size_t>(o.material)];
  out.hasBacks = m.doubleSided;
  out.key = shapeOf(o);
  out.alpha = m.alphaMode;
  if (m.alphaMode == AlphaMode::mask) {
    out.cutoff = m.alphaCutoff;
    out.opacity = m.baseColor.a;
    out.texture = m.baseColorTexture;
  }
  return out;
}

SurfaceMeshChange SurfaceMesh::update(const RenderScene& scene, const RenderSceneChanges& changes,
                                      const SurfaceMeshOptions& options) {
  SurfaceMeshChange out;
  if (changes.rebuilt) *this = {};
  const bool isStill = changes.movedObjects.empty() && !changes.objects && !changes.materials;
  if (options == options_ && !parts_.empty() && isStill) return out;
  options_ = options;
  identities_.resize(scene.objects.size());
  known_.resize(scene.objects.size());
  parts_.resize(scene.objects.size());
  for (uint32_t o = 0; o < scene.objects.size(); ++o) {
    Identity now = Identity::of(scene, o);
    if (identities_[o] == now) continue;
    if (!(identities_[o].key == now.key) || identities_[o].hasBacks != now.hasBacks) known_[o] = {};
    if (identities_[o].hasShape == now.hasShape && now.hasShape)
      out.boxes.push_back(scene.objects[o].bounds);
    identities_[o] = std::move(now);
    out.objects.push_back(o);
  }

  tbb::parallel_for(uint32_t{0}, static_cast<uint32_t>(known_.size()), [&](uint32_t o) {
    if (identities_[o].hasShape && known_[o].shapeLevel < 0)
      std::tie(known_[o].area, known_[o].longest) = sizeOf(scene, o);
  });
  int level = 0;
  while (!findShapes(scene, level)) ++level;
  if (levelEdge(level) != edge_) {
    edge_ = levelEdge(level);
    out.isNew = true;
    out.objects.clear();
    out.boxes.clear();
    parts_.assign(parts_.size(), {});
    samples_ = leaves_ = blends_ = neighbours_ = {};
    objectOfSample_.clear();
    objectOfLeaf_.clear();
    for (uint32_t o = 0; o < parts_.size(); ++o) out.objects.push_back(o);
  }
  for (const uint32_t o : out.objects) renumber(o);
  usedSamples_ = usedLeaves_ = 0;
  for (const Part& part : parts_) {
    if (!part.shape) continue;
    usedSamples_ += part.shape->samples.size();
    usedLeaves_ += part.shape->leaves.size();
  }
  return out;
}

float SurfaceMesh::levelEdge(int level) const {
  return options_.edge * std::exp2(0.5f * static_cast<float>(level));
}

// Lower bound of the samples of an object: no element is larger than an equilateral triangle of
// that edge, and there are about half as many samples as elements.
double SurfaceMesh::leastSamples(uint32_t object, int level) const {
  const double edge = shapeEdge(known_[object].longest, levelEdge(level));
  return (identities_[object].hasBacks ? 2.0 : 1.0) * known_[object].area / (0.866 * edge * edge);
}

// Computes the shape of an object with edges of a level, or longer ones if it would exceed its
// share of the samples: the ground around a house must not use the samples of the house.
void SurfaceMesh::findShape(const RenderScene& scene, uint32_t object, int level) {
  Known& known = known_[object];
  const auto most = std::max(options_.mostSamples / kLargestPart, size_t{1});
  const auto isLast = [&] { return levelEdge(level) > known.longest; };
  while (!isLast() && leastSamples(object, level) > static_cast<double>(most)) ++level;
  for (;; ++level) {
    const auto it = known.samples.find(level);
    const bool isWanted = it == known.samples.end() || it->second <= most || isLast();
    if (isWanted && known.shapeLevel != level) {
      known.shape = std::make_shared<const SurfaceShape>(
          findSurfaceShape(scene, object, {levelEdge(level), identities_[object].hasBacks}));
      known.shapeLevel = level;
      known.samples[level] = known.shape->samples.size();
    }
    if (isLast() || known.samples[level] <= most) return;
  }
}

// Returns whether there are few enough samples. Edges longer than the scene are the last try,
// because each object needs at least one sample.
bool SurfaceMesh::findShapes(const RenderScene& scene, int level) {
  const bool isLast = levelEdge(level) > scene.bounds.radius();
  double least = 0.0;
  for (uint32_t o = 0; o < known_.size(); ++o)
    if (identities_[o].hasShape)
      least += std::min(leastSamples(o, level),
                        static_cast<double>(options_.mostSamples / kLargestPart));
  if (!isLast && least > static_cast<double>(options_.mostSamples)) return false;
  std::atomic<size_t> samples = 0;
  tbb::parallel_for(size_t{0}, parts_.size(), [&](size_t o) {
    if (!identities_[o].hasShape || (!isLast && samples > options_.mostSamples)) return;
    findShape(scene, static_cast<uint32_t>(o), level);
    samples += known_[o].shape->samples.size();
  });
  return isLast || samples <= options_.mostSamples;
}

// Assigns numbers to the elements of an object, or releases them.
void SurfaceMesh::renumber(uint32_t object) {
  Part& part = parts_[object];
  const auto shape = identities_[object].hasShape ? known_[object].shape : nullptr;
  if (part.shape == shape) return;
  const auto count = [](const auto& list) { return static_cast<uint32_t>(list.size()); };
  if (part.shape) {
    const SurfaceShape& old = *part.shape;
    samples_.giveBack(part.firstSample, count(old.samples));
    leaves_.giveBack(part.firstLeaf, count(old.leaves));
    blends_.giveBack(part.firstBlend, count(old.blends));
    neighbours_.giveBack(part.firstNeighbour, count(old.neighbours));
    std::fill_n(objectOfSample_.begin() + part.firstSample, old.samples.size(), kUnused);
    std::fill_n(objectOfLeaf_.begin() + part.firstLeaf, old.leaves.size(), kUnused);
  }
  part = {};
  part.shape = shape;
  if (!shape) return;
  part.firstSample = samples_.take(count(shape->samples));
  part.firstLeaf = leaves_.take(count(shape->leaves));
  part.firstBlend = blends_.take(count(shape->blends));
  part.firstNeighbour = neighbours_.take(count(shape->neighbours));
  objectOfSample_.resize(samples_.end(), kUnused);
  objectOfLeaf_.resize(leaves_.end(), kUnused);
  std::fill_n(objectOfSample_.begin() + part.firstSample, shape->samples.size(), object);
  std::fill_n(objectOfLeaf_.begin() + part.firstLeaf, shape->leaves.size(), object);
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
                  : static_cast<uint32_t>(samples()) + part.firstBlend + (v - local);
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
  out.turn =
      hash4(place.triangle, std::bit_cast<uint32_t>(place.u), std::bit_cast<uint32_t>(place.v), 0);
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
