#include "renderer/prt/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Distance of the ray origins above the surface, as a share of the object's radius.
constexpr float kLift = 1e-4f;
// Offset of the ray origins from the vertex towards the centre of the triangle, so that at an edge
// in a concave corner they are not inside the other wall.
constexpr float kInset = 0.02f;
constexpr uint32_t kScramble = 0x5eed0001u;

// Cosine-distributed directions about +z. They are the same for all vertices, so that the error is
// smooth over the surface and not noise.
std::vector<vec3> cosineDirections(int count) {
  std::vector<vec3> out;
  for (int i = 0; i < count; ++i) {
    const vec2 u = sobol2(static_cast<uint32_t>(i), kScramble);
    const float r = std::sqrt(u.x), phi = 2.0f * kPi * u.y;
    out.emplace_back(r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1.0f - u.x)));
  }
  return out;
}

// For each vertex its largest triangle, the first of equals; 0xffffffff: none.
std::vector<uint32_t> largestTriangles(const RenderScene& own) {
  std::vector<uint32_t> largest(own.positions.size(), 0xffffffffu);
  std::vector<float> areas(own.positions.size(), 0.0f);
  for (uint32_t t = 0; t < own.triangleCount(); ++t) {
    const uint32_t* corner = &own.indices[3 * static_cast<size_t>(t)];
    const vec3& a = own.positions[corner[0]];
    const float area =
        glm::length(glm::cross(own.positions[corner[1]] - a, own.positions[corner[2]] - a));
    for (int k = 0; k < 3; ++k) {
      if (!(area > areas[corner[k]])) continue;
      areas[corner[k]] = area;
      largest[corner[k]] = t;
    }
  }
  return largest;
}

// The rays of one vertex: their origins and directions.
class VertexRays {
 public:
  VertexRays(const RenderScene& own, uint32_t vertex, uint32_t triangle, float lift)
      : frame_(own.normals[vertex]) {
    const uint32_t* corner = &own.indices[3 * static_cast<size_t>(triangle)];
    const vec3 &a = own.positions[corner[0]], &b = own.positions[corner[1]],
               &c = own.positions[corner[2]];
    plane_ = glm::normalize(glm::cross(b - a, c - a));
    // Normals that disagree with the winding are turned, as surfaceAt() does.
    if (glm::dot(plane_, frame_.normal) < 0.0f) frame_ = Frame(-frame_.normal);
    const vec3& p = own.positions[vertex];
    within_ = glm::mix(p, (a + b + c) / 3.0f, kInset) + lift * plane_;
    corner_ = p + lift * frame_.normal;
  }
  const vec3& normal() const { return frame_.normal; }
  // Directions above the triangle's plane start inside the triangle. Directions below the plane but
  // above the shading horizon start at the vertex, where a smooth convex surface does not block
  // itself.
  Ray along(const vec3& direction) const {
    Ray ray;
    ray.direction = frame_.toWorld(direction);
    ray.origin = glm::dot(ray.direction, plane_) > 0.0f ? within_ : corner_;
    return ray;
  }

 private:
  Frame frame_;
  vec3 plane_, within_, corner_;
};

void addScaled(ShVector& to, const ShVector& from, float weight) {
  for (size_t i = 0; i < kShCoefficients; ++i) to[i] += weight * from[i];
}

class Computation {
 public:
  Computation(const RenderScene& own, const TransferOptions& options, TransferProgress* progress)
      : own_(own),
        rays_(own),
        directions_(cosineDirections(std::max(8, options.directions / 8 * 8))),
        triangles_(largestTriangles(own)),
        lift_(kLift * own.bounds.radius()),
        progress_(progress) {}

  // Direct light from outside: π/N Σ V Y over cosine-distributed directions. For the same sum
  // without shadows the exact value is known, and so is its error. The lit share of this error is
  // subtracted. So a vertex without occlusion is exact, and so is one that is completely enclosed.
  bool direct(std::vector<ShVector>& out) const {
    return forEachVertex([&](uint32_t v, const VertexRays* rays) {
      if (rays == nullptr) {
        out[v] = cosineTransfer(own_.normals[v]);
        return;
      }
      ShVector open{}, all{};
      int lit = 0;
      const float weight = kPi / static_cast<float>(directions_.size());
      forEachRay(*rays, [&](const Ray& ray, const Hit& hit) {
        const ShVector y = shBasis(ray.direction);
        addScaled(all, y, weight);
        if (hit) return;
        addScaled(open, y, weight);
        ++lit;
      });
      const ShVector exact = cosineTransfer(rays->normal());
      const float share = static_cast<float>(lit) / static_cast<float>(directions_.size());
      for (size_t i = 0; i < kShCoefficients; ++i)
        out[v][i] = open[i] + share * (exact[i] - all[i]);
    });
  }

  // One more reflection: 1/N Σ ρ T over what each direction hits.
  bool reflected(const std::vector<Transfer::Vertex>& last,
                 std::vector<Transfer::Vertex>& out) const {
    return forEachVertex([&](uint32_t v, const VertexRays* rays) {
      Transfer::Vertex sum;
      if (rays != nullptr) {
        const float weight = 1.0f / static_cast<float>(directions_.size());
        forEachRay(*rays, [&](const Ray& ray, const Hit& hit) {
          if (!hit) return;
          const Surface surface = surfaceAt(own_, 0, hit.triangle, hit.u, hit.v);
          if (glm::dot(surface.geometricNormal, ray.direction) >= 0.0f) return;  // back face
          const vec3 albedo = weight * surface.albedo;
          const float weights[3] = {1.0f - hit.u - hit.v, hit.u, hit.v};
          for (size_t k = 0; k < 3; ++k) {
            const Transfer::Vertex& from =
                last[own_.indices[3 * static_cast<size_t>(hit.triangle) + k]];
            addScaled(sum.r, from.r, albedo.r * weights[k]);
            addScaled(sum.g, from.g, albedo.g * weights[k]);
            addScaled(sum.b, from.b, albedo.b * weights[k]);
          }
        });
      }
      out[v] = sum;
    });
  }

 private:
  // Calls f(vertex, its rays, or null if it is in no triangle). Returns false if cancelled.
  template <typename F>
  bool forEachVertex(F&& f) const {
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, static_cast<uint32_t>(triangles_.size()), 16),
                      [&](const tbb::blocked_range<uint32_t>& range) {
                        if (isCancelled()) return;
                        for (uint32_t v = range.begin(); v < range.end(); ++v) {
                          if (triangles_[v] == 0xffffffffu) {
                            f(v, nullptr);
                            continue;
                          }
                          const VertexRays rays(own_, v, triangles_[v], lift_);
                          f(v, &rays);
                        }
                        if (progress_ != nullptr) progress_->done += range.size();
                      });
    return !isCancelled();
  }
  // Calls it in the order of the directions.
  template <typename F>
  void forEachRay(const VertexRays& from, F&& f) const {
    std::array<Ray, 8> rays;
    std::array<Hit, 8> hits;
    for (size_t i = 0; i < directions_.size(); i += 8) {
      for (size_t k = 0; k < 8; ++k) rays[k] = from.along(directions_[i + k]);
      rays_.intersect8(rays, hits);
      for (size_t k = 0; k < 8; ++k) f(rays[k], hits[k]);
    }
  }
  bool isCancelled() const { return progress_ != nullptr && progress_->isCancelled; }

  const RenderScene& own_;
  const RayCaster rays_;
  const std::vector<vec3> directions_;
  const std::vector<uint32_t> triangles_;
  const float lift_;
  TransferProgress* progress_;
};

}  // namespace

RenderScene ownSceneOf(const RenderScene& scene, uint32_t object, const OwnSpace& space) {
  const RenderObject& from = scene.objects[object];
  RenderScene out;
  RenderObject o;
  o.vertexCount = from.vertexCount;
  o.indexCount = from.indexCount;
  const mat3& m = space.stretch;
  const float sign = glm::determinant(m) < 0.0f ? -1.0f : 1.0f;
  const mat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const auto copy = [&](const auto& all, auto& to) {
    const auto first = all.begin() + from.firstVertex;
    to.assign(first, first + from.vertexCount);
  };
  copy(scene.localPositions, out.localPositions);
  copy(scene.localNormals, out.localNormals);
  copy(scene.uv0, out.uv0);
  copy(scene.uv1, out.uv1);
  copy(scene.colors, out.colors);
  out.tangents.assign(from.vertexCount, vec4(0.0f));
  for (uint32_t i = 0; i < from.vertexCount; ++i) {
    out.positions.push_back(m * out.localPositions[i]);
    o.bounds.add(out.positions.back());
    const vec3 n = sign * (cofactor * out.localNormals[i]);
    const float length = glm::length(n);
    out.normals.push_back(length > 0.0f ? n / length : vec3(0, 1, 0));
  }
  for (uint32_t i = 0; i < from.indexCount; ++i)
    out.indices.push_back(scene.indices[from.firstIndex + i] - from.firstVertex);
  out.materials.push_back(scene.materials[static_cast<size_t>(from.material)]);
  out.textures = scene.textures;
  out.bounds = o.bounds;
  out.objects.push_back(o);
  return out;
}

std::optional<Transfer> computeTransfer(const RenderScene& own, const TransferOptions& options,
                                        TransferProgress* progress) {
  const size_t vertices = own.positions.size();
  if (progress != nullptr) progress->total = vertices * (1 + static_cast<size_t>(options.bounces));
  const Computation computation(own, options, progress);
  std::vector<ShVector> direct(vertices);
  if (!computation.direct(direct)) return std::nullopt;
  Transfer out;
  for (const ShVector& v : direct) out.vertices.push_back({v, v, v, v});
  std::vector<Transfer::Vertex> last = out.vertices, next(vertices);
  for (int bounce = 0; bounce < options.bounces; ++bounce) {
    if (!computation.reflected(last, next)) return std::nullopt;
    for (size_t v = 0; v < vertices; ++v) {
      addScaled(out.vertices[v].r, next[v].r, 1.0f);
      addScaled(out.vertices[v].g, next[v].g, 1.0f);
      addScaled(out.vertices[v].b, next[v].b, 1.0f);
    }
    std::swap(last, next);
  }
  return out;
}

}  // namespace lamplighter
