// What a camera sees, tile by tile: the triangles that may meet a tile's rays are found first, and
// all rays of the tile are intersected with each of them, eight at a time.
//
// A ray through the eye meets a triangle a, b, c (relative to the eye) where d·(b×c), d·(c×a) and
// d·(a×b) have one sign. Over the image these are linear, and are the triangle's barycentric
// weights but for their sum; nothing needs to be clipped (Olano and Greer, Triangle Scan Conversion
// using 2D Homogeneous Coordinates, 1997). Neighbours compute the same number, but for its sign,
// for the edge that they share, so that no ray passes between them.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"

namespace lamplighter::cpu {

class Raster {
  using dvec3 = glm::dvec3;

 public:
  // More triangles than so are better left to a tree.
  static constexpr size_t kMostTriangles = size_t{1} << 18;

  // Finds what may be seen in tiles that are wanted (by tile; empty: in all).
  Raster(const RenderScene& scene, const View& view, vec2 jitter, const GBuffer& size,
         std::span<const uint8_t> wanted);

  // Writes all pixels of a tile but for its revision.
  void trace(int tile, GBuffer& out) const;

 private:
  // A triangle that may be seen within these pixels, its edges included.
  struct Entry {
    uint32_t object, triangle;
    uint16_t x0, y0, x1, y1;
    int large = kNone;  // in large_
  };
  // d·normals[i] ≥ 0 for a ray that meets it. det: of its corners, less than 0 from its front.
  struct Edges {
    dvec3 normals[3];
    double det;
  };
  // What is the same all over a triangle, if it is.
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
  dvec3 right_, down_, forward_;  // of the camera; right and down as long as a pixel at distance 1
  double middleX_, middleY_;      // of the image [pixels]
  double znear_;
  std::vector<Entry> entries_;        // bin after bin
  std::vector<uint32_t> firstOfBin_;  // and one past the last
  std::vector<Large> large_;          // what is in many bins
};

}  // namespace lamplighter::cpu
