#include "renderer/surface_light/direct_meshes/mesh_cut.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// Differences are compared with the light at the point plus this share of the mean of the picture,
// so that deep shadows are not divided unnecessarily.
constexpr float kDark = 0.1f;
// Edges whose ends differ by this multiple of the contrast lie in a shadow border, where the middle
// may equal the mean by chance.
constexpr float kSteep = 10.0f;
// Visible triangles of one task.
constexpr size_t kTrianglesATask = 64;

vec3 childWeights(const vec3& w, int child) {
  vec3 out = child == 3 ? vec3(1.0f) - 2.0f * w : 2.0f * w;
  if (child < 3) out[child] -= 1.0f;
  return out;
}

}  // namespace

struct MeshCut::Visit {
  Missing missing;
  std::vector<vec3>* light = nullptr;
  std::vector<VisibleTriangles::Pixel> pixels;
};

MeshCut::MeshCut(const SplitTree& tree, const MeshValues& values, const VisibleTriangles& visible,
                 std::span<const uint32_t> roots, const View& view, const MeshCutOptions& options)
    : tree_(tree),
      values_(values),
      visible_(visible),
      roots_(roots),
      eye_(view.eye),
      focus_(0.5f * static_cast<float>(view.height) / std::tan(0.5f * view.yfov)),
      options_(options) {
  double sum = 0.0;
  for (size_t i = 0; i < roots.size(); ++i) {
    double mean = 0.0;
    for (const uint32_t corner : tree.node(roots[i]).corners) {
      isRooted_ = isRooted_ && values.isKnown[corner] != 0;
      mean += static_cast<double>(luminance(values.light[corner])) / 3.0;
    }
    sum += mean * visible.triangles()[i].count;
  }
  if (visible.pixels() > 0)
    floor_ = kDark * static_cast<float>(sum / static_cast<double>(visible.pixels()));
}

// Upper bound of the length of the edge as seen from the eye, inside or outside the picture.
float MeshCut::pixelsOf(const vec3& a, const vec3& b) const {
  const vec3 along = b - a;
  float longest = 0.0f;
  for (const vec3& p : {a, 0.5f * (a + b), b}) {
    const vec3 d = p - eye_;
    const float d2 = glm::dot(d, d);
    if (d2 > 0.0f) longest = std::max(longest, glm::length(glm::cross(along, d)) / d2);
  }
  return focus_ * longest;
}

float MeshCut::contrastOf(const vec3& a, const vec3& b) const {
  const float scale = std::max(luminance(a), luminance(b)) + floor_;
  return scale > 0.0f ? luminance(glm::abs(a - b)) / scale : 0.0f;
}

MeshCut::Missing MeshCut::find(std::vector<vec3>* light) const {
  const auto triangles = visible_.triangles();
  std::vector<Visit> tasks((triangles.size() + kTrianglesATask - 1) / kTrianglesATask);
  tbb::parallel_for(size_t{0}, tasks.size(), [&](size_t task) {
    Visit& at = tasks[task];
    at.light = light;
    const size_t end = std::min((task + 1) * kTrianglesATask, triangles.size());
    for (size_t i = task * kTrianglesATask; i < end; ++i) {
      const SplitTree::Node& node = tree_.node(roots_[i]);
      std::array<vec3, 3> corners{};
      vec3 mean(0.0f);
      float known = 0.0f;
      for (size_t k = 0; k < 3; ++k) {
        if (values_.isKnown[node.corners[k]] == 0) {
          at.missing.vertices.push_back({node.corners[k], VertexRequest::kFirst});
          continue;
        }
        corners[k] = values_.light[node.corners[k]];
        mean += corners[k];
        known += 1.0f;
      }
      for (size_t k = 0; k < 3; ++k)
        if (values_.isKnown[node.corners[k]] == 0 && known > 0.0f) corners[k] = mean / known;
      const auto pixels = visible_.pixelsOf(triangles[i]);
      at.pixels.assign(pixels.begin(), pixels.end());
      visit(at, roots_[i], corners, {}, at.pixels);
    }
  });
  Missing all;
  for (const Visit& at : tasks) {
    all.vertices.insert(all.vertices.end(), at.missing.vertices.begin(), at.missing.vertices.end());
    all.nodes.insert(all.nodes.end(), at.missing.nodes.begin(), at.missing.nodes.end());
    all.triangles += at.missing.triangles;
  }
  return all;
}

void MeshCut::visit(Visit& at, uint32_t number, const std::array<vec3, 3>& light,
                    const std::array<bool, 3>& isFixed,
                    std::span<VisibleTriangles::Pixel> pixels) const {
  const SplitTree::Node& node = tree_.node(number);
  std::array<bool, 3> isSplit{};
  std::array<vec3, 3> middles;
  bool isAnySplit = false, wantsChildren = false;
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    middles[k] = 0.5f * (light[k] + light[next]);
    if (isFixed[k] || !isRooted_) continue;
    const float length =
        pixelsOf(tree_.vertex(node.corners[k]).position, tree_.vertex(node.corners[next]).position);
    if (length < options_.leastPixels) continue;
    const uint32_t middle = node.middles[k];
    if (middle == SplitTree::kNone) {
      wantsChildren = true;
    } else if (values_.isKnown[middle] == 0) {
      // Long edges count as full contrast: their ends tell nothing about shadows between.
      const float contrast = length > kLongEdge ? 1.0f : contrastOf(light[k], light[next]);
      at.missing.vertices.push_back({middle, contrast * static_cast<float>(pixels.size())});
    } else if (length > kLongEdge ||
               contrastOf(values_.light[middle], middles[k]) > options_.contrast ||
               contrastOf(light[k], light[next]) > kSteep * options_.contrast) {
      isSplit[k] = isAnySplit = true;
      middles[k] = values_.light[middle];
    }
  }
  if (wantsChildren) at.missing.nodes.push_back(number);
  if (!isAnySplit) {
    ++at.missing.triangles;
    if (at.light)
      for (const VisibleTriangles::Pixel& p : pixels)
        (*at.light)[p.index] =
            p.weights.x * light[0] + p.weights.y * light[1] + p.weights.z * light[2];
    return;
  }
  const auto& m = middles;
  // Edges between midpoints are not fixed; halves of an edge of the node are fixed if it is not
  // divided.
  const std::array<std::array<vec3, 3>, 4> lights{
      std::array{light[0], m[0], m[2]}, std::array{m[0], light[1], m[1]},
      std::array{m[2], m[1], light[2]}, std::array{m[1], m[2], m[0]}};
  const std::array<bool, 3> fixed{!isSplit[0], !isSplit[1], !isSplit[2]};
  const std::array<std::array<bool, 3>, 4> areFixed{
      std::array{fixed[0], false, fixed[2]}, std::array{fixed[0], fixed[1], false},
      std::array{false, fixed[1], fixed[2]}, std::array{false, false, false}};
  for (int child = 0; child < 4; ++child) {
    const auto end = child == 3 ? pixels.end()
                                : std::partition(pixels.begin(), pixels.end(), [&](const auto& p) {
                                    return p.weights[child] >= 0.5f;
                                  });
    const std::span own(pixels.begin(), end);
    pixels = std::span(end, pixels.end());
    if (own.empty()) continue;
    for (VisibleTriangles::Pixel& p : own) p.weights = childWeights(p.weights, child);
    const auto c = static_cast<size_t>(child);
    visit(at, node.children + static_cast<uint32_t>(child), lights[c], areFixed[c], own);
  }
}

}  // namespace lamplighter
