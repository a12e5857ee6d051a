#include "renderer/backends/cpu/gbuffer/raster.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/gbuffer/raster_tile.h"

namespace lamplighter::cpu {
namespace {

using glm::dvec3;

// Triangles are collected in bins of 4×4 tiles. A triangle that lies in this number of bins is
// prepared only once for all its tiles.
constexpr int kBinSize = 4 * kTileSize;
constexpr int kManyBins = 4;
constexpr size_t kTrianglesPerTask = 4096;

}  // namespace

Raster::Raster(const RenderScene& scene, const View& view, vec2 jitter, const GBuffer& size,
               std::span<const uint8_t> wanted)
    : scene_(scene),
      width_(view.width),
      height_(view.height),
      tilesX_(size.tilesX),
      binsX_((view.width + kBinSize - 1) / kBinSize),
      jitter_(jitter),
      eye_(view.eye),
      middleX_(0.5 * view.width),
      middleY_(0.5 * view.height),
      znear_(view.znear) {
  const double pixel = 2.0 * std::tan(0.5 * static_cast<double>(view.yfov)) / view.height;
  right_ = dvec3(view.right()) * (1.0 / pixel);
  down_ = dvec3(view.up()) * (-1.0 / pixel);
  forward_ = dvec3(view.forward());
  const int binsY = (view.height + kBinSize - 1) / kBinSize;
  std::vector<uint8_t> isWanted(static_cast<size_t>(binsX_ * binsY), wanted.empty() ? 1 : 0);
  for (size_t tile = 0; tile < wanted.size(); ++tile) {
    const int x = static_cast<int>(tile) % tilesX_, y = static_cast<int>(tile) / tilesX_;
    if (wanted[tile] != 0)
      isWanted[static_cast<size_t>(y * kTileSize / kBinSize * binsX_ + x * kTileSize / kBinSize)] =
          1;
  }

  // Collects entries per task, then sorts them into bins in the order of triangles.
  std::vector<size_t> ends;  // of the triangles of each object, all objects one after another
  size_t triangles = 0;
  for (const RenderObject& o : scene.objects) ends.push_back(triangles += o.triangleCount());
  std::vector<std::vector<Entry>> found((triangles + kTrianglesPerTask - 1) / kTrianglesPerTask);
  tbb::parallel_for(size_t{0}, found.size(), [&](size_t task) {
    const size_t first = task * kTrianglesPerTask,
                 last = std::min(first + kTrianglesPerTask, triangles);
    const auto from = std::ranges::upper_bound(ends, first) - ends.begin();
    for (auto object = static_cast<uint32_t>(from); object < ends.size(); ++object) {
      const RenderObject& o = scene.objects[object];
      const size_t end = ends[object], begin = end - o.triangleCount();
      if (begin >= last) break;
      if (scene.materials[static_cast<size_t>(o.material)].isClear()) continue;
      Entry entry;
      for (size_t i = std::max(begin, first); i < std::min(end, last); ++i)
        if (makeEntry(object, static_cast<uint32_t>(i - begin), entry))
          found[task].push_back(entry);
    }
  });
  const auto forEachBin = [&](const Entry& e, auto&& f) {
    for (int y = e.y0 / kBinSize; y <= e.y1 / kBinSize; ++y)
      for (int x = e.x0 / kBinSize; x <= e.x1 / kBinSize; ++x)
        if (const auto bin = static_cast<size_t>(y * binsX_ + x); isWanted[bin] != 0) f(bin);
  };
  firstOfBin_.assign(isWanted.size() + 1, 0);
  for (auto& some : found) {
    for (Entry& e : some) {
      int bins = 0;
      forEachBin(e, [&](size_t bin) {
        ++firstOfBin_[bin + 1];
        ++bins;
      });
      if (bins < kManyBins) continue;
      e.large = static_cast<int>(large_.size());
      large_.push_back({edgesOf(e), plainOf(e.object, e.triangle)});
    }
  }
  for (size_t bin = 0; bin < isWanted.size(); ++bin) firstOfBin_[bin + 1] += firstOfBin_[bin];
  entries_.resize(firstOfBin_.back());
  std::vector<uint32_t> next(firstOfBin_.begin(), firstOfBin_.end() - 1);
  for (const auto& some : found)
    for (const Entry& e : some) forEachBin(e, [&](size_t bin) { entries_[next[bin]++] = e; });
}

// x and y: distance of the image point from the image centre × z [pixels], y down; z: depth.
dvec3 Raster::toCamera(uint32_t vertex) const {
  const dvec3 p = dvec3(scene_.positions[vertex]) - eye_;
  return {glm::dot(p, right_), glm::dot(p, down_), glm::dot(p, forward_)};
}

bool Raster::makeEntry(uint32_t object, uint32_t triangle, Entry& out) const {
  const uint32_t* index = &scene_.indices[scene_.objects[object].firstIndex + 3 * triangle];
  const dvec3 a = toCamera(index[0]), b = toCamera(index[1]), c = toCamera(index[2]);
  const double nearest = std::min({a.z, b.z, c.z}), farthest = std::max({a.z, b.z, c.z});
  if (!(farthest > znear_)) return false;
  const double det = glm::dot(a, glm::cross(b, c));
  if (det == 0.0 || !std::isfinite(det)) return false;
  if (det > 0.0 && scene_.backIsUnseen(object)) return false;
  out = {
      object, triangle, 0, 0, static_cast<uint16_t>(width_ - 1), static_cast<uint16_t>(height_ - 1),
      kNone};
  if (nearest <= 0.5 * znear_) return true;  // reaches behind the near plane
  // One extra pixel on each side, for rounding and jitter.
  const double ax = a.x / a.z, bx = b.x / b.z, cx = c.x / c.z;
  const double ay = a.y / a.z, by = b.y / b.z, cy = c.y / c.z;
  const double x0 = middleX_ + std::min({ax, bx, cx}) - 2.0,
               x1 = middleX_ + std::max({ax, bx, cx}) + 1.0,
               y0 = middleY_ + std::min({ay, by, cy}) - 2.0,
               y1 = middleY_ + std::max({ay, by, cy}) + 1.0;
  if (x1 < 0.0 || y1 < 0.0 || x0 > width_ - 1 || y0 > height_ - 1) return false;
  out.x0 = static_cast<uint16_t>(std::max(x0, 0.0));
  out.y0 = static_cast<uint16_t>(std::max(y0, 0.0));
  out.x1 = static_cast<uint16_t>(std::min<double>(x1, width_ - 1));
  out.y1 = static_cast<uint16_t>(std::min<double>(y1, height_ - 1));
  return true;
}

Raster::Edges Raster::edgesOf(const Entry& e) const {
  const uint32_t* index = &scene_.indices[scene_.objects[e.object].firstIndex + 3 * e.triangle];
  const dvec3 corner[3] = {toCamera(index[0]), toCamera(index[1]), toCamera(index[2])};
  Edges edges;
  edges.det = glm::dot(corner[0], glm::cross(corner[1], corner[2]));
  const double sign = edges.det < 0.0 ? -1.0 : 1.0;
  for (int i = 0; i < 3; ++i)
    edges.normals[i] = sign * glm::cross(corner[(i + 1) % 3], corner[(i + 2) % 3]);
  return edges;
}

// Returns whether the triangle may meet a ray of the tile.
bool Raster::makeCandidate(const Entry& e, int tile, Candidate& out) const {
  const int tx = tile % tilesX_ * kTileSize, ty = tile / tilesX_ * kTileSize;
  constexpr int kLast = kTileSize - 1;
  if (e.x1 < tx || e.y1 < ty || e.x0 > tx + kLast || e.y0 > ty + kLast) return false;
  const Edges edges = e.large == kNone ? edgesOf(e) : large_[static_cast<size_t>(e.large)].edges;
  // In these coordinates the ray of pixel (x, y) is (x − middleX, y − middleY, 1).
  const double x = tx + 0.5 + static_cast<double>(jitter_.x) - middleX_;
  const double y = ty + 0.5 + static_cast<double>(jitter_.y) - middleY_;
  out.coversAll = true;
  for (int i = 0; i < 3; ++i) {
    const dvec3& n = edges.normals[i];
    out.alongX[i] = static_cast<float>(n.x);
    out.alongY[i] = static_cast<float>(n.y);
    out.atFirst[i] = static_cast<float>(n.x * x + n.y * y + n.z);
    const float toX = kLast * out.alongX[i], toY = kLast * out.alongY[i];
    const float rounding = 1e-5f * (std::abs(out.atFirst[i]) + std::abs(toX) + std::abs(toY));
    if (out.atFirst[i] + std::max(toX, 0.0f) + std::max(toY, 0.0f) < -rounding) return false;
    if (out.atFirst[i] + std::min(toX, 0.0f) + std::min(toY, 0.0f) <= rounding)
      out.coversAll = false;
  }
  const RenderObject& o = scene_.objects[e.object];
  out.object = e.object;
  out.triangle = e.triangle;
  out.large = e.large;
  out.isFront = edges.det < 0.0;
  out.isMasked = scene_.materials[static_cast<size_t>(o.material)].alphaMode == AlphaMode::mask;
  out.inverseDet = static_cast<float>(1.0 / std::abs(edges.det));
  out.x0 = std::max(e.x0 - tx, 0);
  out.y0 = std::max(e.y0 - ty, 0);
  out.x1 = std::min(e.x1 - tx, kLast);
  out.y1 = std::min(e.y1 - ty, kLast);
  return true;
}

void Raster::trace(int tile, GBuffer& out) const {
  const int tx = tile % tilesX_ * kTileSize, ty = tile / tilesX_ * kTileSize;
  TileHits hits;
  std::fill_n(hits.inverseDistance, kTilePixels, 0.0f);
  std::fill_n(hits.candidate, kTilePixels, -1);
  hits.mostInverse = static_cast<float>(1.0 / znear_);
  const auto bin = static_cast<size_t>(ty / kBinSize * binsX_ + tx / kBinSize);
  std::vector<Candidate> candidates;
  Candidate candidate;
  for (uint32_t i = firstOfBin_[bin]; i < firstOfBin_[bin + 1]; ++i) {
    if (!makeCandidate(entries_[i], tile, candidate)) continue;
    intersect(candidate, static_cast<int>(candidates.size()), hits);
    candidates.push_back(candidate);
  }
  // Pixels outside the image are misses.
  if (tx + kTileSize > width_ || ty + kTileSize > height_) {
    for (int i = 0; i < kTilePixels; ++i) {
      const int packet = i / kLanes, lane = i % kLanes;
      const int x = tx + packet % kPacketsPerRow * kPacketWidth + lane % kPacketWidth;
      const int y = ty + packet / kPacketsPerRow * kPacketHeight + lane / kPacketWidth;
      if (x >= width_ || y >= height_) hits.candidate[i] = -1;
    }
  }
  write(candidates, hits, tile, out);
}

}  // namespace lamplighter::cpu
