#include "renderer/debug_views/view_picture.h"

#include "renderer/backends/many_lights_kernels.h"
#include "renderer/debug_views/debug_views.h"
#include "renderer/debug_views/painter.h"
#include "renderer/image/tone_map.h"
#include "renderer/registry/registry.h"

namespace lamplighter {
namespace {

vec3 encoded(const vec3& linear) {
  return {encodeSrgb(linear.r), encodeSrgb(linear.g), encodeSrgb(linear.b)};
}

vec3 flatColour(const Seen& s) {
  const vec3& e = s.surface.emission;
  const float brightest = std::max({e.r, e.g, e.b});
  if (brightest > 0.0f && (s.front || s.surface.emitsBothSides)) return encoded(e / brightest);
  return encoded(s.surface.albedo * (0.15f + 0.85f * s.facing));
}

}  // namespace

ViewPicture views::albedo(const ViewSubject& in) {
  return {Painter(in).paint([](const Seen& s, size_t) { return encoded(s.surface.albedo); })};
}

ViewPicture views::normals(const ViewSubject& in) {
  return {Painter(in).paint([](const Seen& s, size_t) { return 0.5f + 0.5f * s.normal; })};
}

ViewPicture views::flat(const ViewSubject& in) {
  return {Painter(in).paint([](const Seen& s, size_t) { return flatColour(s); })};
}

NodeId nodeOfSample(const Inspection& inspection, int chosenLight) {
  if (inspection.lights.empty()) return kNoNode;
  const size_t last = inspection.lights.size() - 1;
  return inspection.lights[std::min(static_cast<size_t>(std::max(chosenLight, 0)), last)].id.light;
}

namespace {

// Checks the data that the frame provides in addition to the inspection.
std::string problemOf(DebugView view, const ViewSubject& in) {
  if (view == DebugView::shadowMap && in.shadowMap.empty())
    return "the chosen light sample has no shadow map, because no visible pixel needs one";
  if (view == DebugView::edgeMask && in.interpolated.empty())
    return "it needs block above 1 and the technique visibility or light_maps of many_lights, and "
           "once "
           "the picture is settled share_memory=0";
  if (view == DebugView::falseColour && in.radiance == nullptr) return "nothing is rendered yet";
  return "";
}

// "it needs texels: choose many_lights with the technique light_maps".
std::string whatIsMissing(Capability capability) {
  const std::string who = methodsThatShow(capability);
  return std::string("it needs ") + nameOf(capability) + (who.empty() ? "" : ": choose ") + who;
}

}  // namespace

std::string problemOf(DebugView view, const Inspection& inspection) {
  const DebugViewInfo& info = infoOf(view);
  for (const Capability capability : info.needs)
    if (!inspection.has(capability)) return whatIsMissing(capability);
  if (!info.method.empty() && !inspection.pictures.contains(info.name))
    return "it is a view of the method " + info.method;
  return "";
}

void takeFromBackend(DebugView view, Backend& backend, RadianceImage& radiance, ViewSubject& in) {
  if (view == DebugView::falseColour) in.radiance = &radiance.pixels();
  auto* kernels = backend.kernelsInUse<ManyLightsKernels>();
  if (kernels == nullptr) return;
  if (view == DebugView::edgeMask) in.interpolated = kernels->readInterpolated();
  const auto& lights = in.inspection.lights;
  if (view != DebugView::shadowMap || lights.empty()) return;
  const auto chosen = static_cast<size_t>(std::max(in.chosenLight, 0));
  const LightSample& light = lights[std::min(chosen, lights.size() - 1)];
  if (light.isLive && light.vpl.slot >= 0) in.shadowMap = kernels->readShadowMap(light.vpl.slot);
}

ViewPicture drawView(DebugView view, const ViewSubject& in) {
  std::string problem = problemOf(view, in.inspection);
  if (problem.empty()) problem = problemOf(view, in);
  if (!problem.empty()) {
    ViewPicture out = views::flat(in);
    out.problem = problem;
    return out;
  }
  const DebugViewInfo& info = infoOf(view);
  if (info.draw != nullptr) return info.draw(in);
  return isRadiance(view) ? views::flat(in) : in.inspection.pictures.at(info.name)();
}

}  // namespace lamplighter
