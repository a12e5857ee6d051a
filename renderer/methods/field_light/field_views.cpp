#include "renderer/methods/field_light/field_views.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

// Number of crossings that is shown as white.
constexpr float kManyCrossings = 16.0f;

uint8_t displayed(float linear) {
  const float c = std::clamp(linear, 0.0f, 1.0f);
  return static_cast<uint8_t>(255.0f * std::pow(c, 1.0f / 2.2f) + 0.5f);
}

void setPixel(Image8& image, size_t pixel, const vec3& colour) {
  for (int c = 0; c < 3; ++c)
    image.pixels[4 * pixel + static_cast<size_t>(c)] = displayed(colour[c]);
}

// Exposure with which the mean light of texels is middle grey.
float exposureOf(const PartnerRadiance& sent) {
  double sum = 0.0;
  size_t count = 0;
  for (const vec4& radiance : sent) {
    const float l = luminance(vec3(radiance));
    if (l <= 0.0f) continue;
    sum += static_cast<double>(l);
    ++count;
  }
  return sum > 0.0 ? static_cast<float>(0.2 * static_cast<double>(count) / sum) : 1.0f;
}

ViewPicture emptyView(const FieldViewSubject& in, const char* title) {
  ViewPicture out;
  out.image = Image8(in.picture.view().width, in.picture.view().height);
  out.legend.title = title;
  return out;
}

// The direction nearest to the viewing direction.
size_t directionOfView(const FieldViewSubject& in) {
  const vec3 ahead = in.picture.view().orientation * vec3(0.0f, 0.0f, -1.0f);
  const FieldDirections::Triple triple = in.light.directions().tripleOf(ahead);
  const auto nearest = std::ranges::max_element(triple.weights) - triple.weights.begin();
  return triple.directions[static_cast<size_t>(nearest)];
}

ViewPicture texelsOfField(const FieldViewSubject& in) {
  ViewPicture view = emptyView(in, "Texels of the field");
  const std::vector<uint32_t> texels = in.picture.texels();
  for (size_t i = 0; i < texels.size(); ++i)
    if (texels[i] < in.light.texels().size())
      setPixel(view.image, i,
               vec3(static_cast<float>(hash4(texels[i], 0, 0, 0x7e) % 1000u) / 1000.0f));
  return view;
}

// How many surfaces the line through each visible texel crosses.
ViewPicture lines(const FieldViewSubject& in) {
  ViewPicture view = emptyView(in, "Crossings of a line");
  view.legend.ramp = {vec3(0.0f), vec3(1.0f)};
  view.legend.low = "0";
  view.legend.high = std::to_string(static_cast<int>(kManyCrossings));
  const std::vector<uint32_t> texels = in.picture.texels();
  if (in.light.receivers().empty()) return view;
  const FieldGeometry geometry = in.light.geometryOf(in.scene, in.rays);
  LineRaster raster;
  raster.draw(in.scene, geometry.surface, gridOf(geometry, directionOfView(in)));
  for (size_t i = 0; i < texels.size(); ++i) {
    if (texels[i] >= in.light.receivers().size()) continue;
    const vec3 at = raster.grid().toGrid(in.light.receivers()[texels[i]].position);
    const auto crossings =
        raster.at(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
    setPixel(view.image, i, vec3(static_cast<float>(crossings.size()) / kManyCrossings));
  }
  return view;
}

// The picture on the grid of lines of one direction: the light that surfaces send back along it
// (paper 5, figure 2c).
ViewPicture direction(const FieldViewSubject& in) {
  ViewPicture view = emptyView(in, "Light along one direction");
  if (in.light.receivers().empty() || in.light.sent().empty()) return view;
  const FieldGeometry geometry = in.light.geometryOf(in.scene, in.rays);
  const size_t number = directionOfView(in);
  LineGrid grid = gridOf(geometry, number);
  const float exposure = exposureOf(in.light.sent());
  // Lines along the view: from the camera, those that face it.
  const bool isAhead =
      glm::dot(grid.along, in.picture.view().orientation * vec3(0.0f, 0.0f, -1.0f)) > 0.0f;
  LineRaster raster;
  raster.draw(in.scene, geometry.surface, grid);
  const vec3 centre = grid.toGrid(in.picture.view().eye);
  const int width = view.image.width, height = view.image.height;
  // The cell size in pixels is chosen so that the whole level is visible.
  const float cells = 2.0f * in.scene.bounds.radius() / grid.cell;
  const float scale = std::max(1.0f, cells) / static_cast<float>(height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const vec2 at = vec2(centre) + scale * vec2(static_cast<float>(x - width / 2),
                                                  static_cast<float>(height / 2 - y));
      const auto crossings =
          raster.at(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
      // The nearest surface beyond the camera.
      const LineTriangle* seen = nullptr;
      float nearest = std::numeric_limits<float>::infinity();
      for (const LineCrossing& c : crossings) {
        const float far = (isAhead ? 1.0f : -1.0f) * (c.depth - centre.z);
        if (far <= 0.0f || far >= nearest) continue;
        nearest = far;
        seen = &raster.triangle(c.triangle);
      }
      if (seen == nullptr || !seen->hasTexels) continue;
      const uint32_t texel =
          geometry.surface.texelAt(seen->object, seen->facesAlong == isAhead, seen->texelsAt(at));
      if (texel < in.light.receivers().size())
        setPixel(view.image,
                 static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x),
                 exposure * vec3(in.light.sent()[texel]));
    }
  }
  return view;
}

// The incident light of the texel in the middle of the picture: the disc of its hemisphere from
// above, in an equal-area projection.
ViewPicture incident(const FieldViewSubject& in) {
  ViewPicture view = emptyView(in, "Light that arrives in the middle of the picture");
  const int width = view.image.width, height = view.image.height;
  const std::vector<uint32_t> texels = in.picture.texels();
  const size_t middle =
      static_cast<size_t>(height / 2) * static_cast<size_t>(width) + static_cast<size_t>(width / 2);
  if (middle >= texels.size() || texels[middle] >= in.light.receivers().size() ||
      in.light.sent().empty())
    return view;
  const uint32_t texel = texels[middle];
  const FieldReceiver& at = in.light.receivers()[texel];
  std::vector<const uint32_t*> rows(in.light.directions().size(), nullptr);
  for (const PartnerRow& row : in.light.partners().rows()) rows[row.direction] = row.partners;
  const Frame frame(at.geometricNormal);
  const float exposure = exposureOf(in.light.sent()), radius = 0.48f * static_cast<float>(height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const vec2 p =
          vec2(static_cast<float>(x - width / 2), static_cast<float>(height / 2 - y)) / radius;
      const float r2 = glm::dot(p, p);
      if (r2 > 1.0f) continue;
      const float side = std::sqrt(2.0f - r2);
      const FieldDirections::Triple triple =
          in.light.directions().tripleOf(frame.toWorld({side * p.x, side * p.y, 1.0f - r2}));
      vec3 sum(0.0f);
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t* row = rows[triple.directions[k]];
        if (row != nullptr) sum += triple.weights[k] * vec3(in.light.sent()[row[texel]]);
      }
      setPixel(view.image,
               static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x),
               exposure * sum);
    }
  }
  return view;
}

struct FieldDrawing {
  MethodView view;
  ViewPicture (*draw)(const FieldViewSubject& in);
};

const std::vector<FieldDrawing>& fieldDrawings() {
  static const std::vector<FieldDrawing> all{
      {{"field_texels", "Texels of the field",
        "The texels that store the light of the field, each in a different shade."},
       texelsOfField},
      {{"field_lines", "Crossings of lines",
        "How many surfaces the line of each texel crosses, along the direction of the field that "
        "is nearest to the direction of view."},
       lines},
      {{"field_direction", "One direction",
        "The light along one direction of the field, the nearest to the direction of view, on its "
        "grid of parallel lines."},
       direction},
      {{"field_incident", "Light that arrives",
        "The light that arrives from all directions at the texel in the middle of the picture."},
       incident}};
  return all;
}

}  // namespace

const std::vector<MethodView>& fieldViews() {
  static const std::vector<MethodView> views = [] {
    std::vector<MethodView> all;
    std::ranges::transform(fieldDrawings(), std::back_inserter(all), &FieldDrawing::view);
    return all;
  }();
  return views;
}

ViewPicture drawFieldView(std::string_view name, const FieldViewSubject& in) {
  return std::ranges::find(fieldDrawings(), name,
                           [](const FieldDrawing& d) { return std::string_view(d.view.name); })
      ->draw(in);
}

}  // namespace lamplighter
