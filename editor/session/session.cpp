#include <algorithm>

#include "editor/edits/edits.h"
#include "editor/notices/failure_text.h"
#include "editor/session/register_actions.h"
#include "editor/session/session_tools.h"
#include "editor/session/user_state.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/error.h"
#include "renderer/methods/common_parameters.h"
#include "renderer/methods/path_tracer/reference_method.h"

namespace lamplighter {

Session::Session(std::unique_ptr<FrameRenderer> renderer)
    : home_(std::make_unique<UserState>()),
      renderer_(std::move(renderer)),
      tools_(std::make_unique<Tools>()) {
  addAllActions(actions_);
  savedHash_ = sceneHash(document_.scene);
}

Session::~Session() = default;

void Session::open(Scene scene, std::filesystem::path path,
                   const std::vector<std::string>& warnings) {
  cancelDrag();
  // First what needs much memory: if it fails, the present level stays.
  World world;
  world.update(scene, SceneChanges::all());
  const float unit = world.scene().unit;
  const Bounds bounds = inMetres(world.scene().bounds, unit);
  const auto& nodes = scene.nodes;
  const auto camera =
      std::find_if(nodes.begin(), nodes.end(), [](const Node& n) { return n.camera != kNone; });
  const View view = camera != nodes.end() ? viewOfCamera(scene, *camera, view_.width, view_.height)
                                          : viewOfBounds(bounds, view_.width, view_.height);
  // The camera orbits around the surface in the middle of the picture.
  const Hit hit = world.rays()->intersect({view.eye / unit, 0.0f, view.forward()}, Surfaces::seen);
  const uint64_t hash = sceneHash(scene);
  std::vector<FileStamp> files = filesOf(scene);

  placing_.clear();
  ++level_;
  editing_.open({std::move(scene), document_.render, {}, std::move(path)});
  savedHash_ = hash;
  tools_->pointerKnown = false;
  points_.forget();
  probes_.forget();
  disk_ = std::move(files);
  view_ = view;
  tools_->camera.reset(hit ? unit * hit.t : std::max(bounds.radius(), 0.1f * unit), unit);
  const std::string problem = crashRecovery_.opened(document_);
  const std::string whole = document_.path.string(), name = document_.path.filename().string();
  setStatus("Opened " + name);
  if (!problem.empty()) setStatus(problem, NoticeKind::warning);
  std::vector<std::string> told = warnings;
  for (std::string& warning : told) {
    // The file name is enough: the path is long, and the user has just chosen it.
    if (!whole.empty() && warning.starts_with(whole)) warning.replace(0, whole.size(), name);
    setStatus(warning, NoticeKind::warning);
  }
  if (!told.empty()) status_ = told.front();
  if (warnings.size() > 1)
    status_ += " (and " + std::to_string(warnings.size() - 1) + " more warnings)";
  if (!document_.path.empty()) home_->preferences.addRecent(document_.path);
}

void Session::setStatus(std::string text, NoticeKind kind) {
  home_->notices.add(kind, text);
  status_ = std::move(text);
}

std::filesystem::path Session::writablePath(const std::filesystem::path& wanted) const {
  if (home_->writeFolder.empty()) return wanted;
  std::error_code ignored;
  std::filesystem::create_directories(home_->writeFolder, ignored);
  return home_->writeFolder / wanted.filename();
}

void Session::perform(std::string_view text) {
  const auto [action, arguments] = actions_.parse(text);
  if (!action.duringDrag) finishDrag();
  if (action.enabled && !action.enabled(*this)) return;
  if (!action.takes(arguments.size()))
    throw InputError(action.name + " " + action.usage,
                     "the number of arguments is wrong (" + std::to_string(arguments.size()) + ")",
                     "give them as shown");
  action.run(*this, arguments);
  home_->ran.insert(action.name);
}

bool Session::runAction(std::string_view text) {
  try {
    perform(text);
    return true;
  } catch (const std::exception& e) {
    setStatus(failureText(e), NoticeKind::error);
    return false;
  }
}

template <typename Change>
void Session::editNode(NodeId id, const std::string& verb, Change change) {
  const Node* now = document_.scene.find(id);
  if (now == nullptr) throw InputError("object", "it no longer exists", "select another");
  Node node = *now;
  change(node);
  setNodes(editing_, verb + " " + node.name, {node});
}

void Session::setNodeTransform(NodeId id, const Transform& local) {
  editNode(id, "Transform", [&](Node& n) { n.local = local; });
}

void Session::setAreaLight(NodeId id, const AreaLight& light) {
  editNode(id, "Change", [&](Node& n) { n.area = light; });
}

void Session::setPunctualLight(NodeId id, const PunctualLight& light) {
  editNode(id, "Change", [&](Node& n) { n.punctual = light; });
}

void Session::setMaterial(int index, const Material& material) {
  Transaction edit = editing_.begin("Change material " + material.name);
  edit.material(index) = material;
  edit.commit();
}

void Session::setName(NodeId id, const std::string& name) {
  editNode(id, "Rename", [&](Node& n) { n.name = name; });
}

void Session::setVisible(NodeId id, bool visible) {
  editNode(id, visible ? "Show" : "Hide", [&](Node& n) { n.visible = visible; });
}

void Session::setMeshKind(NodeId id, MeshKind kind) {
  editNode(id, "Light", [&](Node& n) { n.meshKind = kind; });
}

void Session::setSky(const Sky& sky) {
  if (sky == document_.scene.sky) return;
  Transaction edit = editing_.begin("Change the sky");
  edit.sky() = sky;
  edit.commit();
}

void Session::setRender(const RenderSettings& settings) {
  Transaction edit = editing_.begin("Change render settings");
  edit.render() = settings;
  edit.commit();
}

void Session::toggleReference() {
  if (split_.on()) return split_.toggleWhole();
  RenderSettings settings = document_.render;
  if (settings.method == kReferenceMethod) {
    settings.method = methodBeforeReference_;
  } else {
    methodBeforeReference_ = std::exchange(settings.method, kReferenceMethod);
  }
  setRender(settings);
}

void Session::undo() {
  if (dragging()) return cancelDrag();  // the drag is the last change
  const std::string label = history().undoLabel();
  editing_.undo();
  if (!label.empty()) setStatus("Undid: " + label);
}

void Session::redo() {
  finishDrag();
  const std::string label = history().redoLabel();
  editing_.redo();
  if (!label.empty()) setStatus("Redid: " + label);
}

void Session::goToStep(size_t position) {
  finishDrag();
  editing_.goTo(position);
}

// The scene to be shown, with the work light, and what changed in it since the last call.
const Scene& Session::litScene(SceneChanges& changes) {
  changes = editing_.takeChanges();
  const Scene& scene = workLight_.with(document_.scene, view_, lighting_.workLight, changes);
  sceneRevision_ += !changes.none();
  return scene;
}

void Session::skipFrame() {
  SceneChanges changes;
  try {
    const Scene& scene = litScene(changes);
    renderer_->update(scene, failures_.any() ? SceneChanges::all() : changes);
    unshown_.merge(changes);
  } catch (const std::exception& e) {
    frameFailed(e, {view_, document_.render, display_.view()});
  }
}

const GiOutput& Session::renderFrame(std::optional<int> updates, const FrameBudget& budget) {
  const double begin = clock_ ? clock_() : 0.0;
  if (split_.showsTiles() || isTiled_) fitView();
  const RenderSettings render =
      split_.on() ? split_.first().of(document_.render) : document_.render;
  const FrameFailures::Input input{view_, render, display_.view()};
  const std::shared_ptr<RadianceImage> before = output_.settled ? output_.radiance : nullptr;
  Settings settings = render.values;
  if (updates) settings.set(kUpdates, *updates);
  SceneChanges changes;
  try {
    const Scene& scene = litScene(changes);
    if (failures_.waits(input, changes.none())) {
      ++frame_;
      return output_;
    }
    if (failures_.any()) changes = SceneChanges::all();  // the earlier ones may be lost
    output_ = renderer_->render({scene, changes, view_, render.method, settings,
                                 display_.lightOnly(), budget, display_.part()});
    tell(std::exchange(output_.failure, nullptr));
    changes.merge(std::exchange(unshown_, {}));
    const bool same = output_.settled && output_.radiance == before && changes.none();
    if (document_.active() != kNoNode) display_.chooseLight(document_.active());
    display_.update(*renderer_, *output_.radiance, view_, document_.render, !same);
    points_.update(pointSubject(), !same, !changes.none());
    watchFrame(changes, begin, budget.inBackground || budget.refineUpdates > 0);
    updateProbes(changes, budget.inBackground);
    failures_.rendered();
  } catch (const std::exception& e) {
    frameFailed(e, input);
  }
  ++frame_;
  return output_;
}

// Reports the failure of a background task. The picture lacks its result.
void Session::tell(const std::exception_ptr& failure) {
  if (!failure) return;
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& e) {
    setStatus("The picture lacks a part that is computed in the background: " + failureText(e),
              NoticeKind::error);
  }
}

// The document, its history and the last picture do not change.
void Session::frameFailed(const std::exception& e, const FrameFailures::Input& input) {
  const std::string before = failures_.why();
  const bool isOnGl = renderer_->backend().info().name == "gl";
  const FrameFailures::Next next = failures_.failed(e, input, isOnGl);
  if (failures_.why() != before) setStatus(failures_.why(), NoticeKind::error);
  if (!output_.radiance)
    output_.radiance = std::make_shared<HostImage>(Image(view_.width, view_.height));
  output_.settled = output_.refined = next == FrameFailures::Next::wait;
  if (next != FrameFailures::Next::leaveGl) return;
  setStatus("The gl backend failed twice: the cpu backend renders now", NoticeKind::warning);
  renderer_->setBackend(makeCpuBackend());
}

}  // namespace lamplighter
