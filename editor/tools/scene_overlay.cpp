#include "editor/tools/scene_overlay.h"

#include <cmath>

#include "editor/tools/picker.h"
#include "editor/tools/projection.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/units.h"

namespace lamplighter {

namespace {

const vec4 kSelected{1.0f, 0.62f, 0.18f, 1.0f};
const vec4 kActive{1.0f, 0.78f, 0.35f, 1.0f};
const vec4 kLight{1.0f, 0.93f, 0.6f, 0.75f};
const vec4 kLeftOut{0.93f, 0.36f, 0.5f, 0.9f};

// Draws the bounding box of the node's mesh in local space, as twelve edges.
void drawBox(Overlay& overlay, const View& view, const Mesh& mesh, const mat4& world,
             const vec4& colour) {
  Bounds b;
  for (const Primitive& p : mesh.primitives) {
    for (const vec3& q : p.positions) b.add(q);
  }
  if (b.empty()) return;
  const auto corner = [&](int i) {
    return vec3(world * vec4((i & 1) ? b.max.x : b.min.x, (i & 2) ? b.max.y : b.min.y,
                             (i & 4) ? b.max.z : b.min.z, 1.0f));
  };
  for (int i = 0; i < 8; ++i) {
    for (const int bit : {1, 2, 4}) {
      if ((i & bit) == 0) addLine(overlay, view, corner(i), corner(i | bit), colour);
    }
  }
}

// Draws the outline of an area light and a line in its direction.
void drawAreaLight(Overlay& overlay, const View& view, const AreaLight& light, const mat4& world,
                   const vec4& colour) {
  const auto at = [&](const vec3& p) { return vec3(world * vec4(p, 1.0f)); };
  const float x = 0.5f * light.size.x, y = 0.5f * light.size.y;
  std::vector<vec3> outline;
  if (light.shape == AreaShape::rectangle) {
    outline = {at({-x, -y, 0}), at({x, -y, 0}), at({x, y, 0}), at({-x, y, 0})};
    addLoop(overlay, view, outline, colour, 2.0f);
  } else if (light.shape == AreaShape::tube) {
    for (const float side : {-x, x}) {
      outline.clear();
      for (const vec3& p : circle(vec3(side, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), y))
        outline.push_back(at(p));
      addLoop(overlay, view, outline, colour, 2.0f);
    }
    for (const vec2& d : {vec2(y, 0), vec2(0, y), vec2(-y, 0), vec2(0, -y)})
      addLine(overlay, view, at({-x, d.x, d.y}), at({x, d.x, d.y}), colour);
    return;
  } else {
    for (const vec3& p : circle(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), x)) outline.push_back(at(p));
    addLoop(overlay, view, outline, colour, 2.0f);
  }
  if (light.shape == AreaShape::sphere) {
    for (const auto& [u, v] :
         {std::pair{vec3(1, 0, 0), vec3(0, 0, 1)}, std::pair{vec3(0, 1, 0), vec3(0, 0, 1)}}) {
      outline.clear();
      for (const vec3& p : circle(vec3(0), u, v, x)) outline.push_back(at(p));
      addLoop(overlay, view, outline, colour);
    }
    return;
  }
  const vec3 origin = at(vec3(0)), aim = mat3(world) * vec3(0, 0, -1);
  const float length = glm::length(aim);
  if (length > 0.0f)
    addLine(overlay, view, origin, origin + aim / length * (28.0f * metresPerPixel(view, origin)),
            colour, 2.0f);
}

// Draws a mark that looks like a sun. Spots and directional lights also show their direction.
// `view`: in the unit of the light.
void drawPunctual(Overlay& overlay, const View& view, const RenderPunctual& light,
                  const vec4& colour) {
  const auto mark = projectPoint(view, light.position);
  if (!mark) return;
  OverlayShape ring{{}, true, false, colour, 1.5f};
  for (int i = 0; i < 16; ++i) {
    const float a = 2.0f * kPi * static_cast<float>(i) / 16.0f;
    const vec2 d(std::cos(a), std::sin(a));
    ring.points.push_back(*mark + 5.0f * d);
    if (i % 2 == 0)
      overlay.shapes.push_back(
          {{*mark + 7.0f * d, *mark + (kMarkRadius + 1.0f) * d}, false, false, colour, 1.5f});
  }
  overlay.shapes.push_back(ring);
  if (light.light.kind == PunctualKind::point) return;
  const float reach = 60.0f * metresPerPixel(view, light.position);
  addLine(overlay, view, light.position, light.position + reach * light.direction, colour);
  if (light.light.kind != PunctualKind::spot || light.light.outerCone > 1.5f) return;
  const Frame f(light.direction);
  const vec3 centre = light.position + reach * light.direction;
  const auto rim =
      circle(centre, f.tangent, f.bitangent, reach * std::tan(light.light.outerCone), 32);
  addLoop(overlay, view, rim, colour, 1.0f);
  for (size_t i = 0; i < rim.size(); i += 8)
    addLine(overlay, view, light.position, rim[i], colour, 1.0f);
}

// Draws boxes around the objects that the selected lights exclude, each with a line from the light.
void drawLeftOut(Overlay& overlay, const View& view, const Document& document,
                 const std::vector<mat4>& world, const std::vector<bool>& visible) {
  const Scene& scene = document.scene;
  const LightLinks links = lightLinks(scene);
  if (links.count == 0) return;
  const std::unordered_set<NodeId> selected = document.selected();
  for (size_t light = 0; light < scene.nodes.size(); ++light) {
    if (!selected.contains(scene.nodes[light].id) || links.ofLight[light] == 0) continue;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
      const Node& n = scene.nodes[i];
      if (n.mesh == kNone || !visible[i] || !isLeftOut(links.leftOutBy[i], links.ofLight[light]))
        continue;
      const Mesh& mesh = *scene.meshes[static_cast<size_t>(n.mesh)];
      drawBox(overlay, view, mesh, world[i], kLeftOut);
      Bounds b;
      for (const Primitive& p : mesh.primitives)
        for (const vec3& q : p.positions) b.add(q);
      if (b.empty()) continue;
      addLine(overlay, view, vec3(world[light][3]), vec3(world[i] * vec4(b.centre(), 1.0f)),
              kLeftOut, 1.0f);
    }
  }
}

}  // namespace

void drawScene(Overlay& overlay, const View& view, const Document& document,
               const RenderScene& scene) {
  const std::unordered_set<NodeId> selection = document.selected();
  const auto colourOf = [&](NodeId id, const vec4& plain) {
    return id == document.active() ? kActive : selection.contains(id) ? kSelected : plain;
  };
  const std::vector<mat4> world = worldMatrices(document.scene);
  const std::vector<bool> visible = visibleNodes(document.scene);
  for (size_t i = 0; i < world.size(); ++i) {
    const Node& n = document.scene.nodes[i];
    if (!visible[i]) continue;
    const bool selected = selection.contains(n.id);
    if (n.area && selected) drawAreaLight(overlay, view, *n.area, world[i], colourOf(n.id, kLight));
    if (n.mesh != kNone && selected)
      drawBox(overlay, view, *document.scene.meshes[n.mesh], world[i], colourOf(n.id, kLight));
  }
  drawLeftOut(overlay, view, document, world, visible);
  const View inSceneUnits = inUnits(view, scene.unit);
  for (const RenderPunctual& light : scene.punctuals)
    drawPunctual(overlay, inSceneUnits, light, colourOf(light.node, kLight));
}

}  // namespace lamplighter
