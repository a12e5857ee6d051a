// Smooth edges before a picture has settled: subpixel reconstruction antialiasing. Rays find what
// share of a pixel each of the surfaces at an edge covers, and the pixel becomes the mean of the
// pixels around it that show these surfaces. No light is computed for that. While objects move
// before a still camera, only the edges that they change are found anew.
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
  // frame in which the view is that of the frame before; if it is another one, or after frames
  // without a call in which surfaces changed, restart(). Draws the G-buffer of the view without a
  // shift if there is something to find. Returns the rays traced.
  uint64_t findMore(const FrameInputs& in);
  bool isDone() const { return !rows_.empty() && next_ == rows_.size(); }

  // `picture`, in main memory, with smooth edges as far as they were found. `withLights`: also
  // where the sky or a lamp is seen beside.
  std::shared_ptr<RadianceImage> resolved(const std::shared_ptr<RadianceImage>& picture,
                                          bool withLights);

 private:
  struct Edge {
    int x = 0;
    // How many samples of the pixel show what the pixels around it show, row by row; 4: the pixel
    // itself.
    std::array<uint8_t, 9> samples{};
    bool isTraced = false;
    bool isAtLight = false;  // the sky or a lamp is seen in one of these pixels
  };
  void findEdges(const FrameInputs& in);
  struct Changes {
    std::vector<uint8_t> pixels, rows;  // rows: whether any of its pixels changed
  };
  Changes findChanges(const FrameInputs& in, const GBufferView& gbuffer);
  void traceRow(const FrameInputs& in, const GBufferView& gbuffer, int y);

  std::vector<std::vector<Edge>> rows_;  // of the picture, from the top; empty: not begun
  size_t next_ = 0;                      // the first row without samples
  std::vector<uint32_t> keys_;           // by pixel: what it shows
  std::vector<uint64_t> revisions_;      // of the G-buffer then, by tile
  // The last result, what it was made of, and how many rows of it are smooth.
  std::shared_ptr<RadianceImage> result_, from_;
  size_t smoothRows_ = 0;
  bool withLights_ = true;
  ImagePool pool_;
};

}  // namespace lamplighter
