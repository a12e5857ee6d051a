// Rasterises what a camera sees. For each tile it finds the triangles that may meet the tile's
// rays, and then intersects all rays of the tile with each of them, eight at a time.
//
// A ray d from the eye meets a triangle a, b, c (relative to the eye) where d·(b×c), d·(c×a) and
// d·(a×b) have one sign. Over the image these functions are linear. Divided by their sum they are
// the barycentric weights of the triangle. Nothing needs clipping (Olano and Greer, Triangle Scan
// Conversion using 2D Homogeneous Coordinates, 1997). Two triangles compute the same number, apart
// from the sign, for a shared edge, so no ray passes between them.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"

namespace lamplighter::cpu {

class Raster {
  using dvec3 = glm::dvec3;

 public:
  // Above this number of triangles a ray tracing tree is faster.
  static constexpr size_t kMostTriangles = size_t{1} << 18;

  // Finds the triangles that may be visible in the wanted tiles (by tile; empty: all tiles).
  Raster(const RenderScene& scene, const View& view, vec2 jitter, const GBuffer& size,
         std::span<const uint8_t> wanted);

  // Writes all pixels of a tile; does not change its revision.
  void trace(int tile, GBuffer& out) const;

 private:
  // A triangle that may be visible inside these pixels, bounds included.
  struct Entry {
    uint32_t object, triangle;
    uint16_t x0, y0, x1, y1;
    int large = kNone;  // index into large_
  };
  // d·normals[i] ≥ 0 for a ray d that meets it. det: determinant of its corners, negative seen from
  // its front.
  struct Edges {
    dvec3 normals[3];
    double det;
  };
  // Values that are constant over a triangle.
  struct Plain {
    bool isKnown = false, isPlain = false;
    Surface surface;
    bool isFlat() const { return isPlain && surface.normal == surface.geometricNormal; }
  };
  struct Large {
    Edges edges;
    Plain plain;
  };
  struct Candidate;
  struct TileHits;

  bool makeEntry(uint32_t object, uint32_t triangle, Entry& out) const;
  Edges edgesOf(const Entry& entry) const;
  Plain plainOf(uint32_t object, uint32_t triangle) const;
  bool makeCandidate(const Entry& entry, int tile, Candidate& out) const;
  void intersect(const Candidate& candidate, int index, TileHits& hits) const;
  void write(std::span<const Candidate> candidates, const TileHits& hits, int tile,
             GBuffer& out) const;
  void writeFlat(const Candidate& candidate, const Surface& surface, int tile, int packet,
                 int count, GBuffer& out) const;
  dvec3 toCamera(uint32_t vertex) const;

  const RenderScene& scene_;
  int width_, height_, tilesX_;
  int binsX_;
  vec2 jitter_;
  dvec3 eye_;
  // of the camera; right_ and down_ have the size of a pixel at distance 1
  dvec3 right_, down_, forward_;
  double middleX_, middleY_;  // of the image [pixels]
  double znear_;
  std::vector<Entry> entries_;        // bin by bin
  std::vector<uint32_t> firstOfBin_;  // and the end of the last bin
  std::vector<Large> large_;          // triangles that lie in many bins
};

}  // namespace lamplighter::cpu
