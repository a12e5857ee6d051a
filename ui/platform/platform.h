// What the program runs in: a window, or nothing at all. All input comes out of here as
// InputEvents.
#pragma once

#include <string>
#include <vector>

#include "editor/input/event.h"
#include "renderer/image/image.h"

namespace lamplighter {

enum class Cursor { arrow, text, resizeHorizontal, resizeVertical, hand, other };

class Platform {
 public:
  virtual ~Platform() = default;

  virtual glm::ivec2 size() const = 0;        // framebuffer pixels
  virtual float contentScale() const = 0;     // pixels a design pixel
  virtual glm::ivec2 windowSize() const = 0;  // as a window is asked for: before the screen's scale
  // Appends what happened since the last call; waits up to `seconds` for something to happen.
  virtual void poll(std::vector<InputEvent>& events, double seconds) = 0;
  virtual bool closeRequested() const = 0;
  virtual void refuseClose() = 0;
  virtual void setTitle(const std::string& title) = 0;
  virtual void setCursor(Cursor cursor) = 0;
  virtual std::string clipboard() const = 0;
  virtual void setClipboard(const std::string& text) = 0;

  // Whether an OpenGL context is current: without one nothing is drawn, only laid out.
  virtual bool hasGl() const = 0;
  // Binds and clears what is drawn into; present() shows it.
  virtual void beginDrawing() = 0;
  virtual void present() = 0;
  // What has been drawn since beginDrawing(), row 0 the top. Empty without OpenGL.
  virtual Image8 screenshot() = 0;

  virtual double seconds() const = 0;  // wall time since some moment
};

}  // namespace lamplighter
