#include "renderer/surface_light/shape_clusters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace lamplighter {
namespace {

// Number of points of a cluster from which its rays start in turn.
constexpr uint32_t kMostPlaces = 8;
// A cluster gives light to vertices within this distance [sizes].
constexpr float kReach = 1.5f;

using Cell = std::tuple<int, int, int>;

struct Cluster {
  uint32_t sample = 0;
  float area = 0.0f;
  vec3 middle{0.0f}, normal{0.0f};  // weighted by area
};

class ClusterBuilder {
 public:
  ClusterBuilder(const OwnMesh& mesh, float size, bool isBack, SampleKeys& keys, SurfaceShape& out)
      : mesh_(mesh), size_(size), isBack_(isBack), keys_(keys), out_(out) {}

  void add(std::span<const uint32_t> triangles) {
    std::map<std::pair<Cell, int>, std::vector<uint32_t>> groups;
    for (const uint32_t t : triangles) groups[{cellOf(middleOf(t)), facing(t)}].push_back(t);
    for (const auto& [key, group] : groups) addCluster(key.first, group);
    for (const uint32_t t : triangles) {
      for (uint32_t c = 0; c < 3; ++c) {
        uint32_t& value = out_.valueOfVertex[side(out_.vertices) + mesh_.corner(t, c)];
        if (value == kUnknown) value = valueAt(t, c);
      }
    }
  }

  static constexpr uint32_t kUnknown = 0xffffffffu;

 private:
  uint32_t side(uint32_t count) const { return isBack_ ? count : 0; }

  vec3 middleOf(uint32_t t) const {
    vec3 sum(0.0f);
    for (uint32_t c = 0; c < 3; ++c) sum += mesh_.vertex(t, c, isBack_).position;
    return sum / 3.0f;
  }

  Cell cellOf(const vec3& p) const {
    const vec3 cell = glm::floor((p - mesh_.bounds().min) / size_);
    return {static_cast<int>(cell.x), static_cast<int>(cell.y), static_cast<int>(cell.z)};
  }

  // Which of the six axis directions a triangle faces.
  int facing(uint32_t t) const {
    const vec3 n = mesh_.normal(t), a = glm::abs(n);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return 2 * axis + (n[axis] < 0.0f ? 1 : 0);
  }

  void addCluster(const Cell& cell, const std::vector<uint32_t>& triangles) {
    Cluster cluster;
    cluster.sample = keys_.addUnnamed();
    std::vector<float> ends;
    for (const uint32_t t : triangles) {
      const float area = mesh_.area(t);
      cluster.area += area;
      cluster.middle += area * middleOf(t);
      cluster.normal += (isBack_ ? -area : area) * mesh_.normal(t);
      ends.push_back(cluster.area);
    }
    cluster.middle = cluster.area > 0.0f ? cluster.middle / cluster.area : middleOf(triangles[0]);
    const float length = glm::length(cluster.normal);
    if (length > 0.0f) cluster.normal /= length;
    const PlaceRange places{static_cast<uint32_t>(out_.places.size()),
                            std::min(kMostPlaces, static_cast<uint32_t>(triangles.size()))};
    for (uint32_t i = 0; i < places.count; ++i) {
      const float at =
          (static_cast<float>(i) + 0.5f) / static_cast<float>(places.count) * cluster.area;
      const auto found = std::min(std::ranges::upper_bound(ends, at) - ends.begin(),
                                  static_cast<std::ptrdiff_t>(triangles.size()) - 1);
      out_.places.push_back(
          {side(out_.triangles) + triangles[static_cast<size_t>(found)], 1.0f / 3.0f, 1.0f / 3.0f});
    }
    const auto leaf = static_cast<int32_t>(out_.leaves.size());
    for (const uint32_t t : triangles) out_.roots[side(out_.triangles) + t] = -1 - leaf;
    out_.samples.push_back(places);
    out_.leaves.push_back({{cluster.sample, cluster.sample, cluster.sample}, places});
    clusters_[cell].push_back(cluster);
  }

  uint32_t valueAt(uint32_t t, uint32_t c) {
    const OwnMesh::Vertex v = mesh_.vertex(t, c, isBack_);
    const int known = keys_.known(v.position, v.normal);
    if (known != kNone) return static_cast<uint32_t>(known);
    const SurfaceShape::Blend blend = blendAt(v, t);
    blends_.push_back(blend);
    return kFirstBlend + static_cast<uint32_t>(blends_.size() - 1);
  }

  // The nearest clusters with a similar normal: large ones have more weight.
  SurfaceShape::Blend blendAt(const OwnMesh::Vertex& v, uint32_t t) const {
    SurfaceShape::Blend out;
    const auto [x, y, z] = cellOf(v.position);
    for (int i = 0; i < 27; ++i) {
      const auto found = clusters_.find({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1});
      if (found == clusters_.end()) continue;
      for (const Cluster& cluster : found->second) {
        const float near =
            std::max(0.0f, 1.0f - glm::distance(v.position, cluster.middle) / (kReach * size_));
        const float alike = std::max(0.0f, glm::dot(v.normal, cluster.normal));
        float weight = cluster.area * near * near * alike * alike;
        uint32_t sample = cluster.sample;
        for (size_t k = 0; k < out.weights.size(); ++k) {
          if (!(weight > out.weights[k])) continue;
          std::swap(weight, out.weights[k]);
          std::swap(sample, out.samples[k]);
        }
      }
    }
    float sum = 0.0f;
    for (const float w : out.weights) sum += w;
    if (!(sum > 0.0f)) {
      const int32_t root = out_.roots[side(out_.triangles) + t];
      out.samples.fill(out_.leaves[static_cast<size_t>(-1 - root)].samples[0]);
      out.weights = {1.0f, 0.0f, 0.0f, 0.0f};
      return out;
    }
    for (float& w : out.weights) w /= sum;
    return out;
  }

 public:
  // Marks values that are blends, until all samples are known.
  static constexpr uint32_t kFirstBlend = 0x80000000u;
  std::vector<SurfaceShape::Blend> blends_;

 private:
  const OwnMesh& mesh_;
  float size_;
  bool isBack_;
  SampleKeys& keys_;
  SurfaceShape& out_;
  std::map<Cell, std::vector<Cluster>> clusters_;
};

}  // namespace

void addClusters(const OwnMesh& mesh, std::span<const uint32_t> triangles, float size,
                 SampleKeys& keys, SurfaceShape& out) {
  const uint32_t sides = out.hasBacks ? 2 : 1;
  out.valueOfVertex.assign(size_t{sides} * out.vertices, ClusterBuilder::kUnknown);
  for (uint32_t side = 0; side < sides; ++side) {
    ClusterBuilder builder(mesh, size, side == 1, keys, out);
    builder.add(triangles);
    for (uint32_t v = side * out.vertices; v < (side + 1) * out.vertices; ++v) {
      uint32_t& value = out.valueOfVertex[v];
      if (value != ClusterBuilder::kUnknown && value >= ClusterBuilder::kFirstBlend)
        value += static_cast<uint32_t>(out.blends.size());
    }
    out.blends.insert(out.blends.end(), builder.blends_.begin(), builder.blends_.end());
  }
  for (uint32_t& value : out.valueOfVertex) {
    if (value != ClusterBuilder::kUnknown && value >= ClusterBuilder::kFirstBlend)
      value += static_cast<uint32_t>(out.samples.size()) - ClusterBuilder::kFirstBlend;
  }
}

}  // namespace lamplighter
