// Traces one ray per pixel; all views are painted from its hits.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/debug_views/view_colours.h"
#include "renderer/debug_views/view_picture.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

// The hit of a pixel's ray. The normals are on the visible side.
struct Seen {
  const Hit* hit = nullptr;
  Surface surface;
  vec3 normal{0.0f}, geometricNormal{0.0f};
  bool front = true;
  float facing = 1.0f;  // cosine between the shading normal and the direction to the eye
  float footprint = 0;  // size of the pixel at the hit, perpendicular to the ray [m]
};

class Painter {
 public:
  explicit Painter(const ViewSubject& subject)
      : in_(subject),
        hits_(static_cast<size_t>(subject.view.width) * subject.view.height),
        direction_(hits_.size()) {
    const View& view = in_.view;
    const vec3 forward = view.forward();
    pixelAngle_ = 2.0f * std::tan(0.5f * view.yfov) / static_cast<float>(view.height);
    constexpr int kLanes = 8;
    tbb::parallel_for(0, view.height, [&](int y) {
      for (int first = 0; first < view.width; first += kLanes) {
        std::array<Ray, kLanes> rays;
        std::array<Hit, kLanes> hits;
        const int count = std::min(kLanes, view.width - first);
        const size_t at = index(first, y);
        for (int lane = 0; lane < kLanes; ++lane) {
          Ray& ray = rays[static_cast<size_t>(lane)];
          ray.origin = view.eye;
          ray.direction = view.rayDirection(static_cast<float>(first + lane) + 0.5f,
                                            static_cast<float>(y) + 0.5f);
          ray.tNear = view.znear / glm::dot(ray.direction, forward);
          if (lane < count)
            direction_[at + static_cast<size_t>(lane)] = ray.direction;
          else
            ray.tFar = -1.0f;
        }
        in_.rays.intersect8(rays, hits, Surfaces::seen);
        std::copy_n(hits.begin(), count, hits_.begin() + static_cast<ptrdiff_t>(at));
      }
    });
  }

  // Sets the display colour of each pixel that hits something.
  template <typename Colour>
  Image8 paint(const Colour& colour) const {
    Image8 image(in_.view.width, in_.view.height);
    forEachPixel([&](int x, int y, size_t i) {
      const vec3 c = hits_[i] ? colour(seen(i), i) : view_colours::kBackground;
      for (int k = 0; k < 3; ++k)
        image.at(x, y)[k] = static_cast<uint8_t>(std::clamp(c[k], 0.0f, 1.0f) * 255.0f + 0.5f);
    });
    return image;
  }

  // For views of patches.
  void findPatches() {
    const PatchView& patches = *in_.inspection.patches;
    leaves_.assign(hits_.size(), kNone);
    patches_.assign(hits_.size(), kNone);
    forEachPixel([&](int, int, size_t i) {
      const Hit& hit = hits_[i];
      if (!hit) return;
      leaves_[i] = patches.leafAt(hit.object, hit.triangle, position(i));
      patches_[i] = patches.patchOf(hit.object, leaves_[i]);
    });
  }
  int leaf(size_t i) const { return leaves_[i]; }
  int patch(size_t i) const { return patches_[i]; }
  PatchView::Shape shape(size_t i) const {
    return in_.inspection.patches->shapeOf(hits_[i].object, patches_[i]);
  }
  // Whether the pixel is at the border of its patch: the pixel to its right or below has another
  // patch. Without findPatches() there are no borders.
  bool isBorder(size_t i) const {
    if (patches_.empty()) return false;
    const auto width = static_cast<size_t>(in_.view.width);
    return ((i + 1) % width != 0 && !samePatch(i, i + 1)) ||
           (i + width < hits_.size() && !samePatch(i, i + width));
  }

  // The largest value over all pixels that hit something.
  template <typename Value>
  int largest(const Value& value) const {
    std::vector<int> ofRow(static_cast<size_t>(in_.view.height), 0);
    forEachPixel([&](int, int y, size_t i) {
      int& most = ofRow[static_cast<size_t>(y)];
      if (hits_[i]) most = std::max(most, value(i));
    });
    return *std::max_element(ofRow.begin(), ofRow.end());
  }

  const Hit& hit(size_t i) const { return hits_[i]; }
  vec3 position(size_t i) const { return in_.view.eye + hits_[i].t * direction_[i]; }
  size_t pixels() const { return hits_.size(); }

  Seen seen(size_t i) const {
    Seen s;
    s.hit = &hits_[i];
    s.surface = surfaceAt(in_.scene, s.hit->object, s.hit->triangle, s.hit->u, s.hit->v);
    s.front = glm::dot(direction_[i], s.surface.geometricNormal) < 0.0f;
    const float side = s.front ? 1.0f : -1.0f;
    s.normal = side * s.surface.normal;
    s.geometricNormal = side * s.surface.geometricNormal;
    s.facing = std::max(0.0f, -glm::dot(s.normal, direction_[i]));
    s.footprint = s.hit->t * pixelAngle_;
    return s;
  }

  template <typename F>
  void forEachPixel(const F& f) const {
    tbb::parallel_for(0, in_.view.height, [&](int y) {
      for (int x = 0; x < in_.view.width; ++x) f(x, y, index(x, y));
    });
  }

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(in_.view.width) + static_cast<size_t>(x);
  }
  bool samePatch(size_t a, size_t b) const {
    if (!hits_[a] || !hits_[b] || hits_[a].object != hits_[b].object) return !hits_[a] && !hits_[b];
    return patches_[a] == patches_[b];
  }

  const ViewSubject& in_;
  std::vector<Hit> hits_;  // by pixel
  std::vector<vec3> direction_;
  float pixelAngle_ = 0.0f;
  std::vector<int> leaves_, patches_;  // by pixel
};

// Slight shading by a light at the camera, to show shapes; hues stay those of the legend.
inline vec3 shaded(const vec3& colour, const Seen& s) { return colour * (0.6f + 0.4f * s.facing); }

// Darkens the colour along patch borders. The effect fades where patches are small in the picture;
// otherwise a level seen from far away would show only borders.
inline vec3 outlined(const Painter& p, const Seen& s, size_t i, const vec3& colour) {
  if (!p.isBorder(i)) return colour;
  const vec2 size = p.shape(i).size;
  const float pixels = std::min(size.x, size.y) * std::sqrt(s.facing) / s.footprint;
  return colour * (1.0f - 0.55f * std::clamp((pixels - 4.0f) / 12.0f, 0.0f, 1.0f));
}

}  // namespace lamplighter
