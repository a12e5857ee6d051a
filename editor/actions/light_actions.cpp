#include <algorithm>
#include <cmath>
#include <map>

#include "editor/actions/arguments.h"
#include "editor/actions/register_actions.h"
#include "editor/commands/edits.h"
#include "editor/session.h"
#include "renderer/error.h"

namespace lamplighter {

namespace {

const std::map<std::string, AreaShape> kShapes = {
    {"rectangle", AreaShape::rectangle}, {"disk", AreaShape::disk}, {"sphere", AreaShape::sphere}};

// Facing down: the light's −Z along the world's −Y.
const quat kDown = glm::angleAxis(-0.5f * kPi, vec3(1, 0, 0));

float areaSeenFromBelow(const AreaLight& l) {
  return l.shape == AreaShape::rectangle ? l.size.x * l.size.y : 0.25f * kPi * l.size.x * l.size.x;
}

// A new light hangs between the eye and what the eye looks at, and faces down. Its size suits the
// distance, and its radiance is such that a white floor as far below shows as middle grey to white
// at the present exposure: L A / h² · ρ/π = 0.4 · 2^−EV.
void addLight(Session& s, AreaShape shape) {
  const View& view = s.view();
  const float sceneRadius = std::max(s.renderer().scene().bounds.radius(), 0.1f);
  float distance = 0.5f * sceneRadius;
  if (const auto ahead = s.surfaceAhead())
    distance = std::min(distance, 0.6f * glm::length(ahead->position - view.eye));

  Scene& scene = s.document().scene;
  Node n;
  n.id = scene.nextId++;
  n.local.translation = view.eye + distance * view.forward();
  n.local.rotation = kDown;
  AreaLight light;
  light.shape = shape;
  const float size = std::clamp(0.3f * distance, 0.02f, 2.0f);
  light.size = shape == AreaShape::rectangle ? vec2(size, size) : vec2(size);
  const float height = std::clamp(distance, 0.2f, 3.0f);
  const float radiance = 0.4f * std::exp2(-s.document().render.exposureEv) * kPi * height * height /
                         areaSeenFromBelow(light);
  light.radiance = vec3(radiance);
  n.area = light;
  for (const auto& [name, value] : kShapes) {
    if (value == shape) n.name = name + " light " + std::to_string(n.id);
  }
  const NodeId id = n.id;
  s.history().run(std::make_unique<AddNodes>("Add " + n.name, std::vector<Node>{n}));
  s.select({id});
}

const Node& activeAreaLight(const Session& s) {
  const Node& n = activeNode(s.document());
  if (!n.area) throw InputError(n.name, "is no area light", "select one");
  return n;
}

}  // namespace

void addLightActions(ActionRegistry& r) {
  r.add({"light.add",
         "Add area light",
         "rectangle|disk|sphere",
         "Puts a new area light ahead of the camera, facing down.",
         "",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 1, 1, "light.add rectangle|disk|sphere");
           const auto shape = kShapes.find(a[0]);
           if (shape == kShapes.end())
             throw InputError(a[0], "is no shape of a light", "give rectangle, disk or sphere");
           addLight(s, shape->second);
         },
         {}});
  r.add({"light.radiance",
         "Set radiance",
         "R G B",
         "Sets the active area light's radiance in W/(m² sr).",
         "",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 3, 3, "light.radiance R G B");
           const Node& n = activeAreaLight(s);
           AreaLight light = *n.area;
           light.radiance = glm::max(vectorOf(a, 0), vec3(0.0f));
           s.setAreaLight(n.id, light);
         },
         {}});
  r.add({"light.size",
         "Set size",
         "WIDTH [HEIGHT]",
         "Sets the active area light's size, or its diameter, in metres.",
         "",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 1, 2, "light.size WIDTH [HEIGHT]");
           const Node& n = activeAreaLight(s);
           AreaLight light = *n.area;
           light.size.x = numberOf(a[0]);
           light.size.y = a.size() == 2 ? numberOf(a[1]) : light.size.x;
           if (light.size.x <= 0.0f || light.size.y <= 0.0f)
             throw InputError("light.size", "a size must be above 0", "give one in metres");
           s.setAreaLight(n.id, light);
         },
         {}});
}

}  // namespace lamplighter
