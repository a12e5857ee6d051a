#include "renderer/bake/gathered_light.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/bake/inside.h"
#include "renderer/surface_depths/link_walk.h"
#include "renderer/surface_light/form_factor.h"

namespace lamplighter {
namespace {

constexpr uint64_t kRaysAtATime = uint64_t{1} << 24;
// Maximum number of surfaces of other objects in front of that of a texel.
constexpr int kMostCovers = 4;
// Distance, in sides of the texel, below which the form factors of its quarters are summed.
constexpr float kNearGather = 6.0f;

std::array<vec3, 4> quarterOf(const SurfaceTexel& texel, size_t k) {
  const vec3 x = 0.5f * texel.half[0], y = 0.5f * texel.half[1];
  const vec3 at =
      texel.spot.position + (k % 2 == 0 ? -1.0f : 1.0f) * x + (k / 2 == 0 ? -1.0f : 1.0f) * y;
  return {at - x - y, at + x - y, at + x + y, at - x + y};
}

vec3 middleOf(const std::array<vec3, 4>& rectangle) { return 0.5f * (rectangle[0] + rectangle[2]); }

// The place on the side of a texel's object that is nearest below or above a point; no triangle if
// there is none within a texel.
std::optional<SurfacePlace> placeAt(const RenderScene& scene, const RayCaster& rays,
                                    const SurfaceTexel& texel, const vec3& point) {
  const float height = glm::length(texel.half[0]) + glm::length(texel.half[1]);
  const vec3& up = texel.spot.geometricNormal;
  Ray ray{point + 0.5f * height * up, 0.0f, -up, height};
  for (int i = 0; i < kMostCovers; ++i) {
    const Hit hit = rays.intersect(ray);
    if (!hit) break;
    const uint32_t triangles = scene.objects[texel.object].triangleCount();
    const uint32_t side = texel.place.triangle >= triangles ? triangles : 0;
    if (hit.object == texel.object && isOnBack(scene, hit, ray.direction) == (side != 0))
      return SurfacePlace{hit.triangle + side, hit.u, hit.v};
    ray.tNear = hit.t + rayEpsilon(ray.origin + hit.t * ray.direction);
  }
  return std::nullopt;
}

}  // namespace

GatheredLight::GatheredLight(const RenderScene& scene, const RayCaster& rays,
                             const DirectLight& direct, const TexelRadiosityOptions& options)
    : scene_(scene), rays_(rays), options_(options), side_(texelSideOf(scene, options)) {
  if (options.bounces == 0) return;
  ObjectCharts charts{std::filesystem::path()};
  const auto atlases = charts.find(scene, 1.0f / side_);
  atlases_.assign(atlases.begin(), atlases.end());
  texels_ = TexelSet(scene, atlases_, options.order);
  tree_ = TexelTree(texels_);
  if (options.visibility == TexelVisibility::stored) {
    depths_.restart(scene, texels_, options.map);
    while (!depths_.isDone()) depths_.goOn(scene, rays, texels_, kRaysAtATime);
  }
  bounce(findPoints(direct));
}

// Returns the direct light of the texels: the mean over their open quarters [W/m²].
std::vector<vec3> GatheredLight::findPoints(const DirectLight& direct) {
  quarters_.resize(texels_.size());
  std::vector<vec3> light(texels_.size(), vec3(0.0f));
  tbb::parallel_for(size_t{0}, texels_.size(), [&](size_t t) {
    const SurfaceTexel& texel = texels_[t];
    Quarters& quarters = quarters_[t];
    std::array<std::optional<SurfacePlace>, 4> places;
    for (size_t k = 0; k < 4; ++k)
      places[k] = placeAt(scene_, rays_, texel, middleOf(quarterOf(texel, k)));
    // Smaller than a texel.
    if (std::ranges::none_of(places, [](const auto& p) { return p.has_value(); }))
      places.fill(texel.place);
    float open = 0.0f, all = 0.0f;
    for (size_t k = 0; k < 4; ++k) {
      if (!places[k]) continue;
      const SurfaceSpot spot = spotAt(scene_, texel.object, *places[k]);
      const ReceivingPlace at{spot.position, spot.geometricNormal, spot.normal,
                              scene_.objects[texel.object].leftOutBy};
      all += 1.0f;
      quarters.at[k] = spot.position;
      quarters.isOpen[k] = !isInside(scene_, rays_, at, static_cast<uint32_t>(4 * t + k));
      if (!quarters.isOpen[k]) continue;
      open += 1.0f;
      light[t] += direct.irradiance(at);
    }
    quarters.share = open / all;
    if (open > 0.0f) light[t] /= open;
  });
  return light;
}

// All bounces but the last one, which is gathered where it is asked for.
void GatheredLight::bounce(const std::vector<vec3>& direct) {
  std::vector<vec3> irradiance = direct;
  reflected_.resize(texels_.size());
  for (int b = 1;; ++b) {
    tbb::parallel_for(size_t{0}, reflected_.size(), [&](size_t t) {
      const SurfaceTexel& texel = texels_[t];
      reflected_[t] = albedoAt(scene_, texel.object, texel.place) * irradiance[t];
    });
    fillClosed();
    if (b == options_.bounces) return;
    tbb::parallel_for(size_t{0}, reflected_.size(), [&](size_t t) {
      if (quarters_[t].share == 0.0f) return;
      SurfaceSpot spot = texels_[t].spot;
      if (quarters_[t].share < 1.0f) spot.position = quarters_[t].any(0);
      irradiance[t] = direct[t] + gathered(spot, static_cast<uint32_t>(t));
    });
  }
}

// Texels without an open quarter reflect what open ones beside them do, for places that they touch.
void GatheredLight::fillClosed() {
  tbb::parallel_for(size_t{0}, texels_.size(), [&](size_t t) {
    const SurfaceTexel& texel = texels_[t];
    if (quarters_[t].share > 0.0f) return;
    const bool isBack = texel.place.triangle >= scene_.objects[texel.object].triangleCount();
    vec3 sum(0.0f);
    float count = 0.0f;
    for (const int x : {-1, 0, 1}) {
      for (const int y : {-1, 0, 1}) {
        const vec2 beside = vec2(texel.at + glm::ivec2(x, y)) + 0.5f;
        const uint32_t other = texels_.texelAt(texel.object, isBack, beside);
        if (other == TexelSet::kNone || quarters_[other].share == 0.0f) continue;
        sum += reflected_[other];
        count += 1.0f;
      }
    }
    reflected_[t] = count > 0.0f ? sum / count : vec3(0.0f);
  });
}

uint32_t GatheredLight::texelAt(uint32_t object, uint32_t triangle, const vec3& position) const {
  const ObjectAtlas& own = atlases_[object];
  if (!own.atlas || own.atlas->chartOfTriangle[triangle] == kNone) return TexelSet::kNone;
  return texels_.texelAt(object, false, own.texelsOf(triangle, position));
}

// Area lights block, too: in a bake they do not move.
bool GatheredLight::sees(const SurfaceSpot& spot, uint32_t texel, const vec3& point) const {
  // The spot has no depths; those of the texel tell the same.
  if (options_.visibility == TexelVisibility::stored)
    return depths_.sees(texels_[texel], texel, spot.rayOrigin());
  const vec3 from = spot.rayOrigin(), d = point - from;
  return glm::dot(d, spot.geometricNormal) > 0.0f && !rays_.occluded({from, 0.0f, d, 1.0f - 1e-3f});
}

// A single texel is seen at its open quarters.
void GatheredLight::addTexel(const SurfaceSpot& spot, uint32_t texel, float factor,
                             Sum& sum) const {
  const SurfaceTexel& t = texels_[texel];
  const vec3 d = t.spot.position - spot.position;
  if (glm::dot(d, d) < kNearGather * kNearGather * t.area) {
    for (size_t k = 0; k < 4; ++k) addQuarter(spot, texel, k, sum);
    return;
  }
  const Quarters& quarters = quarters_[texel];
  float open = 0.0f, seen = 0.0f;
  for (size_t k = 0; k < 4; ++k) {
    if (!quarters.isOpen[k]) continue;
    open += 1.0f;
    seen += sees(spot, texel, quarters.at[k]) ? 1.0f : 0.0f;
  }
  if (seen > 0.0f) sum.add(factor * quarters.share * seen / open, reflected_[texel]);
}

// Near a spot each quarter has a form factor of its own. Where its middle is behind the spot or
// inside of an object, as below the edge of a box on a floor, the part before the spot counts if it
// touches the spot.
void GatheredLight::addQuarter(const SurfaceSpot& spot, uint32_t texel, size_t k, Sum& sum) const {
  const auto corners = quarterOf(texels_[texel], k);
  const auto height = [&](const vec3& p) {
    return glm::dot(p - spot.position, spot.geometricNormal);
  };
  vec3 point = quarters_[texel].at[k];
  if (!quarters_[texel].isOpen[k] || height(point) <= 0.0f) {
    const vec3 way = middleOf(corners) - spot.position;
    if (glm::dot(way, way) > texels_[texel].area) return;
    vec3 before(0.0f);
    float count = 0.0f;
    for (const vec3& corner : corners) {
      if (height(corner) <= 0.0f) continue;
      before += corner;
      count += 1.0f;
    }
    if (count == 0.0f) return;
    point = before / count;
  }
  if (sees(spot, texel, point))
    sum.add(polygonFactor(spot.position, spot.normal, corners) / kPi, reflected_[texel]);
}

// A few texels represent all texels of the node, each with its own form factor and light: dark
// texels are often the hidden ones, such as the floor under a table.
void GatheredLight::addNode(const SurfaceSpot& spot, const TexelTree::Node& node, Sum& sum) const {
  float area = 0.0f;
  forEachTested(tree_, node, [&](uint32_t t) { area += texels_[t].area; });
  if (area <= 0.0f) return;
  forEachTested(tree_, node, [&](uint32_t t) {
    const SurfaceTexel& texel = texels_[t];
    const vec3 d = texel.spot.position - spot.position;
    const float here = glm::dot(spot.normal, d), there = -glm::dot(texel.spot.normal, d);
    const Quarters& quarters = quarters_[t];
    if (here <= 0.0f || there <= 0.0f || quarters.share == 0.0f) return;
    if (!sees(spot, t, quarters.any(t))) return;
    const float d2 = glm::dot(d, d);
    sum.add(quarters.share * here * there * texel.area / (kPi * d2 * d2) * node.area / area,
            reflected_[t]);
  });
}

vec3 GatheredLight::gathered(const SurfaceSpot& spot, uint32_t texel) const {
  Sum sum;
  walkLinks(spot, texel, texels_, tree_, options_.linkError, [&](uint32_t n, float factor) {
    const TexelTree::Node& node = tree_[n];
    if (node.isLeaf())
      addTexel(spot, tree_.texelOf(node), factor, sum);
    else
      addNode(spot, node, sum);
  });
  // More than all of the hemisphere is seen where surfaces coincide.
  return sum.weights > 1.0f ? sum.light / sum.weights : sum.light;
}

vec3 GatheredLight::irradiance(uint32_t object, uint32_t triangle, const ReceivingPlace& at) const {
  if (options_.bounces == 0) return vec3(0.0f);
  return gathered({at.position, at.shadingNormal, at.normal},
                  texelAt(object, triangle, at.position));
}

}  // namespace lamplighter
