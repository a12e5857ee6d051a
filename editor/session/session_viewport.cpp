// A session in the viewport: pointer input, picking, and the overlay.
#include <algorithm>

#include "editor/debug_views/vpl_overlay.h"
#include "editor/edits/placement.h"
#include "editor/edits/tree.h"
#include "editor/probes/probe_overlay.h"
#include "editor/session/click_to_place.h"
#include "editor/session/session_tools.h"
#include "editor/tools/picker.h"
#include "editor/tools/scene_overlay.h"
#include "editor/tools/surface_search.h"
#include "renderer/scene/units.h"

namespace lamplighter {

void Session::resizeViewport(int width, int height) {
  area_ = max(glm::ivec2(width, height), glm::ivec2(1));
  fitView();
}

void Session::fitView() {
  isTiled_ = split_.showsTiles();
  const glm::ivec2 size = isTiled_ ? tiles().size : area_;
  view_.width = size.x;
  view_.height = size.y;
}

ToolMode Session::tool() const { return tools_->gizmo.mode; }

void Session::setTool(ToolMode mode) {
  if (tools_->gizmo.dragging()) return;
  tools_->gizmo.mode = mode;
  points_.setTool(PointTool::none);
}

bool Session::dragging() const {
  return tools_->gizmo.dragging() || tools_->lightHandles.dragging();
}
void Session::finishDrag() {
  tools_->gizmo.finish();
  tools_->lightHandles.finish();
}
void Session::cancelDrag() {
  tools_->gizmo.cancel();
  tools_->lightHandles.cancel();
}
SnapTo Session::snapTo() const { return tools_->gizmo.snapTo; }
void Session::setSnapTo(SnapTo target) { tools_->gizmo.snapTo = target; }
bool Session::snapping() const { return tools_->gizmo.snap; }
void Session::setSnapping(bool on) { tools_->gizmo.snap = on; }
float Session::cameraSpeed() const { return tools_->camera.speed(); }
bool Session::flying() const { return tools_->camera.flying(); }

void Session::frameSelection() {
  const std::unordered_set<NodeId> selected = document_.selected();
  Bounds bounds;
  for (const RenderObject& o : renderer_->scene().objects) {
    for (const Node* n = document_.scene.find(o.node); n != nullptr;
         n = document_.scene.find(n->parent)) {
      if (selected.contains(n->id)) {
        bounds.add(inMetres(o.bounds, unit()));
        break;
      }
    }
  }
  for (const RenderPunctual& p : renderer_->scene().punctuals) {
    if (selected.contains(p.node)) bounds.add(unit() * p.position);
  }
  tools_->camera.frame(view_, bounds.empty() ? this->bounds() : bounds, unit());
}

void Session::frameAll() { tools_->camera.frame(view_, bounds(), unit()); }

Bounds Session::bounds() const { return inMetres(renderScene().bounds, unit()); }

void Session::viewport(const ViewportInput& inArea) {
  const ViewportInput input =
      split_.showsTiles() ? split_.pointer().inTile(inArea, tiles()) : inArea;
  if (input.hovered || dragging()) {
    tools_->pointer = input.pointer;
    tools_->pointerKnown = true;
  }
  tools_->gizmo.unit = tools_->lightHandles.unit = unit();
  // A drag comes before the camera, because the right button cancels it.
  const auto surface = [&](SnapTo target) -> std::optional<vec3> {
    if (target == SnapTo::vertex) return vertexUnderPointer(document_.selection);
    const auto place = surfaceUnderPointer(document_.selection);
    if (!place) return std::nullopt;
    return place->position +
           standOff(document_.scene, document_.active(), place->normal, unit()) * place->normal;
  };
  const auto aimedAt = [&]() -> std::optional<vec3> {
    const auto place = surfaceUnderPointer(document_.selection);
    return place ? std::optional(place->position) : std::nullopt;
  };
  const auto dragHandles = [&] {
    return tools_->lightHandles.update(view_, input, editing_, snapping(), aimedAt);
  };
  if (tools_->lightHandles.dragging()) {
    dragHandles();
    return;
  }
  if (tools_->gizmo.dragging()) {
    tools_->gizmo.update(view_, input, editing_, surface);
    return;
  }
  if (split_.drag(input, view_.width)) return;
  if (tools_->camera.update(view_, input)) return;
  if (placing() && input.pressed[0] && input.hovered)
    return placeUnderPointer(*this, input.modifiers.shift);
  if (points_.pointer(pointSubject(), input)) return;
  if (tools_->gizmo.update(view_, input, editing_)) return;
  if (dragHandles()) return;
  if (!input.pressed[0] || !input.hovered || renderer_->rays() == nullptr) return;
  if (display_.showsVpls()) {
    const Inspection inspection = inspect();
    const int vpl = pickVpl(inUnits(view_, unit()), inspection, *renderer_->rays(), input.pointer);
    if (vpl != kNone) return display_.choose(inspection, vpl);
  }

  const NodeId id = pick(inUnits(view_, unit()), renderer_->scene(), *renderer_->rays(),
                         input.pointer, [&](NodeId n) { return !isLocked(document_.scene, n); });
  std::vector<NodeId> selection;
  if (input.modifiers.ctrl || input.modifiers.shift) {
    selection = document_.selection;
    const bool had = document_.isSelected(id);
    std::erase(selection, id);
    if (!had && id != kNoNode) selection.push_back(id);
  } else if (id != kNoNode) {
    selection.push_back(id);
  }
  select(std::move(selection));
}

std::optional<Session::Place> Session::surfaceAlong(const vec3& direction,
                                                    const std::vector<NodeId>& ignored) const {
  if (renderer_->rays() == nullptr) return std::nullopt;
  return SurfaceSearch{document_, renderer_->scene(), *renderer_->rays(), ignored}.along(view_.eye,
                                                                                         direction);
}

std::optional<vec3> Session::vertexUnderPointer(const std::vector<NodeId>& ignored) const {
  if (!tools_->pointerKnown || renderer_->rays() == nullptr) return std::nullopt;
  return SurfaceSearch{document_, renderer_->scene(), *renderer_->rays(), ignored}.vertexAt(
      view_, tools_->pointer);
}

std::optional<Session::Place> Session::surfaceUnderPointer(
    const std::vector<NodeId>& ignored) const {
  if (!tools_->pointerKnown) return std::nullopt;
  return surfaceAlong(view_.rayDirection(tools_->pointer.x, tools_->pointer.y), ignored);
}

std::optional<Session::Place> Session::surfaceAhead(const std::vector<NodeId>& ignored) const {
  return surfaceAlong(view_.forward(), ignored);
}

PointTools::Subject Session::pointSubject() const {
  RadianceImage* lit =
      display_.lightOnly() || display_.part() != LightPart::all ? nullptr : output_.radiance.get();
  return {document_.scene, *renderer_, view_, document_.render.values, lit};
}

std::optional<vec2> Session::pointer() const {
  return tools_->pointerKnown ? std::optional(tools_->pointer) : std::nullopt;
}

// In the unit of the scene, as far from the surface under the pointer as its own radius and a half.
std::optional<vec3> Session::probeProp() const {
  const auto place = surfaceUnderPointer({});
  if (!place) return std::nullopt;
  return place->position / unit() + 1.5f * propRadius(probes_) * place->normal;
}

Overlay Session::overlay() const {
  Overlay overlay;
  drawScene(overlay, view_, document_, renderer_->scene());
  if (display_.showsVpls() && renderer_->rays() != nullptr) {
    const Inspection inspection = inspect();
    drawVpls(overlay, inUnits(view_, unit()), inspection, *renderer_->rays(),
             display_.chosen(inspection));
  }
  if (probes_.on() && renderer_->rays() != nullptr)
    drawProbes(overlay, inUnits(view_, unit()), probes_, renderScene(), *renderer_->rays(),
               {document_.render.exposureEv, display_.toneMapper()}, probeProp());
  tools_->lightHandles.draw(overlay, view_, document_);
  if (points_.tool() == PointTool::none) tools_->gizmo.draw(overlay, view_, document_);
  points_.draw(overlay, pointSubject());
  return overlay;
}

}  // namespace lamplighter
