#include "renderer/surface_light/pixels/resting_picture.h"

#include <algorithm>

namespace lamplighter {

void RestingPicture::restart(const View& view, int samples, uint32_t seed) {
  view_ = view;
  samples_ = samples;
  row_ = 0;
  pixels_.restart(view.width, view.height, samples);
  lobes_.restart(view, samples, seed);
}

void RestingPicture::add(const GatherScene& scene, const SurfaceLight& light,
                         const ViewRecords& records, const GBufferView& gbuffer,
                         const SurfacePictureOptions& options, int most) {
  const Rows rows{row_, std::min(row_ + most, view_.height)};
  pixels_.add(scene, light, records, gbuffer, view_.eye, options, rows, true);
  lobes_.add(scene.scene, scene.rays, MeshMirror(scene, light), gbuffer, options, rows);
  row_ = rows.last < view_.height ? rows.last : 0;
}

void RestingPicture::addTo(const GatherScene& scene, const SurfaceLight& light,
                           const ViewRecords& records, Image& picture) {
  pixels_.addTo(light.values(), records.values(), picture);
  lobes_.addTo(scene.scene, MeshMirror(scene, light), picture);
}

}  // namespace lamplighter
