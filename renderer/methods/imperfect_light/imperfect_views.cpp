#include "renderer/methods/imperfect_light/imperfect_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/shadow_maps/shadow_maps.h"
#include "renderer/scene/surface.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

// Display colours.
constexpr vec3 kGround{0.08f, 0.09f, 0.10f}, kChosen{1.0f, 0.85f, 0.30f},
    kFilled{0.25f, 0.55f, 0.95f}, kNew{0.95f, 0.78f, 0.26f}, kOld{0.25f, 0.33f, 0.40f},
    kDarkError{0.85f, 0.25f, 0.20f}, kLitError{0.25f, 0.55f, 0.95f};
constexpr float kDecades = 4.0f;      // of importance
constexpr float kLargestDisc = 0.5f;  // white in the view of density [m]
constexpr int kMapsAcross = 4, kMapsDown = 3;
constexpr size_t kErrorLights = 16;
constexpr int kErrorBlock = 4;  // pixels
constexpr float kErrorWhite = 0.25f;

void paint(Image8& image, int x, int y, const vec3& colour) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  const vec3 c = glm::clamp(colour, 0.0f, 1.0f);
  for (int k = 0; k < 3; ++k) image.at(x, y)[k] = static_cast<uint8_t>(255.0f * c[k]);
}

Image8 emptyPicture(const View& view) {
  Image8 image(view.width, view.height);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) paint(image, x, y, kGround);
  return image;
}

// The unfolded map, enlarged to the picture.
ViewPicture importanceView(const ImperfectPicture& in) {
  ViewPicture out;
  out.image = emptyPicture(in.view());
  const ReflectiveMap& map = in.map();
  float most = 0.0f;
  for (const float b : in.importance()) most = std::max(most, b);
  std::vector<uint8_t> isChosen(map.size(), 0);
  for (const uint32_t texel : in.lights().texels) isChosen[texel] = 1;
  for (int y = 0; y < out.image.height && most > 0.0f; ++y) {
    for (int x = 0; x < out.image.width; ++x) {
      const int column = x * map.columns() / out.image.width;
      const int row = y * ReflectiveMap::kRows / out.image.height;
      const size_t i = ReflectiveMap::indexOf(column, row);
      const float decades = std::log10(std::max(in.importance()[i], 1e-30f) / most);
      const vec3 grey(std::max(0.0f, 1.0f + decades / kDecades));
      paint(out.image, x, y, isChosen[i] != 0 ? kChosen * (0.3f + 0.7f * grey) : grey);
    }
  }
  out.legend.title = "Contribution of potential samples to the view";
  out.legend.ramp = {vec3(0.0f), vec3(1.0f)};
  out.legend.low = "1/10000";
  out.legend.high = "most";
  out.legend.swatches = {{kChosen, "chosen"}};
  return out;
}

// The points of the first map that the camera sees.
ViewPicture pointView(const ImperfectPicture& in) {
  ViewPicture out;
  out.image = emptyPicture(in.view());
  const OccluderPointArrays& p = in.points().arrays();
  const uint32_t count = std::min(in.points().size(), in.points().options().pointsPerMap);
  const float pixels = 0.5f * static_cast<float>(in.view().height) /
                       std::tan(0.5f * in.view().yfov);  // of a length of 1 at distance 1
  for (uint32_t j = 0; j < count; ++j) {
    if (!(p.area[j] > 0.0f)) continue;
    const vec3 at(p.px[j], p.py[j], p.pz[j]);
    const vec3 image = in.view().project(at);
    if (image.z < in.view().znear) continue;
    const vec3 way = at - in.view().eye;
    if (in.rays().occluded({in.view().eye, 0.0f, way, 0.999f})) continue;
    const float radius = std::sqrt(p.area[j] / kPi) * pixels / image.z;
    const float age = static_cast<float>(in.points().ageOf(j)) / OccluderPoints::kEighths;
    const vec3 colour = glm::mix(kNew, kOld, std::min(age, 1.0f));
    const int reach = std::clamp(static_cast<int>(radius), 1, 40);
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx)
        if (const int d = dx * dx + dy * dy;
            d <= 1 || (d <= reach * reach && d > (reach - 1) * (reach - 1)))
          paint(out.image, static_cast<int>(image.x) + dx, static_cast<int>(image.y) + dy, colour);
  }
  out.legend.title = "Occluder points of a map";
  out.legend.swatches = {{kNew, "drawn in this frame"}, {kOld, "8 frames ago"}};
  return out;
}

// By object and triangle: the index of its group.
std::vector<std::vector<uint32_t>> groupsByTriangle(const RenderScene& scene,
                                                    const OccluderGroups& groups) {
  constexpr uint32_t kNoGroup = 0xffffffffu;
  std::vector<std::vector<uint32_t>> out(scene.objects.size());
  for (size_t i = 0; i < out.size(); ++i) out[i].assign(scene.objects[i].triangleCount(), kNoGroup);
  for (uint32_t g = 0; g < groups.groups().size(); ++g)
    for (const OccluderTriangle& t : groups.trianglesOf(groups.groups()[g]))
      out[groups.groups()[g].object][t.triangle] = g;
  return out;
}

// The size of the disc that a point represents, on each surface.
ViewPicture densityView(const ImperfectPicture& in) {
  ViewPicture out;
  out.image = emptyPicture(in.view());
  const OccluderPoints& points = in.points();
  const auto byTriangle = groupsByTriangle(in.scene(), points.groups());
  tbb::parallel_for(0, out.image.height, [&](int y) {
    for (int x = 0; x < out.image.width; ++x) {
      const vec3 direction =
          in.view().rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const Hit hit = in.rays().intersect({in.view().eye, in.view().znear, direction});
      if (!hit) continue;
      const uint32_t g = byTriangle[hit.object][hit.triangle];
      if (g >= points.groups().groups().size()) continue;
      const float area =
          points.groups().groups()[g].area /
          static_cast<float>(points.importance().probability(g) * points.options().pointsPerMap);
      paint(out.image, x, y, vec3(2.0f * std::sqrt(area / kPi) / kLargestDisc));
    }
  });
  out.legend.title = "Diameter of occluder points";
  out.legend.ramp = {vec3(0.0f), vec3(1.0f)};
  out.legend.low = "0";
  out.legend.high = "0.5 m";
  return out;
}

// Pairs of maps of some lights: by points, and traced beside it.
ViewPicture mapView(const ImperfectPicture& in) {
  ViewPicture out;
  out.image = emptyPicture(in.view());
  const std::span<const SceneVpl> lights = in.lights().lights;
  const ImperfectMapOptions options = in.parameters().interleaved().map;
  const int side = options.resolution;
  const int cell = std::min(out.image.width / (2 * kMapsAcross), out.image.height / kMapsDown) - 2;
  if (cell < 4 || lights.empty()) return out;
  ImperfectMap map(options);
  const auto texels = static_cast<size_t>(side) * static_cast<size_t>(side);
  std::vector<float> traced(texels);
  for (int k = 0; k < kMapsAcross * kMapsDown; ++k) {
    const size_t light = lights.size() * static_cast<size_t>(k) / (kMapsAcross * kMapsDown);
    const std::span<const float> drawn =
        map.render(lights[light].vpl, poolOf(in.points()).of(light));
    cpu::traceShadowMap(in.rays(), lights[light].vpl, side, 0, side, traced);
    float most = 1e-6f;
    for (const float v : traced) most = std::max(most, std::min(v, 2.0f));
    for (int y = 0; y < cell; ++y) {
      for (int x = 0; x < cell; ++x) {
        const size_t i = static_cast<size_t>(y * side / cell) * static_cast<size_t>(side) +
                         static_cast<size_t>(x * side / cell);
        const int left = 2 * (cell + 2) * (k % kMapsAcross), top = (cell + 2) * (k / kMapsAcross);
        const vec3 own(std::sqrt(drawn[i] / most)), real(std::sqrt(traced[i] / most));
        paint(out.image, left + x, top + y, map.isFilled(i) ? kFilled * (0.4f + own) : own);
        paint(out.image, left + cell + x, top + y, real);
      }
    }
  }
  out.legend.title = "Maps of points, and traced maps beside them";
  out.legend.ramp = {vec3(0.0f), vec3(1.0f)};
  out.legend.low = "far";
  out.legend.high = "near";
  out.legend.swatches = {{kFilled, "filled"}};
  return out;
}

// Where shadow maps and rays disagree about the visibility of some lights.
ViewPicture errorView(const ImperfectPicture& in) {
  ViewPicture out;
  out.image = emptyPicture(in.view());
  const std::span<const SceneVpl> lights = in.lights().lights;
  if (lights.empty()) return out;
  const InterleavedOptions options = in.parameters().interleaved();
  ImperfectMap map(options.map);
  std::vector<std::vector<float>> maps;
  std::vector<shared::Vpl> some;
  for (size_t k = 0; k < std::min(kErrorLights, lights.size()); ++k) {
    const size_t light = lights.size() * k / std::min(kErrorLights, lights.size());
    const auto drawn = map.render(lights[light].vpl, poolOf(in.points()).of(light));
    maps.emplace_back(drawn.begin(), drawn.end());
    some.push_back(lights[light].vpl);
  }
  const int rows = (out.image.height + kErrorBlock - 1) / kErrorBlock;
  tbb::parallel_for(0, rows, [&](int row) {
    for (int x = 0; x < out.image.width; x += kErrorBlock) {
      const int y = row * kErrorBlock;
      const vec3 direction =
          in.view().rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const Hit hit = in.rays().intersect({in.view().eye, in.view().znear, direction});
      if (!hit) continue;
      const Surface s = surfaceAt(in.scene(), hit.object, hit.triangle, hit.u, hit.v);
      const vec3 n =
          glm::dot(s.geometricNormal, direction) < 0.0f ? s.geometricNormal : -s.geometricNormal;
      const vec3 at = s.position + rayEpsilon(s.position) * n;
      float pairs = 0.0f, dark = 0.0f, lit = 0.0f;
      for (size_t k = 0; k < some.size(); ++k) {
        if (!(shared::vplGeometry(some[k], at, n, n, in.parameters().clampDistance) > 0.0f))
          continue;
        const vec3 way = vec3(some[k].position) - at;
        const bool isBlocked = in.rays().occluded({at, 0.0f, way, 1.0f});
        const bool isStored = isInShadow(some[k], maps[k], at, n, options.shadowBias);
        pairs += 1.0f;
        dark += isStored && !isBlocked ? 1.0f : 0.0f;
        lit += !isStored && isBlocked ? 1.0f : 0.0f;
      }
      if (!(pairs > 0.0f)) continue;
      const vec3 colour = (dark * kDarkError + lit * kLitError) / (pairs * kErrorWhite);
      for (int dy = 0; dy < kErrorBlock; ++dy)
        for (int dx = 0; dx < kErrorBlock; ++dx) paint(out.image, x + dx, y + dy, colour);
    }
  });
  out.legend.title = "Look-ups that differ from rays; full colour: 25%";
  out.legend.swatches = {{kDarkError, "dark instead of lit"}, {kLitError, "lit instead of dark"}};
  return out;
}

struct ImperfectDrawing {
  MethodView view;
  ViewPicture (*draw)(const ImperfectPicture& in);
};

const std::vector<ImperfectDrawing>& imperfectDrawings() {
  static const std::vector<ImperfectDrawing> all{
      {{"pvpl_importance", "Importance of potential samples",
        "The reflective map of all lights, unfolded: the contribution of each potential light "
        "sample to the view, without occlusion, and which samples are chosen."},
       importanceView},
      {{"blocker_points", "Occluder points",
        "The points from which one shadow map is drawn, with the size of the surface that each "
        "represents, and how many frames ago they were placed."},
       pointView},
      {{"occluder_density", "Size of occluder points",
        "Size of the points that represent each surface: dark where points are dense."},
       densityView},
      {{"imperfect_map", "Imperfect shadow maps",
        "Shadow maps of some light samples, drawn from points, and ray-traced shadow maps beside "
        "them."},
       mapView},
      {{"visibility_error", "Errors of imperfect maps",
        "How often imperfect shadow maps disagree with rays about the visibility of some light "
        "samples."},
       errorView}};
  return all;
}

}  // namespace

const std::vector<MethodView>& imperfectViews() {
  static const std::vector<MethodView> views = [] {
    std::vector<MethodView> all;
    std::ranges::transform(imperfectDrawings(), std::back_inserter(all), &ImperfectDrawing::view);
    return all;
  }();
  return views;
}

std::map<std::string, std::function<ViewPicture()>> imperfectPictures(
    const ImperfectPicture& picture) {
  std::map<std::string, std::function<ViewPicture()>> out;
  for (const ImperfectDrawing& drawing : imperfectDrawings())
    out[drawing.view.name] = [&picture, draw = drawing.draw] {
      if (picture.isReady()) return draw(picture);
      ViewPicture none;
      none.image = emptyPicture(picture.view());
      none.problem = "there is no bounced light";
      return none;
    };
  return out;
}

}  // namespace lamplighter
