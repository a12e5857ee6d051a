// The cpu backend: rasterises triangles in tiles and works on eight pixels at a time. It needs no
// OpenGL and gives the same bits at any number of threads on every x86-64-v3 machine.
#pragma once

#include <memory>
#include <vector>

#include "renderer/backends/backend.h"
#include "renderer/backends/cpu/gbuffer/seen_points.h"
#include "renderer/backends/gbuffer_view.h"
#include "renderer/backends/image_pool.h"

namespace lamplighter {
namespace cpu {

struct Background;

class CpuBackend final : public Backend {
 public:
  // A G-buffer and what it shows.
  struct Picture {
    GBuffer gbuffer;
    View view;
    vec2 jitter{0.0f};
  };

  ~CpuBackend() override { dropKernels(); }
  const BackendInfo& info() const override { return info_; }
  void finish() override {}
  GBufferView hostGBuffer() override { return GBufferView(shown_->gbuffer); }
  Image readNormals() override;
  Image readAlbedo() override;
  std::shared_ptr<RadianceImage> compose(const Image& irradiance, bool white) override;

  // For kernels. There are two pictures: the one without jitter is kept and traced again only where
  // something moved; the other one has the jitter of antialiasing.
  const Picture& still() const { return still_; }
  const Picture& shifted() const { return shifted_; }
  const Picture& shown() const { return *shown_; }  // the one rendered last
  // Whether still() shows the present scene in the view of shown().
  bool stillIsCurrent() const {
    return stillIsKnown_ && moves_.empty() && stillView_ == shown_->view;
  }
  // What still() showed before its view changed; views: the number of such changes. Null: it is not
  // known, or objects changed with the view.
  const SeenPoints* seenBefore() const { return seenIsKnown_ ? &seen_ : nullptr; }
  uint64_t views() const { return views_; }
  Background background() const;  // of shown()
  // An image of the size of shown(), with undefined content.
  std::shared_ptr<ImagePool::Pooled> takeImage() {
    return images_.take(shown_->gbuffer.width, shown_->gbuffer.height);
  }

 protected:
  BackendCounts ownCounts() const override {
    return {rayCount_, still_.gbuffer.bytes() + shifted_.gbuffer.bytes() + seen_.bytes()};
  }
  void takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                 const RayCaster& rays) override;
  void drawGBuffer(const View& view, vec2 jitter) override;

 private:
  BackendInfo info_{.name = "cpu", .device = "x86-64-v3, 8 lanes"};
  ImagePool images_;
  uint64_t rayCount_ = 0;
  const RenderScene* scene_ = nullptr;
  const RayCaster* rays_ = nullptr;
  Picture still_, shifted_;
  const Picture* shown_ = &still_;
  bool stillIsKnown_ = false;  // still_ shows stillView_, except for later moves
  View stillView_;
  bool shiftedIsKnown_ = false;  // shifted_ shows the present scene with its view and jitter
  bool seenIsKnown_ = false;
  SeenPoints seen_;
  uint64_t views_ = 0;
  std::vector<Bounds> moves_;  // bounds before and after of objects that moved since
};

// Offers the kernels of all methods: renderer/registry/cpu_kernels.cpp, which lists them.
void offerKernels(CpuBackend& backend);

}  // namespace cpu

// With the kernels of all methods.
std::unique_ptr<Backend> makeCpuBackend();

}  // namespace lamplighter
