#include "renderer/surface_light/pixels/pixel_lobes.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/scene/light_linking.h"
#include "renderer/surface_light/pixels/seen_triangle.h"

namespace lamplighter {
namespace {

constexpr uint32_t kLobeSet = 0x10be;
// Lobes are fully traced up to the first roughness, and not traced above the second.
constexpr float kTraced = 0.45f, kEven = 0.65f;
// Pixels whose lobes differ by more show different reflections: normals within 13°.
constexpr float kLobeTurn = 40.0f;
constexpr float kLeastRadius = 2.5f, kMostRadius = 24.0f;  // pixels
// With one ray for each pixel: wide enough to average the 4 × 4 pixels that share a sequence.
constexpr float kLeastRadiusOfOne = 5.0f;
// The wide tail of a lobe is replaced by its other part, because few rays hit a window there, which
// would be visible as a spot (Stachowiak, "Stochastic Screen-Space Reflections", 2015).
constexpr float kWithoutTail = 0.95f;

constexpr float kPackedMost = 65535.0f;

// A direction in 32 bits: the faces of an octahedron, unfolded to a square.
uint32_t packedDirection(const vec3& d) {
  const float sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  vec2 s = vec2(d.x, d.y) / sum;
  if (d.z < 0.0f)
    s = vec2((1.0f - std::abs(s.y)) * (s.x < 0.0f ? -1.0f : 1.0f),
             (1.0f - std::abs(s.x)) * (s.y < 0.0f ? -1.0f : 1.0f));
  const vec2 scaled = (0.5f * s + 0.5f) * kPackedMost + 0.5f;
  return static_cast<uint32_t>(scaled.x) | static_cast<uint32_t>(scaled.y) << 16;
}

vec3 unpackedDirection(uint32_t bits) {
  const vec2 s = 2.0f * vec2(bits & 0xffffu, bits >> 16) / kPackedMost - 1.0f;
  vec3 d(s, 1.0f - std::abs(s.x) - std::abs(s.y));
  if (d.z < 0.0f) {
    d.x = (1.0f - std::abs(s.y)) * (s.x < 0.0f ? -1.0f : 1.0f);
    d.y = (1.0f - std::abs(s.x)) * (s.y < 0.0f ? -1.0f : 1.0f);
  }
  return glm::normalize(d);
}

uint16_t packedShare(float share) {
  return static_cast<uint16_t>(std::clamp(share, 0.0f, 1.0f) * kPackedMost + 0.5f);
}

// A direction in which the lobe reflects light to the eye, above the surface.
vec3 lobeDirection(const GBufferPoint& p, const vec3& toEye, float roughness, const vec2& u) {
  const Frame frame(p.normal);
  vec3 eye = frame.toLocal(toEye);
  eye.z = std::max(eye.z, 1e-3f);
  const vec3 half = sampleVisibleNormal(glm::normalize(eye), roughness * roughness, u);
  const vec3 out = frame.toWorld(glm::normalize(2.0f * glm::dot(eye, half) * half - eye));
  const float above = glm::dot(out, p.geometricNormal);
  return above > 0.0f ? out : glm::normalize(out - (2.0f * above - 1e-3f) * p.geometricNormal);
}

}  // namespace

float PixelLobes::tracedShare(float roughness) {
  return std::clamp((kEven - roughness) / (kEven - kTraced), 0.0f, 1.0f);
}

void PixelLobes::restart(const View& view, int samples, uint32_t seed) {
  *this = {};
  view_ = view;
  samples_ = samples;
  seed_ = seed;
}

uint64_t PixelLobes::add(const RenderScene& scene, const RayCaster& caster,
                         const MirroredLight& light, const GBufferView& gbuffer,
                         const SurfacePictureOptions& options, Rows rows) {
  const auto sample = static_cast<uint32_t>(added_);
  if (rows.last == view_.height) ++added_;
  outdateLight();
  if (!options.speculars || options.white) return 0;
  const bool isGlossy = std::ranges::any_of(scene.materials, mayBeGlossy);
  if (!isGlossy) return 0;
  const auto pixels = static_cast<size_t>(view_.width) * static_cast<size_t>(view_.height);
  rays_.reserve(pixels * static_cast<size_t>(samples_));
  rays_.resize(std::max(rays_.size(), pixels * (sample + 1)));
  guides_.resize(pixels);
  LobeRay* lobes = rays_.data() + sample * pixels;
  const float pixelAngle = 2.0f * std::tan(0.5f * view_.yfov) / static_cast<float>(view_.height);
  std::atomic<uint64_t> traced = 0;
  tbb::parallel_for(rows.first, rows.last, [&](int y) {
    std::array<Ray, 8> rays;
    std::array<Hit, 8> hits;
    std::array<size_t, 8> which{};
    std::array<float, 8> spread{};
    size_t lanes = 0;
    const auto flush = [&] {
      if (lanes == 0) return;
      for (size_t k = lanes; k < 8; ++k) rays[k].tFar = -1.0f;
      hits.fill({});
      caster.leastHits8(rays, hits);
      for (size_t k = 0; k < lanes; ++k) {
        LobeRay& out = lobes[which[k]];
        out.isToSky = !hits[k];
        out.place =
            out.isToSky ? packedDirection(rays[k].direction) : light.placeOf(rays[k], hits[k]);
        float& radius = guides_[which[k]].radius;
        if (radius > 0.0f) continue;
        // The width of the lobe at the hit of the ray, as seen in the mirror.
        const float away = glm::distance(rays[k].origin, view_.eye);
        const float seen = hits[k] ? hits[k].t / (hits[k].t + away) : 1.0f;
        radius = std::clamp(spread[k] * seen / pixelAngle,
                            samples_ == 1 ? kLeastRadiusOfOne : kLeastRadius, kMostRadius);
      }
      traced += lanes;
      lanes = 0;
    };
    for (int x = 0; x < view_.width; ++x) {
      if (!gbuffer.isHit(x, y)) continue;
      const GBufferPoint p = gbuffer.at(x, y);
      const SeenTriangle seen(scene, p);
      if (!seen.isSound) continue;
      const PixelReflectance r = reflectanceOf(scene, p, seen.weights, view_.eye, options);
      const float share = tracedShare(r.roughness);
      if (share == 0.0f || r.lobe == vec3(0.0f)) continue;
      const size_t pixel =
          static_cast<size_t>(y) * static_cast<size_t>(view_.width) + static_cast<size_t>(x);
      LobeRay& out = lobes[pixel];
      for (int c = 0; c < 3; ++c)
        out.reflectance[static_cast<size_t>(c)] = packedShare(share * r.lobe[c]);
      if (!out.isUsed()) continue;
      Guide& guide = guides_[pixel];
      if (guide.normal == vec3(0.0f)) guide = {p.normal, p.object, 0.0f};
      // Each block of 4 × 4 pixels shares one sequence (Keller and Heidrich, "Interleaved
      // Sampling", 2001).
      const auto ux = static_cast<uint32_t>(x), uy = static_cast<uint32_t>(y);
      const uint32_t turn = hash4(ux / 4, uy / 4, seed_, kLobeSet);
      vec2 u = sobol2(16 * sample + ux % 4 + 4 * (uy % 4), turn);
      u.x *= kWithoutTail;
      rays[lanes] = {p.position + rayEpsilon(p.position) * p.geometricNormal, 0.0f,
                     lobeDirection(p, glm::normalize(view_.eye - p.position), r.roughness, u)};
      spread[lanes] = r.roughness * r.roughness;
      which[lanes++] = pixel;
      if (lanes == 8) flush();
    }
    flush();
  });
  return traced;
}

// The radii are of single rays: near the legs of a table some rays hit the legs, and others
// surfaces far behind. Takes harmonic means over the surrounding pixels, so that near objects stay
// sharp.
std::vector<float> PixelLobes::evenRadii() const {
  constexpr int kReach = 3;
  std::vector<float> radii(guides_.size(), 0.0f), inRows(guides_.size(), 0.0f);
  const auto meanAlong = [&](const auto& radiusAt, int dx, int dy, std::vector<float>& to) {
    tbb::parallel_for(0, view_.height, [&](int y) {
      for (int x = 0; x < view_.width; ++x) {
        const size_t i =
            static_cast<size_t>(y) * static_cast<size_t>(view_.width) + static_cast<size_t>(x);
        if (guides_[i].radius <= 0.0f) continue;
        float inverse = 0.0f, count = 0.0f;
        for (int k = -kReach; k <= kReach; ++k) {
          const int u = x + k * dx, v = y + k * dy;
          if (u < 0 || v < 0 || u >= view_.width || v >= view_.height) continue;
          const size_t other =
              static_cast<size_t>(v) * static_cast<size_t>(view_.width) + static_cast<size_t>(u);
          if (guides_[other].radius <= 0.0f || guides_[other].object != guides_[i].object) continue;
          inverse += 1.0f / radiusAt(other);
          count += 1.0f;
        }
        to[i] = count / inverse;
      }
    });
  };
  meanAlong([&](size_t i) { return guides_[i].radius; }, 1, 0, inRows);
  meanAlong([&](size_t i) { return inRows[i]; }, 0, 1, radii);
  return radii;
}

// Averages each pixel with pixels of the same reflection at a distance of `step` pixels. Step 1
// averages any 4 × 4 pixels, which share a sequence; step 4 averages such means, and step 12 those
// of step 4. Other steps leave a visible grid.
void PixelLobes::average(const std::vector<vec3>& from, const std::vector<float>& radii, int step,
                         std::vector<vec3>& to) const {
  constexpr std::array<float, 5> kSequence{0.5f, 1.0f, 1.0f, 1.0f, 0.5f};
  const int reach = step == 1 ? 2 : 1;
  tbb::parallel_for(0, view_.height, [&](int y) {
    for (int x = 0; x < view_.width; ++x) {
      const size_t i =
          static_cast<size_t>(y) * static_cast<size_t>(view_.width) + static_cast<size_t>(x);
      const Guide& guide = guides_[i];
      to[i] = from[i];
      const float radius = radii[i];
      if (radius <= static_cast<float>(step)) continue;
      vec3 sum = from[i];
      float weights = 1.0f;
      for (int v = -reach; v <= reach; ++v)
        for (int u = -reach; u <= reach; ++u) {
          const int dx = step * u, dy = step * v;
          const int ox = x + dx, oy = y + dy;
          if ((u == 0 && v == 0) || ox < 0 || oy < 0 || ox >= view_.width || oy >= view_.height)
            continue;
          const size_t other =
              static_cast<size_t>(oy) * static_cast<size_t>(view_.width) + static_cast<size_t>(ox);
          const Guide& o = guides_[other];
          if (o.object != guide.object || o.normal == vec3(0.0f)) continue;
          const float turn = 1.0f - kLobeTurn * (1.0f - glm::dot(guide.normal, o.normal));
          const float far = static_cast<float>(dx * dx + dy * dy) / (radius * radius);
          float near = std::max(0.0f, 1.0f - far);
          if (step == 1)
            near = std::min(2.0f * near, 1.0f) * kSequence[static_cast<size_t>(u + 2)] *
                   kSequence[static_cast<size_t>(v + 2)];
          const float weight = std::max(0.0f, turn) * near;
          sum += weight * from[other];
          weights += weight;
        }
      to[i] = sum / weights;
    }
  });
}

void PixelLobes::addTo(const RenderScene& scene, const MirroredLight& light, Image& picture) {
  if (rays_.empty() || added_ == 0) return;
  if (reflected_.empty()) reflect(scene, light);
  tbb::parallel_for(0, view_.height, [&](int y) {
    const size_t first = static_cast<size_t>(y) * static_cast<size_t>(view_.width);
    for (size_t i = first; i < first + static_cast<size_t>(view_.width); ++i)
      picture.pixels[i] += reflected_[i];
  });
}

void PixelLobes::reflect(const RenderScene& scene, const MirroredLight& light) {
  const size_t pixels = guides_.size();
  std::vector<vec3> seen(pixels, vec3(0.0f)), averaged(pixels);
  const auto each = [&](const auto& use) {
    tbb::parallel_for(0, view_.height, [&](int y) {
      const size_t first = static_cast<size_t>(y) * static_cast<size_t>(view_.width);
      for (size_t i = first; i < first + static_cast<size_t>(view_.width); ++i) use(i);
    });
  };
  each([&](size_t i) {
    float count = 0.0f;
    for (size_t s = 0; s < static_cast<size_t>(added_); ++s) {
      const LobeRay& ray = rays_[s * pixels + i];
      if (!ray.isUsed()) continue;
      ++count;
      if (!ray.isToSky)
        seen[i] += light.radianceOf(ray.place);
      else if (!isLeftOut(scene.objects[guides_[i].object].leftOutBy, scene.skyLink))
        seen[i] += light.skyTowards(unpackedDirection(static_cast<uint32_t>(ray.place)));
    }
    if (count > 0.0f) seen[i] /= count;
  });
  const std::vector<float> radii = evenRadii();
  average(seen, radii, 1, averaged);
  average(averaged, radii, 4, seen);
  average(seen, radii, 12, averaged);
  const float scale = 1.0f / (kPackedMost * static_cast<float>(added_));
  each([&](size_t i) {
    vec3 reflectance(0.0f);
    for (size_t s = 0; s < static_cast<size_t>(added_); ++s) {
      const auto& r = rays_[s * pixels + i].reflectance;
      reflectance += vec3(r[0], r[1], r[2]);
    }
    averaged[i] *= scale * reflectance;
  });
  reflected_ = std::move(averaged);
}

}  // namespace lamplighter
