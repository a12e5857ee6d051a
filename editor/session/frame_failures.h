// Reaction to a frame that could not be rendered: another attempt from scratch, the cpu backend
// instead of gl, or waiting until something changes.
#pragma once

#include <exception>
#include <string>

#include "editor/document/document.h"
#include "renderer/debug_views/debug_view.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

class FrameFailures {
 public:
  // The input of the picture in addition to the scene.
  struct Input {
    View view;
    RenderSettings render;
    DebugView shown = DebugView::lit;
    bool operator==(const Input&) const = default;
  };
  enum class Next : uint8_t { tryAgain, leaveGl, wait };

  // Whether the last frame failed. The next one then needs the whole scene.
  bool any() const { return !why_.empty(); }
  const std::string& why() const { return why_; }  // one line; "": the last frame was rendered
  // Whether a frame with this input would fail again. `isSameScene`: as in the last frame.
  bool waits(const Input& input, bool isSameScene) const {
    return waits_ && isSameScene && input == input_;
  }

  // An InputError occurs again with the same input. Other exceptions may be caused by data kept
  // between frames or by lack of memory, so they get a second attempt; if that fails, the gl
  // backend is considered broken.
  Next failed(const std::exception& e, const Input& input, bool isOnGl);
  void rendered() { *this = {}; }
  // Call when something else changed, such as shaders: ends the waiting.
  void tryAgain() { waits_ = false; }

 private:
  std::string why_;
  Input input_;
  int count_ = 0;  // number of consecutive exceptions other than InputError
  bool waits_ = false;
};

}  // namespace lamplighter
