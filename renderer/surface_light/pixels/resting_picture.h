// A picture of the light on the surface mesh when nothing moves: with what glossy surfaces mirror,
// and antialiased if it has several samples. Its rows are found over several frames.
#pragma once

#include "renderer/surface_light/pixels/mesh_mirror.h"
#include "renderer/surface_light/pixels/pixel_lobes.h"
#include "renderer/surface_light/pixels/surface_picture.h"

namespace lamplighter {

class RestingPicture {
 public:
  // Forgets all pixels. `samples`: how many G-buffers of the view follow.
  void restart(const View& view, int samples, uint32_t seed);
  bool isComplete() const { return samples_ > 0 && pixels_.samples() == samples_; }
  int samples() const { return samples_; }
  // The sample that the next rows are of.
  int sample() const { return pixels_.samples(); }
  // The next rows, at most so many, of this sample. `gbuffer`: shifted as the sample is.
  void add(const GatherScene& scene, const SurfaceLight& light, const ViewRecords& records,
           const GBufferView& gbuffer, const SurfacePictureOptions& options, int most);

  // To be called when the light on the mesh is another.
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
