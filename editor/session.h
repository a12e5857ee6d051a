// One editing session: the document, its history, the camera, the tools and the frame renderer; all
// that the ui shows and drives, without a window. The ui calls, once a frame and in this order:
// runAction()/edits from panels, viewport(), renderFrame(), overlay().
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "editor/actions/action.h"
#include "editor/commands/history.h"
#include "editor/document/document.h"
#include "editor/tools/overlay.h"
#include "editor/tools/viewport_input.h"
#include "renderer/frame.h"
#include "renderer/view.h"

namespace lamplighter {

enum class ToolMode { select, move, rotate, scale };

class Session {
 public:
  explicit Session(std::unique_ptr<FrameRenderer> renderer);
  ~Session();

  // Replaces the document by a loaded scene (an empty history; the view of its first camera, or one
  // that shows it all). The status says what the loader warned of.
  void open(Scene scene, std::filesystem::path path, const std::vector<std::string>& warnings);
  // Saves as glTF; throws InputError with the document untouched when that fails.
  void save(const std::filesystem::path& path);
  bool modified() const;  // since opened or saved

  Document& document() { return document_; }
  const Document& document() const { return document_; }
  History& history() { return history_; }
  const History& history() const { return history_; }
  const ActionRegistry& actions() const { return actions_; }
  FrameRenderer& renderer() { return *renderer_; }

  // Runs an action given as text. A failure goes to the status line and is returned as false.
  bool runAction(std::string_view text);

  // Edits that panels make. Each is an undoable step, or joins the open transaction.
  void setNodeTransform(NodeId id, const Transform& local);
  void setAreaLight(NodeId id, const AreaLight& light);
  void setPunctualLight(NodeId id, const PunctualLight& light);
  void setMaterial(int index, const Material& material);
  void setName(NodeId id, const std::string& name);
  void setVisible(NodeId id, bool visible);
  void setRender(const RenderSettings& settings);
  void select(std::vector<NodeId> ids) ;

  // The camera and the tools.
  const View& view() const { return view_; }
  void setView(const View& view) { view_ = view; }
  void resizeViewport(int width, int height);
  ToolMode tool() const;
  void setTool(ToolMode mode);
  void viewport(const ViewportInput& input);  // camera, pick, gizmo

  // Renders one frame of what changed and keeps it. `output().settled` says when it is done.
  const GiOutput& renderFrame();
  const GiOutput& output() const { return output_; }
  uint32_t frame() const { return frame_; }

  // What tools draw over the picture: gizmo, selection outline, lights' shapes.
  Overlay overlay() const;

  const std::string& status() const { return status_; }
  void setStatus(std::string text) { status_ = std::move(text); }
  bool quitRequested() const { return quit_; }
  void requestQuit() { quit_ = true; }

 private:
  struct Tools;
  Document document_;
  History history_{document_};
  ActionRegistry actions_;
  std::unique_ptr<FrameRenderer> renderer_;
  std::unique_ptr<Tools> tools_;
  View view_;
  GiOutput output_;
  std::string status_;
  uint32_t frame_ = 0;
  size_t savedPosition_ = 0;
  bool quit_ = false;
};

}  // namespace lamplighter
