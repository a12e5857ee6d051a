// The platform that the program runs on: a window, or headless. It delivers all input as
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
  virtual float contentScale() const = 0;     // pixels per design pixel
  virtual glm::ivec2 windowSize() const = 0;  // requested window size, before the screen's scale
  // Appends the events since the last call. Waits up to `seconds` for an event.
  virtual void poll(std::vector<InputEvent>& events, double seconds) = 0;
  virtual bool closeRequested() const = 0;
  virtual void refuseClose() = 0;
  virtual void setTitle(const std::string& title) = 0;
  virtual void setCursor(Cursor cursor) = 0;
  virtual std::string clipboard() const = 0;
  virtual void setClipboard(const std::string& text) = 0;

  // Whether an OpenGL context is current. Without one the layout is done, but nothing is drawn.
  virtual bool hasGl() const = 0;
  // Binds and clears the framebuffer. present() shows it.
  virtual void beginDrawing() = 0;
  virtual void present() = 0;
  // The picture drawn since beginDrawing(), top row first. Empty without OpenGL.
  virtual Image8 screenshot() = 0;

  virtual double seconds() const = 0;  // wall time since an arbitrary start
};

}  // namespace lamplighter
