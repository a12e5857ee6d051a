// A picture of the light on the surface mesh when nothing moves: with glossy reflections, and
// antialiased if it has several samples. Its rows are computed over several frames.
#pragma once

#include "renderer/surface_light/pixels/mesh_mirror.h"
#include "renderer/surface_light/pixels/pixel_lobes.h"
#include "renderer/surface_light/pixels/surface_picture.h"

namespace lamplighter {

class RestingPicture {
 public:
  // Discards all pixels. `samples`: how many G-buffers of the view follow.
  void restart(const View& view, int samples, uint32_t seed);
  bool isComplete() const { return samples_ > 0 && pixels_.samples() == samples_; }
  int samples() const { return samples_; }
  // The sample of the next rows.
  int sample() const { return pixels_.samples(); }
  // Adds up to `most` next rows of this sample. `gbuffer`: with the subpixel shift of the sample.
  void add(const GatherScene& scene, const SurfaceLight& light, const ViewRecords& records,
           const GBufferView& gbuffer, const SurfacePictureOptions& options, int most);

  // Call when the light on the mesh has changed.
  void outdateLight() { lobes_.outdateLight(); }
  // Adds the radiance of the pixels, which must be complete.
  void addTo(const GatherScene& scene, const SurfaceLight& light, const ViewRecords& records,
             Image& picture);
  size_t bytes() const { return pixels_.bytes() + lobes_.bytes(); }

 private:
  View view_;
  int samples_ = 0, row_ = 0;
  SurfacePicture pixels_;
  PixelLobes lobes_;
};

}  // namespace lamplighter
