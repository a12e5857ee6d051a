#include "renderer/backends/cpu/many_lights/carried_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/many_lights/picture_light.h"

namespace lamplighter::cpu {
namespace {

// Largest distance between the points of two pixels that share light, in pixels of a surface that
// faces the eye, and its share out of the surface's plane.
constexpr float kMostPixels = 3.0f, kMostOutOfPlane = 0.2f;
// Smallest cosine at the eye for which the size of a pixel on a surface is computed.
constexpr float kLeastFacing = 0.1f;

constexpr struct { int x, y; } kAround[] = {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}};

constexpr uint8_t kAllLanes = (1u << kLanes) - 1;

}  // namespace

void CarriedLight::take(const PictureLight& light, std::span<const uint32_t> open) {
  std::swap(last_, now_);  // now_ is overwritten by find()
  last_.lanes.resize(open.size() * kPacketsPerTile, 0);
  last_.e.resize(open.size() * kTilePixels, vec3(0.0f));
  tbb::parallel_for(size_t{0}, open.size(), [&](size_t tile) {
    for (int packet = 0; packet < kPacketsPerTile; ++packet) {
      if ((open[tile] >> packet & 1) != 0) continue;
      const size_t at = tile * kPacketsPerTile + static_cast<size_t>(packet);
      PacketIrradiance room;
      const PacketIrradianceView e = light.at(static_cast<int>(tile), packet, room);
      for (size_t lane = 0; lane < kLanes; ++lane)
        last_.e[at * kLanes + lane] = vec3(e.r[lane], e.g[lane], e.b[lane]);
      last_.lanes[at] = kAllLanes;
    }
  });
}

void CarriedLight::know(std::vector<vec3> e) {
  now_.lanes.assign(e.size() / kLanes, kAllLanes);
  now_.e = std::move(e);
}

void CarriedLight::find(const GBuffer& g, const SeenPoints& before,
                        std::span<const uint32_t> packets) {
  now_.e.resize(g.px.size());
  now_.lanes.assign(g.px.size() / kLanes, 0);
  whole_.assign(packets.size(), 0);
  if (last_.e.size() != g.px.size() || before.px.size() != g.px.size()) return;
  const View& view = before.view;
  const mat4 toView = view.worldToView();
  const float perMetre = 0.5f * static_cast<float>(view.height) / std::tan(0.5f * view.yfov);
  const auto lookUp = [&](size_t i) {
    const vec3 p(g.px[i], g.py[i], g.pz[i]);
    const vec3 seen = toView * vec4(p, 1.0f);
    const float depth = -seen.z;
    if (depth <= view.znear) return false;
    const float x = 0.5f * static_cast<float>(view.width) + seen.x * perMetre / depth,
                y = 0.5f * static_cast<float>(view.height) - seen.y * perMetre / depth;
    if (!(x >= 0.0f && y >= 0.0f && x < static_cast<float>(g.width) &&
          y < static_cast<float>(g.height)))
      return false;
    const vec3 normal(g.gx[i], g.gy[i], g.gz[i]);
    const vec3 toEye = view.eye - p;
    const float along = glm::dot(toEye, normal), eye2 = glm::dot(toEye, toEye);
    const float facing2 = std::max(along * along / eye2, kLeastFacing * kLeastFacing);
    const float most = kMostPixels * depth / perMetre, most2 = most * most / facing2;
    // The nearest pixel, or one beside it.
    for (const auto& [dx, dy] : kAround) {
      const int nx = static_cast<int>(x) + dx, ny = static_cast<int>(y) + dy;
      if (nx < 0 || ny < 0 || nx >= g.width || ny >= g.height) continue;
      const size_t j = g.index(nx, ny);
      if (before.hit[j] == 0 || before.object[j] != g.object[i] ||
          (last_.lanes[j / kLanes] >> j % kLanes & 1) == 0)
        continue;
      const vec3 way = vec3(before.px[j], before.py[j], before.pz[j]) - p;
      const float distance2 = glm::dot(way, way), off = glm::dot(way, normal);
      if (distance2 > most2 || off * off > kMostOutOfPlane * kMostOutOfPlane * distance2) continue;
      now_.e[i] = last_.e[j];
      return true;
    }
    return false;
  };
  tbb::parallel_for(size_t{0}, packets.size(), [&](size_t tile) {
    for (size_t packet = 0; packet < kPacketsPerTile; ++packet) {
      if ((packets[tile] >> packet & 1) == 0) continue;
      const size_t at = tile * kPacketsPerTile + packet;
      uint8_t lanes = 0, misses = 0;
      for (size_t lane = 0; lane < kLanes; ++lane) {
        const size_t i = at * kLanes + lane;
        if (g.hit[i] == 0)
          misses |= static_cast<uint8_t>(1u << lane);
        else if (lookUp(i))
          lanes |= static_cast<uint8_t>(1u << lane);
      }
      now_.lanes[at] = lanes;
      if ((lanes | misses) == kAllLanes) whole_[tile] |= uint32_t{1} << packet;
    }
  });
}

void CarriedLight::read(int tile, int packet, PacketIrradiance& out) const {
  const size_t at = static_cast<size_t>(tile) * kPacketsPerTile + static_cast<size_t>(packet);
  for (size_t lane = 0; lane < kLanes; ++lane) {
    if ((now_.lanes[at] >> lane & 1) == 0) continue;
    const vec3& e = now_.e[at * kLanes + lane];
    out.r[lane] = e.r;
    out.g[lane] = e.g;
    out.b[lane] = e.b;
  }
}

size_t CarriedLight::bytes() const {
  return (last_.e.size() + now_.e.size()) * sizeof(vec3) + last_.lanes.size() + now_.lanes.size();
}

}  // namespace lamplighter::cpu
