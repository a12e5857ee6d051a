#include "renderer/views/view_picture.h"

#include "renderer/image/tone_map.h"
#include "renderer/views/painter.h"
#include "renderer/views/views.h"

namespace lamplighter {
namespace {

const char* const kNeedsVisibility =
    "it needs the technique visibility or light_maps of many_lights";
const char* const kNeedsLightMaps = "it needs the technique light_maps of many_lights";
const char* const kNeedsLights = "it needs the light samples of many_lights";

vec3 encoded(const vec3& linear) {
  return {encodeSrgb(linear.r), encodeSrgb(linear.g), encodeSrgb(linear.b)};
}

vec3 flatColour(const Seen& s) {
  const vec3& e = s.surface.emission;
  const float brightest = std::max({e.r, e.g, e.b});
  if (brightest > 0.0f && (s.front || s.surface.emitsBothSides)) return encoded(e / brightest);
  return encoded(s.surface.albedo * (0.15f + 0.85f * s.facing));
}

ViewPicture flat(const ViewSubject& in) {
  return {Painter(in).paint([](const Seen& s, size_t) { return flatColour(s); }), {}, ""};
}

}  // namespace

std::string problemOf(DebugView view, const Inspection& inspection) {
  switch (view) {
    case DebugView::patches:
    case DebugView::patchLevels:
    case DebugView::partialLights:
      return inspection.visibility == nullptr ? kNeedsVisibility : "";
    case DebugView::occlusion:
      if (inspection.visibility == nullptr) return kNeedsVisibility;
      return inspection.lights.empty() ? "the level has no light sample" : "";
    case DebugView::lightMaps:
      return inspection.lightMaps == nullptr ? kNeedsLightMaps : "";
    case DebugView::mapAge:
      return inspection.lights.empty() ? kNeedsLights : "";
    default:
      return "";
  }
}

ViewPicture drawView(DebugView view, const ViewSubject& in) {
  if (const std::string problem = problemOf(view, in.inspection); !problem.empty()) {
    ViewPicture out = flat(in);
    out.problem = problem;
    return out;
  }
  switch (view) {
    case DebugView::albedo:
      return {Painter(in).paint([](const Seen& s, size_t) { return encoded(s.surface.albedo); }),
              {},
              ""};
    case DebugView::normals:
      return {
          Painter(in).paint([](const Seen& s, size_t) { return 0.5f + 0.5f * s.normal; }), {}, ""};
    case DebugView::patches:
      return views::patches(in);
    case DebugView::patchLevels:
      return views::patchLevels(in);
    case DebugView::occlusion:
      return views::occlusion(in);
    case DebugView::partialLights:
      return views::partialLights(in);
    case DebugView::lightMaps:
      return views::lightMaps(in);
    case DebugView::mapAge:
      return views::mapAge(in);
    case DebugView::lit:
    case DebugView::lightOnly:
    case DebugView::flat:
      break;
  }
  return flat(in);
}

}  // namespace lamplighter
