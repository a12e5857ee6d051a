#include "editor/session.h"

#include <algorithm>

#include "editor/actions/register_actions.h"
#include "editor/commands/edits.h"
#include "editor/tools/camera_controller.h"
#include "editor/tools/light_handles.h"
#include "editor/tools/picker.h"
#include "editor/tools/placement.h"
#include "editor/tools/placing.h"
#include "editor/tools/scene_overlay.h"
#include "editor/tools/surface_search.h"
#include "editor/views/vpl_overlay.h"
#include "renderer/error.h"
#include "renderer/methods/common_parameters.h"
#include "renderer/scene/gltf_io.h"

namespace lamplighter {

struct Session::Tools {
  CameraController camera;
  Gizmo gizmo;
  LightHandles lightHandles;
  vec2 pointer{0.0f};  // where it was last over the viewport
  bool pointerKnown = false;
};

Session::Session(std::unique_ptr<FrameRenderer> renderer)
    : renderer_(std::move(renderer)), tools_(std::make_unique<Tools>()) {
  addAllActions(actions_);
  savedHash_ = sceneHash(document_.scene);
}

Session::~Session() = default;

void Session::open(Scene scene, std::filesystem::path path,
                   const std::vector<std::string>& warnings) {
  tools_->gizmo.forget();
  tools_->lightHandles.forget();
  placing_.clear();
  ++level_;
  document_.scene = std::move(scene);
  document_.selection.clear();
  document_.path = std::move(path);
  history_.clear();
  savedHash_ = sceneHash(document_.scene);
  tools_->pointerKnown = false;
  points_.forget();

  RenderScene world;
  update(world, document_.scene, SceneChanges::all());
  const auto& nodes = document_.scene.nodes;
  const auto camera =
      std::find_if(nodes.begin(), nodes.end(), [](const Node& n) { return n.camera != kNone; });
  view_ = camera != nodes.end() ? viewOfCamera(document_.scene, *camera, view_.width, view_.height)
                                : viewOfBounds(world.bounds, view_.width, view_.height);
  // Orbiting turns about what is in the middle of the picture.
  const RayCaster rays(world);
  const Hit hit = rays.intersect({view_.eye, 0.0f, view_.forward()}, Surfaces::seen);
  tools_->camera.reset(hit ? hit.t : std::max(world.bounds.radius(), 0.1f));
  status_ = warnings.empty() ? "Opened " + document_.path.filename().string() : warnings.front();
  if (warnings.size() > 1)
    status_ += " (and " + std::to_string(warnings.size() - 1) + " more warnings)";
}

void Session::save(const std::filesystem::path& path) {
  finishDrag();
  history_.commit();
  saveGltf(document_.scene, path);
  document_.path = path;
  savedHash_ = sceneHash(document_.scene);
  status_ = "Saved " + path.string();
}

bool Session::modified() const { return sceneHash(document_.scene) != savedHash_; }

bool Session::runAction(std::string_view text) {
  try {
    actions_.run(*this, text);
    return true;
  } catch (const InputError& e) {
    status_ = e.what();
    return false;
  }
}

namespace {

// The node with one thing changed.
template <typename Change>
std::unique_ptr<EditNodes> nodeEdit(const Document& document, NodeId id, const std::string& what,
                                    Change change) {
  const Node* now = document.scene.find(id);
  if (now == nullptr) throw InputError("object", "it is not there any more", "select another");
  Node node = *now;
  change(node);
  return std::make_unique<EditNodes>(what + " " + node.name, document, std::vector<Node>{node});
}

}  // namespace

void Session::setNodeTransform(NodeId id, const Transform& local) {
  history_.run(nodeEdit(document_, id, "Transform", [&](Node& n) { n.local = local; }));
}

void Session::setAreaLight(NodeId id, const AreaLight& light) {
  history_.run(nodeEdit(document_, id, "Change", [&](Node& n) { n.area = light; }));
}

void Session::setPunctualLight(NodeId id, const PunctualLight& light) {
  history_.run(nodeEdit(document_, id, "Change", [&](Node& n) { n.punctual = light; }));
}

void Session::setMaterial(int index, const Material& material) {
  history_.run(std::make_unique<EditMaterial>(document_, index, material));
}

void Session::setName(NodeId id, const std::string& name) {
  history_.run(nodeEdit(document_, id, "Rename", [&](Node& n) { n.name = name; }));
}

void Session::setVisible(NodeId id, bool visible) {
  history_.run(
      nodeEdit(document_, id, visible ? "Show" : "Hide", [&](Node& n) { n.visible = visible; }));
}

void Session::setMeshKind(NodeId id, MeshKind kind) {
  history_.run(nodeEdit(document_, id, "Light", [&](Node& n) { n.meshKind = kind; }));
}

void Session::setSky(const Sky& sky) { history_.run(std::make_unique<EditSky>(document_, sky)); }

void Session::setRender(const RenderSettings& settings) {
  history_.run(std::make_unique<EditRender>(document_, settings));
}

void Session::toggleReference() {
  if (split_.on()) return split_.toggleWhole();
  RenderSettings settings = document_.render;
  if (settings.method == "reference") {
    settings.method = methodBeforeReference_;
  } else {
    methodBeforeReference_ = std::exchange(settings.method, "reference");
  }
  setRender(settings);
}

void Session::select(std::vector<NodeId> ids) {
  // Of an id given twice the last one counts.
  document_.selection.clear();
  for (const NodeId id : ids) {
    std::erase(document_.selection, id);
    document_.selection.push_back(id);
  }
  pruneSelection();
}

void Session::undo() {
  if (dragging()) return cancelDrag();  // what is under way is the last change
  history_.undo();
  pruneSelection();
}

void Session::redo() {
  finishDrag();
  history_.redo();
  pruneSelection();
}

void Session::pruneSelection() {
  std::erase_if(document_.selection,
                [&](NodeId id) { return document_.scene.find(id) == nullptr; });
}

void Session::resizeViewport(int width, int height) {
  view_.width = std::max(width, 1);
  view_.height = std::max(height, 1);
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
  tools_->gizmo.finish(history_);
  tools_->lightHandles.finish(history_);
}
void Session::cancelDrag() {
  tools_->gizmo.cancel(history_);
  tools_->lightHandles.cancel(history_);
}
SnapTo Session::snapTo() const { return tools_->gizmo.snapTo; }
void Session::setSnapTo(SnapTo target) { tools_->gizmo.snapTo = target; }
bool Session::snapping() const { return tools_->gizmo.snap; }
void Session::setSnapping(bool on) { tools_->gizmo.snap = on; }
bool Session::flying() const { return tools_->camera.flying(); }

void Session::frameSelection() {
  Bounds bounds;
  for (const RenderObject& o : renderer_->scene().objects) {
    for (const Node* n = document_.scene.find(o.node); n != nullptr;
         n = document_.scene.find(n->parent)) {
      if (document_.isSelected(n->id)) {
        bounds.add(o.bounds);
        break;
      }
    }
  }
  for (const RenderPunctual& p : renderer_->scene().punctuals) {
    if (document_.isSelected(p.node)) bounds.add(p.position);
  }
  tools_->camera.frame(view_, bounds.empty() ? renderer_->scene().bounds : bounds);
}

void Session::frameAll() { tools_->camera.frame(view_, renderer_->scene().bounds); }

void Session::viewport(const ViewportInput& input) {
  if (input.hovered || dragging()) {
    tools_->pointer = input.pointer;
    tools_->pointerKnown = true;
  }
  // A drag goes first, since the right button takes it back; then the camera.
  const auto surface = [&](SnapTo target) -> std::optional<vec3> {
    if (target == SnapTo::vertex) return vertexUnderPointer(document_.selection);
    const auto place = surfaceUnderPointer(document_.selection);
    if (!place) return std::nullopt;
    return place->position +
           standOff(document_.scene, document_.active(), place->normal) * place->normal;
  };
  const auto aimedAt = [&]() -> std::optional<vec3> {
    const auto place = surfaceUnderPointer(document_.selection);
    return place ? std::optional(place->position) : std::nullopt;
  };
  const auto dragHandles = [&] {
    return tools_->lightHandles.update(view_, input, document_, history_, snapping(), aimedAt);
  };
  if (tools_->lightHandles.dragging()) {
    dragHandles();
    return;
  }
  if (tools_->gizmo.dragging()) {
    tools_->gizmo.update(view_, input, document_, history_, surface);
    return;
  }
  if (split_.drag(input, view_.width)) return;
  if (tools_->camera.update(view_, input)) return;
  if (placing() && input.pressed[0] && input.hovered)
    return placeUnderPointer(*this, input.modifiers.shift);
  if (points_.pointer(pointSubject(), input)) return;
  if (tools_->gizmo.update(view_, input, document_, history_)) return;
  if (dragHandles()) return;
  if (!input.pressed[0] || !input.hovered || renderer_->rays() == nullptr) return;
  if (display_.showsVpls()) {
    const Inspection inspection = inspect();
    const int vpl = pickVpl(view_, inspection, *renderer_->rays(), input.pointer);
    if (vpl != kNone) return display_.choose(inspection, vpl);
  }

  const NodeId id = pick(view_, renderer_->scene(), *renderer_->rays(), input.pointer);
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

const GiOutput& Session::renderFrame(std::optional<int> updates, int refineUpdates) {
  const double begin = clock_ ? clock_() : 0.0;
  SceneChanges changes = history_.takeChanges();
  const Scene& scene = workLight_.with(document_.scene, view_, lighting_.workLight, changes);
  sceneRevision_ += !changes.none();
  renderError_.clear();
  const std::shared_ptr<RadianceImage> before = output_.settled ? output_.radiance : nullptr;
  const RenderSettings render =
      split_.on() ? split_.first().of(document_.render) : document_.render;
  Settings settings = render.values;
  if (updates) settings.set(parameters::updates().name, *updates);
  try {
    output_ = renderer_->render({scene, changes, view_, render.method, settings,
                                 display_.lightOnly(), updates.has_value(), refineUpdates,
                                 display_.part()});
    const bool same = output_.settled && output_.radiance == before && changes.none();
    if (document_.active() != kNoNode) display_.chooseLight(document_.active());
    display_.update(*renderer_, *output_.radiance, view_, document_.render, !same);
    points_.update(pointSubject(), !same, !changes.none());
    watchFrame(changes, begin);
  } catch (const InputError& e) {
    history_.showAll();  // part of it may have arrived: the next frame begins anew
    renderError_ = status_ = e.what();
    if (!output_.radiance)
      output_.radiance = std::make_shared<HostImage>(Image(view_.width, view_.height));
    output_.settled = output_.refined = true;  // trying the same again changes nothing
  }
  ++frame_;
  return output_;
}

PointTools::Subject Session::pointSubject() const {
  RadianceImage* lit =
      display_.lightOnly() || display_.part() != LightPart::all ? nullptr : output_.radiance.get();
  return {document_.scene, *renderer_, view_, document_.render.values, lit};
}

std::optional<vec2> Session::pointer() const {
  return tools_->pointerKnown ? std::optional(tools_->pointer) : std::nullopt;
}

Overlay Session::overlay() const {
  Overlay overlay;
  drawScene(overlay, view_, document_, renderer_->scene());
  if (display_.showsVpls() && renderer_->rays() != nullptr) {
    const Inspection inspection = inspect();
    drawVpls(overlay, view_, inspection, *renderer_->rays(), display_.chosen(inspection));
  }
  tools_->lightHandles.draw(overlay, view_, document_);
  if (points_.tool() == PointTool::none) tools_->gizmo.draw(overlay, view_, document_);
  points_.draw(overlay, pointSubject());
  return overlay;
}

}  // namespace lamplighter
