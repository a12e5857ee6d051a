// The pixels of a picture as points of the surface mesh: found once for a view, so that changed
// light on the mesh is shown by a few look-ups per pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/image/image.h"
#include "renderer/image/rows.h"
#include "renderer/surface_light/pixels/pixel_reflectance.h"
#include "renderer/surface_light/pixels/view_records.h"

namespace lamplighter {

class SurfacePicture {
 public:
  // Discards all pixels. `samples`: how many G-buffers of this size follow.
  void restart(int width, int height, int samples);
  // Adds rows of the current G-buffer, in order. Pixels where the mesh is too coarse use records,
  // if there are any. `withoutLobes`: leaves out the lobes, which PixelLobes adds.
  void add(const GatherScene& scene, const SurfaceLight& light, const ViewRecords& records,
           const GBufferView& gbuffer, const vec3& eye, const SurfacePictureOptions& options,
           Rows rows, bool withoutLobes = false);

  // Replaces the pixels of the only G-buffer that show a different point than before. The mesh and
  // the records must have the same numbers as before.
  void replaceChanged(const GatherScene& scene, const SurfaceLight& light,
                      const ViewRecords& records, const GBufferView& gbuffer, const vec3& eye,
                      const SurfacePictureOptions& options) {
    keepsSame_ = true;
    added_ = 0;
    add(scene, light, records, gbuffer, eye, options, {0, height_});
    keepsSame_ = false;
  }

  int samples() const { return added_; }  // number of complete samples
  // Adds the reflected radiance: the mean over the samples. `onMesh`: irradiance by value of the
  // mesh, `ofRecords`: by record [W/m²].
  void addTo(std::span<const vec3> onMesh, std::span<const vec3> ofRecords, Image& picture) const;
  size_t bytes() const;

 private:
  static constexpr uint32_t kRecord = 0x80000000u;
  struct Point {
    // Values of the mesh, or kRecord + a record.
    std::array<uint32_t, 4> values{};
    // Weights of the values but the first; the share of irradiance that is reflected, times π.
    // [1/65535]
    std::array<uint16_t, 3> weights{};
    std::array<uint16_t, 3> reflectance{};
    uint32_t key = 0;  // identifies the point that the pixel shows
  };
  int width_ = 0, height_ = 0, samples_ = 0, added_ = 0;
  bool keepsSame_ = false;
  std::vector<std::vector<Point>> points_;  // by sample, then by pixel
  // By tile: revision of the G-buffer when the only sample was added.
  std::vector<uint64_t> revisions_;
};

}  // namespace lamplighter
