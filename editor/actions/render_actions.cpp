#include <algorithm>

#include "editor/actions/arguments.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"
#include "renderer/image/exposure.h"
#include "renderer/registry/registry.h"

namespace lamplighter {

void addRenderActions(ActionRegistry& r) {
  r.add({"render.method", "Method", "NAME", "Renders with another method.", "",
         [](Session& s, const Arguments& a) {
           RenderSettings settings = s.document().render;
           settings.method = runnableMethod(a[0], s.renderer().backend()).name;
           s.setRender(settings);
         }});
  r.add({"render.reference", "Reference", "",
         "Switches between the path-traced reference and the previous method. The reference needs "
         "many frames to converge.",
         "Space", [](Session& s, const Arguments&) { s.toggleReference(); }});
  r.add({"render.reload_shaders", "Reload shaders", "",
         "Reloads and compiles the shaders of the gl backend.", "F5",
         [](Session& s, const Arguments&) { s.requestShaders(); }});
  r.add({"render.set", "Set parameter", "NAME=VALUE", "Sets a parameter of the method.", "",
         [](Session& s, const Arguments& a) {
           const size_t equals = a[0].find('=');
           const std::string name = a[0].substr(0, equals);
           const auto& all = findMethod(s.document().render.method).parameters;
           const ParameterSpec* spec = findParameter(all, name);
           if (equals == std::string::npos || !spec) {
             throw InputError(a[0], "does not set a parameter of " + s.document().render.method,
                              "give NAME=VALUE");
           }
           RenderSettings settings = s.document().render;
           settings.values.set(name, Settings::parse(*spec, a[0].substr(equals + 1)));
           s.setRender(settings);
         }});
  r.add({"render.exposure", "Exposure", "EV", "Sets the exposure in EV.", "",
         [](Session& s, const Arguments& a) {
           RenderSettings settings = s.document().render;
           settings.exposureEv = std::clamp(numberOf(a[0]), -16.0f, 16.0f);
           s.setRender(settings);
         }});
  r.add({"render.auto_exposure", "Automatic exposure", "",
         "Sets the exposure so that the log-average luminance of the picture is middle grey.", "",
         [](Session& s, const Arguments&) {
           RenderSettings settings = s.document().render;
           settings.exposureEv = autoExposureEv(s.output().radiance->pixels());
           s.setRender(settings);
         },
         [](const Session& s) { return s.output().radiance != nullptr; }});
}

}  // namespace lamplighter
