#include "ui/app/application.h"

#include <algorithm>
#include <utility>

#include <imgui.h>
#include <spdlog/spdlog.h>

#include "editor/notices/failure_text.h"
#include "editor/session/user_state.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/base/error.h"
#include "renderer/image/exposure.h"
#include "renderer/image/image_io.h"

namespace lamplighter {
namespace {

// After this number of frames, or when the picture is settled, the exposure of a newly opened scene
// is set. Most of its light samples are then included.
constexpr int kFramesToExposure = 8;

constexpr ImGuiWindowFlags kPanelFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                         ImGuiWindowFlags_NoSavedSettings |
                                         ImGuiWindowFlags_NoBringToFrontOnFocus;

// Begins a panel's window at a fixed position.
void beginPanel(const char* id, const Rect& rect, bool scrolls = true) {
  ImGui::SetNextWindowPos({rect.min.x, rect.min.y});
  ImGui::SetNextWindowSize({rect.size().x, rect.size().y});
  ImGuiWindowFlags flags = kPanelFlags;
  if (scrolls) flags &= ~ImGuiWindowFlags_NoScrollbar;
  ImGui::Begin(id, nullptr, flags);
}

}  // namespace

Application::Application(Platform& platform, std::unique_ptr<Session> session)
    : platform_(platform), session_(std::move(session)), gui_(platform) {
  lastSeconds_ = seconds();
  session_->setClock([this] { return seconds(); });
}

double Application::seconds() const {
  return frameClock_ ? static_cast<double>(frames_) * static_cast<double>(timeStep_)
                     : platform_.seconds();
}

void Application::useFrameClock() {
  frameClock_ = true;
  lastSeconds_ = seconds();
}

void Application::openNow(const std::filesystem::path& path) {
  LoadedScene loaded = loadGltf(path);
  session_->open(std::move(loaded.scene), path, loaded.warnings);
}

void Application::showError(const std::string& text) {
  session_->home().notices.add(NoticeKind::error, text);  // for the log
  messageBox_.show("Error", text);
}

void Application::frame() {
  widgets_.flip();
  inPart("Input", [&] { takeInput(); });
  inPart("Opening", [&] { takeLoaded(); });

  ++frames_;
  const double now = seconds();
  frameSeconds_ += 0.15 * (now - lastSeconds_ - frameSeconds_);
  dt_ = timeStep_ > 0.0f ? timeStep_
                         : std::clamp(static_cast<float>(now - lastSeconds_), 1e-4f, 0.25f);
  lastSeconds_ = now;

  inPart("Settings", [&] { exchangePreferences(); });
  gui_.beginFrame(router_.state(), dt_, uiScale());
  const PanelContext ui{*session_, widgets_, uiScale(), ""};
  drawPanels(ui);
  inPart("Viewport", [&] { viewport_.takeInput(ui, layout_.view, router_.state(), dt_); });
  // A replay must not depend on the progress of a thread.
  if (!replaying_) inPart("Error meter", [&] { exchangeWithMeter(); });
  const bool renders = rendersFrame();
  if (renders)
    inPart("Picture", [&] { renderAndPresent(); });
  else
    session_->skipFrame();
  inPart("Viewport's overlay", [&] {
    std::vector<uint32_t> textures{picture_.texture()};
    for (const auto& other : otherPictures_) textures.push_back(other->texture());
    viewport_.draw(ui, textures);
  });
  inPart("Status line", [&] { drawStatusLine(ui); });
  inPart("Messages", [&] { toasts(ui, toastState_, layout_.view, dt_); });
  inPart("Dialog", [&] { drawDialogs(ui); });
  gui_.endFrame(renders);
  inPart("Action", [&] { answerRequests(); });
  platform_.present();
  inPart("Window title", [&] { updateTitle(); });
  inPart("Autosave", [&] { autosave_.frame(*session_, now); });
}

void Application::exchangeWithMeter() {
  const std::string problem = meterWorker_.exchange(session_->watch().meter);
  if (!problem.empty()) session_->setStatus("Error meter: " + problem, NoticeKind::warning);
}

void Application::renderAndPresent() {
  // With a fixed time step, as in recordings, counts limit the work of a frame instead of time.
  if (timeStep_ > 0.0f)
    session_->renderFrame();
  else
    pacer_.renderFrame(*session_);
  logLatency();
  followExposure();
  present();
}

// Clicks are resolved in the rendered frame, so every edit is rendered.
bool Application::rendersFrame() {
  const size_t position = session_->history().position();
  const bool renders = !skipsPictures_ || position != renderedPosition_;
  renderedPosition_ = position;
  return renders;
}

void Application::close() {
  autosave_.finish();
  session_->crashRecovery().close();
}

// Logs each edit once, when its picture has settled. A replay has its own report.
void Application::logLatency() {
  const EditLatency& latency = session_->watch().latency;
  if (latency.measured() == latenciesLogged_) return;
  latenciesLogged_ = latency.measured();
  if (replaying_) return;
  const LatencyResult& last = latency.results().back();
  spdlog::info("edit \"{}\": {}", last.what, latencyText(last, true));
}

void Application::takeInput() {
  router_.beginFrame();
  const std::vector<InputEvent> events = input_.takeFrame();
  if (listener_) {
    std::vector<InputEvent> named;
    named.reserve(events.size());
    for (const InputEvent& event : events) named.push_back(router_.named(event));
    listener_(named);
  }
  for (const InputEvent& event : events) handle(event);
  quietFrames_ = events.empty() ? quietFrames_ + 1 : 0;
}

void Application::handle(const InputEvent& event) {
  if (event.kind == EventKind::action) {
    runAction(event.text);
    return;
  }
  router_.apply(event);
  if (event.kind == EventKind::key && event.down) pressKey(event.key);
}

namespace {

// Keys that navigate in a panel while one of its items has the keyboard focus.
bool isOfNavigation(Key key, const Modifiers& modifiers) {
  const bool leads = key == Key::space || key == Key::enter || key == Key::escape ||
                     key == Key::tab || (key >= Key::left && key <= Key::end);
  return ImGui::GetIO().NavVisible && leads && !modifiers.ctrl && !modifiers.alt;
}

}  // namespace

void Application::pressKey(Key key) {
  // Text fields, dialogs and the flying camera get keys before shortcuts do.
  const Modifiers modifiers = router_.state().modifiers();
  if (ImGui::GetIO().WantTextInput || dialogOpen()) return;
  if (isOfNavigation(key, modifiers)) return;
  if (session_->flying() && !modifiers.ctrl) return;
  if (session_->dragging() && key == Key::escape) return;  // Escape cancels the drag
  if (const std::string text = session_->actions().textForKey(key, modifiers); !text.empty())
    runAction(text);
}

bool Application::dialogOpen() const {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

// Runs an action, or opens the dialog that asks for its argument.
void Application::runAction(const std::string& text) {
  bool saves = false;
  try {
    const auto [action, arguments] = session_->actions().parse(text);
    if (arguments.empty() && action.asksIn(*session_)) return ask(action);
    saves = action.saves != nullptr;
    if (saves && asksToOverwrite(text, action.saves(*session_, arguments))) return;
    session_->perform(text);
    if (saves) closeIfSaved();
  } catch (const std::exception& e) {
    const std::string why = failureText(e);
    if (replaying_) throw InputError(text + ": " + why);
    if (!saves) return session_->setStatus(why, NoticeKind::error);
    pending_ = Pending::none;
    showError(why);
  }
}

void Application::ask(const Action& action) {
  const ActionAsk& asks = *action.asks;
  const std::string& answered = asks.answeredBy.empty() ? action.name : asks.answeredBy;
  const std::string start =
      asks.suggested ? asks.suggested(*session_) : session_->document().path.string();
  if (asks.kind == ActionAsk::Kind::name)
    nameDialog_.open(answered, asks, start);
  else
    fileDialog_.open(answered, asks, start);
}

// Opens the overwrite question if another program has changed a file that an action would write.
bool Application::asksToOverwrite(const std::string& text, const std::filesystem::path& file) {
  if (file.empty()) return false;
  const std::vector<std::filesystem::path> changed = session_->changedOnDisk(file);
  if (changed.empty()) return false;
  overwriting_ = text + " force";
  overwriteQuestion_.ask(changed.front().filename().string());
  return true;
}

// Call after the frame was rendered, so that the text describes the current picture.
void Application::drawStatusLine(const PanelContext& ui) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(10), ui.px(2)});
  beginPanel("##status", layout_.status, false);
  statusLine(ui, {frameSeconds_, static_cast<bool>(listener_), replaying_});
  ImGui::End();
  ImGui::PopStyleVar();
}

void Application::drawPanels(PanelContext ui) {
  inPart("Menus", [&] {
    focusAsAsked();
    menuBar(ui, requests_);
  });
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  layout_.divide({window.x, window.y}, ImGui::GetFrameHeight(), ui.scale,
                 session_->lighting().showsTable || session_->home().bottom != BottomPanel::none);

  const auto panel = [&](const char* name, const char* id, const Rect& rect, bool scrolls,
                         const std::function<void()>& draw) {
    inPart(name, [&] {
      beginPanel(id, rect, scrolls);
      draw();
      ImGui::End();
    });
  };
  panel("Toolbar", "##toolbar", layout_.toolbar, false, [&] { toolbar(ui, requests_); });
  panel("Outliner", "##outliner", layout_.left, false, [&] { outliner(ui, outlinerState_); });
  panel("Inspector", "##inspector", layout_.inspector, true,
        [&] { inspector(ui, inspectorState_, requests_); });
  panel("Render panel", "##render", layout_.render, true,
        [&] { renderPanel(ui, timelineState_, requests_); });
  if (!layout_.bottom.empty())
    panel("Bottom panel", "##lights", layout_.bottom, true, [&] { drawBottom(ui); });
  inPart("Panels over the picture", [&] { drawFloatingPanels(ui); });
  inPart("Layout", [&] { layout_.splitters(ui); });
  // Run now, so that this frame shows the effects.
  for (const std::string& action : std::exchange(requests_.actions, {})) runAction(action);

  // If a field disappears while it is edited, its transaction stays open; commit it.
  if (session_->editing().inTransaction() && !ImGui::IsAnyItemActive() && !session_->dragging())
    session_->editing().commit();
}

void Application::drawFloatingPanels(const PanelContext& ui) {
  const Rect explained = explainPanel(ui, layout_.view, requests_);
  Rect below = layout_.view;
  if (!explained.empty()) below.min.y = explained.max.y;
  viewport_.setCovered(
      {explained, histogramPanel(ui, below, requests_), historyPanel(ui, layout_.view, requests_)});
}

void Application::drawDialogs(PanelContext ui) {
  if (loader_.running()) {
    const Progress progress{"Opening", loader_.what(), loader_.done(), true};
    if (progressBox_.draw(ui, &progress)) loader_.cancel();
  } else {
    progressBox_.draw(ui, nullptr);
  }
  if (std::exchange(session_->home().opensPalette, false)) palette_.open();
  for (const std::string& action : {fileDialog_.draw(ui), nameDialog_.draw(ui), palette_.draw(ui)})
    if (!action.empty()) runAction(action);
  if (fileDialog_.cancelled()) pending_ = Pending::none;
  if (!loader_.running()) {
    const RecoveryDialog::Answer answer = recoveryDialog_.draw(ui);
    const bool isRecovered = answer == RecoveryDialog::Answer::recover;
    if (answer != RecoveryDialog::Answer::none &&
        !session_->runAction(isRecovered ? "recovery.recover" : "recovery.discard"))
      showError(session_->status());
    if (isRecovered) framesToExposure_ = 0;  // it has its own exposure
  }
  settingsDialog(ui, settingsState_, requests_);
  switch (saveQuestion_.draw(ui)) {
    case SaveQuestion::Answer::none:
      break;
    case SaveQuestion::Answer::cancel:
      pending_ = Pending::none;
      break;
    case SaveQuestion::Answer::discard:
      closeIfSaved();
      break;
    case SaveQuestion::Answer::save:
      runAction("file.save");
      break;
  }
  switch (overwriteQuestion_.draw(ui)) {
    case OverwriteQuestion::Answer::none:
      break;
    case OverwriteQuestion::Answer::cancel:
      pending_ = Pending::none;
      break;
    case OverwriteQuestion::Answer::saveAs:
      runAction("file.save_as");
      break;
    case OverwriteQuestion::Answer::overwrite:
      runAction(overwriting_);
      break;
  }
  messageBox_.draw(ui);
}

// Continues the operation that waited until the changes were saved or discarded.
void Application::closeIfSaved() {
  const Pending pending = std::exchange(pending_, Pending::none);
  if (pending == Pending::quit) finished_ = true;
  if (pending == Pending::open) openInBackground(pendingOpen_);
}

void Application::present() {
  if (!platform_.hasGl()) return;
  const SplitView& split = session_->split();
  presentOthers();
  if (split.on() && split.heat())
    picture_.show(split.heat());
  else if (const auto& view = session_->display().picture())
    picture_.show(view);
  else
    picture_.show(session_->output().radiance, session_->document().render.exposureEv,
                  session_->display().toneMapper());
}

// The sides of a split view that are shown, but the first.
void Application::presentOthers() {
  const SplitView& split = session_->split();
  const size_t shown = split.shown() == SplitView::Shown::heat ? 0
                       : split.showsTiles()                    ? ~size_t{0}
                                                               : 1;
  const size_t others = std::min(shown, split.on() ? split.sides() - 1 : 0);
  otherPictures_.resize(others);
  for (size_t i = 0; i < others; ++i) {
    const std::shared_ptr<RadianceImage> radiance = split.picture(i + 1);
    // A new texture where nothing is shown any more.
    if (!otherPictures_[i] || !radiance) otherPictures_[i] = std::make_unique<Picture>();
    otherPictures_[i]->show(radiance, session_->document().render.exposureEv,
                            session_->display().toneMapper());
  }
}

void Application::takeLoaded() {
  std::optional<SceneLoader::Result> result = loader_.take();
  if (!result) return;
  if (!result->error.empty()) showError(result->error);
  if (!result->loaded) return;
  session_->open(std::move(result->loaded->scene), result->path, result->loaded->warnings);
  framesToExposure_ = kFramesToExposure;
  lastExposure_.reset();
}

// Sets the exposure of an opened level after a few frames, and repeats this while light samples are
// still missing: on a slow machine most of them come later. Stops when the user has made an edit.
void Application::followExposure() {
  const GiOutput& output = session_->output();
  if (framesToExposure_ == 0 || (--framesToExposure_ > 0 && !output.settled)) return;
  const float& ev = session_->document().render.exposureEv;
  const bool isOurs = !lastExposure_ || (ev == *lastExposure_ && !session_->editing().canUndo());
  if (isOurs) exposeAutomatically();
  const bool goesOn = isOurs && output.stats.pending > 0;
  framesToExposure_ = goesOn ? kFramesToExposure : 0;
  lastExposure_ = goesOn ? std::optional(ev) : std::nullopt;
}

void Application::exposeAutomatically() {
  if (!session_->output().radiance) return;
  RenderSettings render = session_->document().render;
  render.exposureEv = autoExposureEv(session_->output().radiance->pixels());
  session_->editing().setInitialRender(std::move(render));
}

void Application::answerRequests() {
  const std::string palette = std::exchange(requests_.palette, "");
  if (!palette.empty()) palette_.open(palette);
  if (const auto path = session_->takeScreenshotRequest()) {
    try {
      const Image8 image = platform_.screenshot();
      if (image.width == 0) throw InputError("there is no window to take a picture of");
      writePng(image, *path);
      session_->setStatus("Wrote " + path->string());
    } catch (const InputError& e) {
      session_->setStatus(e.what());
    }
  }
  if (session_->takeShadersRequest()) {
    Backend& backend = session_->renderer().backend();
    try {
      reloadShaders(backend, gl::defaultShaderFolder());
      session_->renderAnew();
      session_->setStatus(backend.info().name == "gl" ? "Shaders reloaded"
                                                      : "The cpu backend has no shaders");
    } catch (const gl::ShaderError& e) {
      session_->setStatus(e.what());  // the valid values stay in use
    }
  }
  if (const auto path = session_->takeOpenRequest()) {
    if (replaying_) {
      // Load synchronously: frame counts must not depend on the loading time. The path is relative
      // to the level's folder, so that a recording has the same effect everywhere.
      openNow(session_->document().path.parent_path() / *path);
    } else if (session_->modified()) {
      pending_ = Pending::open;
      pendingOpen_ = *path;
      saveQuestion_.ask();
    } else {
      openInBackground(*path);
    }
  }
  if (session_->quitRequested() || platform_.closeRequested()) {
    // A replay asks about unsaved changes as the editor does, but closing its window always works.
    const bool endsReplay = replaying_ && platform_.closeRequested();
    session_->requestQuit(false);
    platform_.refuseClose();
    if (endsReplay || !session_->modified()) {
      finished_ = true;
    } else if (pending_ == Pending::none) {
      pending_ = Pending::quit;
      saveQuestion_.ask();
    }
  }
}

void Application::updateTitle() {
  if (!platform_.hasGl() || session_->history().position() == titlePosition_) return;
  titlePosition_ = session_->history().position();
  const std::string name = session_->document().path.filename().string();
  const std::string title = (name.empty() ? "untitled" : name) +
                            (session_->modified() ? " *" : "") + " \u2013 Lamplighter";
  if (title != title_) platform_.setTitle(title);
  title_ = title;
}

bool Application::idle() const {
  // A few more frames for delayed reactions: hover colours, layouts, popups.
  constexpr int kAfterglow = 4;
  return quietFrames_ > kAfterglow && !toastState_.any() && !thumbnails_.busy() && input_.empty() &&
         session_->output().settled && session_->output().refined && session_->probes().settled() &&
         !loader_.running();
}

}  // namespace lamplighter
