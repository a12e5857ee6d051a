#include <algorithm>
#include <filesystem>

#include "editor/actions/arguments.h"
#include "editor/edits/edits.h"
#include "editor/lights/light_profile.h"
#include "editor/lights/new_light.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_picture.h"

namespace lamplighter {

namespace {

// Adds a light between the eye and the point that the eye looks at. It faces down.
void addLight(Session& s, const std::string& kind) {
  const View& view = s.view();
  const float sceneRadius = std::max(s.bounds().radius(), 0.1f * s.unit());
  float distance = 0.5f * sceneRadius;
  if (const auto ahead = s.surfaceAhead())
    distance = std::min(distance, 0.6f * glm::length(ahead->position - view.eye));

  Node n = newLight(kind, distance, s.document().render.exposureEv, s.unit());
  n.id = s.editing().newNodeId();
  n.local.translation = view.eye + distance * view.forward();
  n.name = kind + " light " + std::to_string(n.id);
  const NodeId id = n.id;
  addNodes(s.editing(), "Add " + n.name, {n});
  s.select({id});
}

const Node& activeAreaLight(const Session& s) {
  const Node& n = activeNode(s.document());
  if (!n.area) throw InputError(n.name, "is not an area light", "select an area light");
  return n;
}

// Searches relative to the working directory, then to the scene's folder.
std::string fileBeside(const Document& document, const std::string& name) {
  const std::filesystem::path beside = document.path.parent_path() / name;
  std::error_code error;
  return std::filesystem::exists(name, error) || !std::filesystem::exists(beside, error)
             ? name
             : beside.string();
}

}  // namespace

void addLightActions(ActionRegistry& r) {
  r.add({"light.add", "Add light", "rectangle|disk|sphere|tube|spot|point|sun",
         "Adds a light in front of the camera, facing down, with an intensity that suits its "
         "distance and the exposure.",
         "", [](Session& s, const Arguments& a) { addLight(s, a[0]); }});
  r.add({"light.ies", "Set profile", "FILE",
         "Assigns an IES file to the active point or spot light; none removes it. The luminous "
         "flux stays the same.",
         "",
         [](Session& s, const Arguments& a) {
           const Node& n = activeNode(s.document());
           if (!takesProfile(n))
             throw InputError(n.name, "is neither a point nor a spot light",
                              "select a point or spot light");
           const auto profile = a[0] == "none" ? nullptr : readIes(fileBeside(s.document(), a[0]));
           s.setPunctualLight(n.id, withProfile(s.document().scene, n, profile));
         }})
      .asks = {.title = "Open a profile of a light", .extensions = kProfileExtensions};
  r.add({"light.picture", "Set picture", "FILE",
         "Assigns a PNG or JPEG picture to the active rectangle or disk light: its pixels scale "
         "the radiance. none removes it. The luminous flux stays the same.",
         "",
         [](Session& s, const Arguments& a) {
           const Node& n = activeAreaLight(s);
           if (n.area->shape != AreaShape::rectangle && n.area->shape != AreaShape::disk)
             throw InputError(n.name, "is neither a rectangle nor a disk",
                              "select a rectangle or disk light");
           AreaLight light = *n.area;
           light.picture =
               a[0] == "none" ? nullptr : readLightPicture(fileBeside(s.document(), a[0]));
           const float was = luminance(meanFactor(*n.area) * light.radiance);
           const float is = luminance(meanFactor(light) * light.radiance);
           if (was > 0.0f && is > 0.0f) light.radiance *= was / is;
           s.setAreaLight(n.id, light);
         }})
      .asks = {.title = "Open a picture of a light", .extensions = kLightPictureExtensions};
  r.add({"light.radiance", "Set radiance", "R G B",
         "Sets the active area light's radiance in W/(m² sr).", "",
         [](Session& s, const Arguments& a) {
           const Node& n = activeAreaLight(s);
           AreaLight light = *n.area;
           light.radiance = glm::max(vectorOf(a, 0), vec3(0.0f));
           s.setAreaLight(n.id, light);
         }});
  r.add({"light.size", "Set size", "WIDTH [HEIGHT]",
         "Sets the active area light's size, or its diameter, in metres.", "",
         [](Session& s, const Arguments& a) {
           const Node& n = activeAreaLight(s);
           AreaLight light = *n.area;
           light.size.x = numberOf(a[0]);
           light.size.y = a.size() == 2 ? numberOf(a[1]) : light.size.x;
           if (light.size.x <= 0.0f || light.size.y <= 0.0f)
             throw InputError("light.size", "a size must be above 0", "give a size in metres");
           s.setAreaLight(n.id, light);
         }});
}

}  // namespace lamplighter
