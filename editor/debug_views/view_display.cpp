#include "editor/debug_views/view_display.h"

#include <algorithm>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "renderer/base/error.h"

namespace lamplighter {

void ViewDisplay::choose(const Inspection& inspection, int index) {
  const auto count = static_cast<int>(inspection.lights.size());
  if (index < 0 || index >= count)
    throw InputError("light sample " + std::to_string(index), "does not exist",
                     count == 0 ? "render with many_lights first"
                                : "give one from 0 to " + std::to_string(count - 1));
  chosen_ = inspection.lights[static_cast<size_t>(index)].id;
}

int ViewDisplay::chosen(const Inspection& inspection) const {
  const auto& lights = inspection.lights;
  if (lights.empty()) return kNone;
  const auto found = std::find_if(lights.begin(), lights.end(), [&](const LightSample& light) {
    return chosen_ && light.id == *chosen_;
  });
  return found == lights.end() ? 0 : static_cast<int>(found - lights.begin());
}

bool ViewDisplay::lightOnly() const {
  return view_ == DebugView::lightOnly || (view_ == DebugView::falseColour && falseColour_.isLux);
}

LightPart ViewDisplay::part() const {
  if (view_ == DebugView::direct) return LightPart::direct;
  return view_ == DebugView::indirect ? LightPart::indirect : LightPart::all;
}

NodeId ViewDisplay::chosenLight(const Inspection& inspection) const {
  const bool isThere =
      light_ && std::any_of(inspection.lights.begin(), inspection.lights.end(),
                            [&](const LightSample& l) { return l.id.light == *light_; });
  return isThere ? *light_ : nodeOfSample(inspection, chosen(inspection));
}

void ViewDisplay::update(FrameRenderer& renderer, RadianceImage& radiance, const View& camera,
                         const RenderSettings& settings, bool changed) {
  if (isRadiance(view_) || renderer.rays() == nullptr) {
    picture_.reset();
    return;
  }
  const Inspection inspection = renderer.inspect();
  Key key{view_,
          camera,
          settings,
          chosen(inspection),
          toneMapper_,
          falseColour_,
          chosenLight(inspection)};
  if (picture_ && !changed && key == key_) return;
  key_ = std::move(key);
  const View view = renderer.world().viewOf(camera);
  ViewSubject subject{
      renderer.scene(),    *renderer.rays(), view,       inspection,  std::max(key_.chosen, 0),
      settings.exposureEv, toneMapper_,      key_.light, falseColour_};
  takeFromBackend(view_, renderer.backend(), radiance, subject);
  picture_ = std::make_shared<ViewPicture>(drawView(view_, subject));
}

const Histogram& ViewDisplay::histogram(const std::shared_ptr<RadianceImage>& radiance,
                                        float exposureEv) {
  if (radiance &&
      (radiance != countedFrom_ || exposureEv != countedEv_ || toneMapper_ != countedBy_)) {
    histogram_ = histogramOf(radiance->pixels(), exposureEv, toneMapper_);
    countedFrom_ = radiance;
    countedEv_ = exposureEv;
    countedBy_ = toneMapper_;
  }
  return histogram_;
}

std::string ViewDisplay::viewText() const {
  if (view_ == DebugView::lit) return "";
  const std::string label = infoOf(view_).label;
  return picture_ && !picture_->problem.empty() ? label + ": " + picture_->problem : label;
}

std::string ViewDisplay::vplText(const Scene& scene, const Inspection& inspection,
                                 float unit) const {
  const int index = chosen(inspection);
  if (index == kNone ||
      (!showsVpls_ && view_ != DebugView::occlusion && view_ != DebugView::shadowMap))
    return "";
  const LightSample& light = inspection.lights[static_cast<size_t>(index)];
  const Node* node = scene.find(light.id.light);
  const bool isParallel = light.vpl.position.w == shared::kVplDirectional;
  const vec3 intensity = (isParallel ? 1.0f : unit * unit) * vec3(light.vpl.intensity);
  std::string text = fmt::format("VPL {} of {}", index, inspection.lights.size());
  if (node != nullptr) text += fmt::format(", {}", node->name.empty() ? "unnamed" : node->name);
  text +=
      light.id.bounce == 0 ? std::string(", direct") : fmt::format(", bounce {}", light.id.bounce);
  text += fmt::format(", {:.3g} {}", std::max({intensity.r, intensity.g, intensity.b}),
                      isParallel ? "W/m\u00b2" : "W/sr");
  if (light.isStale)
    text +=
        fmt::format(", waits {} frame{}", light.framesWaiting, light.framesWaiting == 1 ? "" : "s");
  return text;
}

}  // namespace lamplighter
