#include "renderer/path_repair/edge_resolve.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/methods/pixel_jitter.h"

namespace lamplighter {
namespace {

constexpr int kSamples = 8;  // rays per pixel at an edge
// Maximum number of rays per frame: a few hundredths of a second.
constexpr size_t kRaysAFrame = size_t{1} << 17;
// The same while something moves: a few thousandths of a second.
constexpr size_t kRaysMoving = size_t{1} << 15;
// Two points lie on one surface if the distance of one from the plane of the other is less than
// kMostOffPlane times their distance (so that curved surfaces are not divided), and the cosine
// between their normals is larger than kLeastCosine.
constexpr float kMostOffPlane = 0.2f, kLeastCosine = 0.9f;

float offPlane(const GBufferPoint& p, const vec3& x) {
  const vec3 way = x - p.position;
  const float length = glm::length(way);
  return length > 0.0f ? std::abs(glm::dot(p.geometricNormal, way)) / length : 0.0f;
}

// Whether two pixels show different surfaces.
bool differ(const GBufferView& g, int x, int y, int u, int v) {
  if (g.isHit(x, y) != g.isHit(u, v)) return true;
  if (!g.isHit(x, y)) return false;
  const GBufferPoint a = g.at(x, y), b = g.at(u, v);
  return a.object != b.object || glm::dot(a.normal, b.normal) < kLeastCosine ||
         std::min(offPlane(a, b.position), offPlane(b, a.position)) > kMostOffPlane;
}

// f(u, v, i) for the pixels around (x, y) that are in the picture; i: 0 to 8, row by row.
template <typename F>
void forEachAround(const GBufferView& g, int x, int y, F&& f) {
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      const int u = x + i, v = y + j;
      if (u >= 0 && v >= 0 && u < g.width() && v < g.height())
        f(u, v, static_cast<size_t>(3 * (j + 1) + i + 1));
    }
}

// The pixel around (x, y) that matches a sample best: the nearest one that shows the same surface.
// `at`: position of the sample, in pixels from the centre of (x, y).
size_t bestAround(const GBufferView& g, int x, int y, const Hit& hit, const vec3& point,
                  const vec2& at) {
  constexpr float kOtherSurface = 16.0f;  // more than any distance in pixels
  size_t best = 4;
  float least = std::numeric_limits<float>::max();
  forEachAround(g, x, y, [&](int u, int v, size_t i) {
    if (g.isHit(u, v) != static_cast<bool>(hit)) return;
    const vec2 way = vec2(static_cast<float>(u - x), static_cast<float>(v - y)) - at;
    float cost = glm::dot(way, way);
    if (hit) {
      const GBufferPoint p = g.at(u, v);
      if (p.object != hit.object) return;
      const float off = offPlane(p, point);
      if (off > kMostOffPlane) cost += kOtherSurface * (1.0f + off);
    }
    if (cost < least) {
      least = cost;
      best = i;
    }
  });
  return best;
}

}  // namespace

void EdgeResolve::restart() {
  rows_.clear();
  keys_.clear();
  revisions_.clear();
  next_ = smoothRows_ = 0;
  result_ = from_ = nullptr;
}

// Pixels that show another surface than at the last call, or an object that moved.
EdgeResolve::Changes EdgeResolve::findChanges(const FrameInputs& in, const GBufferView& gbuffer) {
  const cpu::GBuffer& g = gbuffer.packets();
  std::vector<uint8_t> isMoved(in.scene.objects.size(), 0);
  for (const uint32_t o : in.changes.movedObjects) isMoved[o] = 1;
  const auto width = static_cast<size_t>(g.width), height = static_cast<size_t>(g.height);
  // The holes of alpha masks may have changed.
  const bool isKnown = keys_.size() == width * height && !in.changes.materials;
  keys_.resize(width * height);
  Changes out{std::vector<uint8_t>(width * height, 0), std::vector<uint8_t>(height, 0)};
  const auto isSameTile = [&](size_t tile) {
    return isKnown && tile < revisions_.size() && revisions_[tile] == g.revision[tile];
  };
  tbb::parallel_for(0, g.height, [&](int y) {
    size_t i = static_cast<size_t>(y) * width;
    for (int x = 0; x < g.width; ++x, ++i) {
      const size_t k = g.index(x, y);
      if (x % cpu::kTileSize == 0 && isSameTile(k / cpu::kTilePixels)) {
        const int last = std::min(x + cpu::kTileSize, g.width) - 1;
        i += static_cast<size_t>(last - x);
        x = last;
        continue;
      }
      const bool isHit = g.hit[k] != 0;
      const uint32_t key =
          isHit ? hash4(std::bit_cast<uint32_t>(g.px[k]), std::bit_cast<uint32_t>(g.py[k]),
                        std::bit_cast<uint32_t>(g.pz[k]), g.object[k]) |
                      1u
                : 0u;
      out.pixels[i] = !isKnown || key != keys_[i] || (isHit && isMoved[g.object[k]] != 0);
      out.rows[static_cast<size_t>(y)] |= out.pixels[i];
      keys_[i] = key;
    }
  });
  revisions_ = g.revision;
  return out;
}

// Edges with unchanged surroundings keep their samples.
void EdgeResolve::findEdges(const FrameInputs& in) {
  const GBufferView g = in.backend.hostGBuffer();
  const Changes changes = findChanges(in, g);
  rows_.resize(static_cast<size_t>(g.height()));
  next_ = smoothRows_ = 0;
  from_ = nullptr;
  tbb::parallel_for(0, g.height(), [&](int y) {
    const auto first = static_cast<size_t>(std::max(y - 1, 0));
    const auto last = static_cast<size_t>(std::min(y + 1, g.height() - 1));
    if (std::none_of(&changes.rows[first], &changes.rows[last] + 1,
                     [](uint8_t r) { return r != 0; }))
      return;
    std::vector<Edge>& row = rows_[static_cast<size_t>(y)];
    const std::vector<Edge> before = std::exchange(row, {});
    auto known = before.begin();
    for (int x = 0; x < g.width(); ++x) {
      while (known != before.end() && known->x < x) ++known;
      bool isOther = false, isEdge = false;
      forEachAround(g, x, y, [&](int u, int v, size_t) {
        const auto i = static_cast<size_t>(v) * static_cast<size_t>(g.width());
        isOther = isOther || changes.pixels[i + static_cast<size_t>(u)] != 0;
      });
      if (!isOther) {
        if (known != before.end() && known->x == x) row.push_back(*known);
        continue;
      }
      Edge edge{.x = x};
      forEachAround(g, x, y, [&](int u, int v, size_t) {
        isEdge = isEdge || differ(g, x, y, u, v);
        const bool isLight = !g.isHit(u, v) || g.at(u, v).emission != vec3(0.0f);
        edge.isAtLight = edge.isAtLight || isLight;
      });
      if (isEdge) row.push_back(edge);
    }
  });
}

uint64_t EdgeResolve::findMore(const FrameInputs& in) {
  const bool isMoving = in.changes.surfaces() && !in.changes.rebuilt;
  if (isDone() && !isMoving) return 0;
  in.backend.renderGBuffer(in.view, vec2(0.0f));
  if (rows_.empty() || isMoving) findEdges(in);
  const size_t begin = next_;
  size_t rays = 0;
  for (; next_ < rows_.size() && rays < (isMoving ? kRaysMoving : kRaysAFrame); ++next_)
    rays +=
        kSamples * static_cast<size_t>(std::ranges::count(rows_[next_], false, &Edge::isTraced));
  const GBufferView g = in.backend.hostGBuffer();
  tbb::parallel_for(begin, next_, [&](size_t y) { traceRow(in, g, static_cast<int>(y)); });
  return rays;
}

void EdgeResolve::traceRow(const FrameInputs& in, const GBufferView& g, int y) {
  const View& view = in.view;
  const vec3 forward = view.forward();
  for (Edge& edge : rows_[static_cast<size_t>(y)]) {
    if (std::exchange(edge.isTraced, true)) continue;
    std::array<Ray, kSamples> rays;
    std::array<Hit, kSamples> hits;
    for (int k = 0; k < kSamples; ++k) {
      const vec2 at = pixelJitter(k, kSamples);
      Ray& r = rays[static_cast<size_t>(k)];
      r.origin = view.eye;
      r.direction = view.rayDirection(static_cast<float>(edge.x) + 0.5f + at.x,
                                      static_cast<float>(y) + 0.5f + at.y);
      r.tNear = view.znear / glm::dot(r.direction, forward);
    }
    in.services.rays().intersect8(rays, hits, Surfaces::seen);
    for (int k = 0; k < kSamples; ++k) {
      const Ray& r = rays[static_cast<size_t>(k)];
      const Hit& hit = hits[static_cast<size_t>(k)];
      const vec3 point = hit ? r.origin + hit.t * r.direction : vec3(0.0f);
      ++edge.samples[bestAround(g, edge.x, y, hit, point, pixelJitter(k, kSamples))];
    }
  }
}

std::shared_ptr<RadianceImage> EdgeResolve::resolved(const std::shared_ptr<RadianceImage>& picture,
                                                     bool withLights) {
  if (picture == from_ && smoothRows_ == next_ && withLights == withLights_) return result_;
  const Image& from = picture->pixels();
  const auto result = pool_.take(from.width, from.height);
  Image& to = result->image;
  tbb::parallel_for(0, from.height, [&](int y) {
    const size_t row = static_cast<size_t>(y) * static_cast<size_t>(from.width);
    std::copy_n(&from.pixels[row], from.width, &to.pixels[row]);
    if (static_cast<size_t>(y) >= next_) return;
    for (const Edge& edge : rows_[static_cast<size_t>(y)]) {
      if (edge.isAtLight && !withLights) continue;
      vec3 sum(0.0f);
      for (size_t i = 0; i < edge.samples.size(); ++i)
        if (edge.samples[i] != 0)
          sum += static_cast<float>(edge.samples[i]) *
                 from.at(edge.x + static_cast<int>(i % 3) - 1, y + static_cast<int>(i / 3) - 1);
      to.at(edge.x, y) = sum / static_cast<float>(kSamples);
    }
  });
  result_ = result;
  from_ = picture;
  smoothRows_ = next_;
  withLights_ = withLights;
  return result;
}

}  // namespace lamplighter
