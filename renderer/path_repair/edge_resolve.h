// Antialiasing of edges before a picture has settled: subpixel reconstruction antialiasing. Rays
// find the share of a pixel that each surface at an edge covers, and the pixel becomes the weighted
// mean of the surrounding pixels that show these surfaces. No light is computed for that. While
// objects move and the camera does not, only changed edges are traced again.
//
// After Chajdas, McGuire and Luebke, "Subpixel Reconstruction Antialiasing for Deferred Shading",
// 2011: geometry at more samples than shading.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/backends/image_pool.h"
#include "renderer/methods/gi_method.h"

namespace lamplighter {

class EdgeResolve {
 public:
  void restart();

  // Traces rays for the next edges of the view, a limited number in each call. Call it in each
  // frame in which the view has not changed. Call restart() if the view changed, or if surfaces
  // changed in frames without a call. Draws the G-buffer of the view without a subpixel shift if
  // edges are missing. Returns the number of rays.
  uint64_t findMore(const FrameInputs& in);
  bool isDone() const { return !rows_.empty() && next_ == rows_.size(); }

  // Returns `picture` (in main memory) with antialiasing of the edges found so far. `withLights`:
  // also at borders of the sky and of lamps.
  std::shared_ptr<RadianceImage> resolved(const std::shared_ptr<RadianceImage>& picture,
                                          bool withLights);

 private:
  struct Edge {
    int x = 0;
    // By pixel of the 3 × 3 neighbourhood, row by row: number of samples that show the same
    // surface; index 4 is the pixel itself.
    std::array<uint8_t, 9> samples{};
    bool isTraced = false;
    bool isAtLight = false;  // one of these pixels shows the sky or a lamp
  };
  void findEdges(const FrameInputs& in);
  struct Changes {
    std::vector<uint8_t> pixels, rows;  // rows: whether any of its pixels changed
  };
  Changes findChanges(const FrameInputs& in, const GBufferView& gbuffer);
  void traceRow(const FrameInputs& in, const GBufferView& gbuffer, int y);

  std::vector<std::vector<Edge>> rows_;  // of the picture, from the top; empty: not begun
  size_t next_ = 0;                      // the first row without samples
  std::vector<uint32_t> keys_;           // by pixel: key of the surface that it shows
  std::vector<uint64_t> revisions_;      // by tile: revision of the G-buffer for keys_
  // The last result, its input, and the number of its antialiased rows.
  std::shared_ptr<RadianceImage> result_, from_;
  size_t smoothRows_ = 0;
  bool withLights_ = true;
  ImagePool pool_;
};

}  // namespace lamplighter
