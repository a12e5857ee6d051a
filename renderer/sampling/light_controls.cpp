#include "renderer/sampling/light_controls.h"

#include "renderer/sampling/path_tracing.h"
#include "renderer/scene/reference_brightness.h"

namespace lamplighter {

LightControls::LightControls(const RenderScene& scene, const LightSet& lights)
    : ofObject(scene.objects.size(), kNone) {
  const std::vector<VplId> ids = emitterIds(lights);
  std::map<std::pair<NodeId, int>, int> ofSurface;  // by node and material, lit or dark
  for (size_t i = 0; i < ids.size(); ++i) {
    const Emitter& e = lights.emitters()[i];
    int control = kNone;
    Key key;
    if (e.kind == EmitterKind::sky) control = ofSky;
    if (e.kind == EmitterKind::punctual) key = {Key::Kind::punctual, e.node};
    if (e.kind == EmitterKind::surface) {
      const int material = scene.objects[e.object].material;
      const int lit = material >= scene.firstDark ? material - scene.firstDark : material;
      key = {Key::Kind::surfaces, e.node, lit};
      control = ofSurface.emplace(std::pair(e.node, lit), static_cast<int>(controls.size()))
                    .first->second;
      ofObject[e.object] = control;
    }
    if (control == kNone) control = static_cast<int>(controls.size());
    if (static_cast<size_t>(control) == controls.size())
      controls.push_back({key, e.gain, e.reference, 0.0f});
    if (e.kind == EmitterKind::sky) ofSky = control;
    controls[static_cast<size_t>(control)].flux += e.referenceFlux;
    ofEmitter[ids[i]] = static_cast<uint32_t>(control);
  }
  // A sky is visible without a scene, too.
  if (ofSky != kNone || scene.nominalSky.isBlack()) return;
  ofSky = static_cast<int>(controls.size());
  const float reference = referenceBrightness(scene.nominalSky.factor());
  const vec3 factor = scene.sky.isBlack() ? vec3(0.0f) : scene.sky.factor();
  controls.push_back({Key(), factor / reference, reference, 0.0f});
}

}  // namespace lamplighter
