// From events to the state of pointer, buttons and keys that a frame sees; and from window pixels
// back to names for recordings.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "editor/input/event.h"
#include "ui/widgets/widget_map.h"

namespace lamplighter {

struct PointerKeys {
  vec2 pointer{-1.0f};  // window pixels
  std::array<bool, 3> buttons{};
  vec2 wheel{0.0f};                                          // this frame
  std::array<bool, static_cast<size_t>(Key::count)> keys{};  // held
  std::vector<Key> pressed;                                  // this frame, in order
  std::string text;                                          // typed this frame, UTF-8

  bool held(Key key) const { return keys[static_cast<size_t>(key)]; }
  Modifiers modifiers() const { return {held(Key::ctrl), held(Key::shift), held(Key::alt)}; }
};

class InputRouter {
 public:
  explicit InputRouter(const WidgetMap& widgets) : widgets_(widgets) {}

  // Forgets what belongs to one frame only.
  void beginFrame();
  // Takes in an event that is no action. Throws InputError for a widget that is not on the screen.
  void apply(const InputEvent& event);
  const PointerKeys& state() const { return state_; }

  // The event as a recording holds it: window pixels become viewport pixels or a place on a widget.
  // While a button is held the names stay those of the press, so that a drag means the same in
  // another layout.
  InputEvent named(const InputEvent& event);

 private:
  vec2 windowPosition(const InputEvent& event) const;

  const WidgetMap& widgets_;
  PointerKeys state_;
  std::string dragTarget_;
  int namedButtons_ = 0;
  vec2 namedPointer_{-1.0f};
};

// The widget that is the 3D view; events aim at it in pixels, not in shares.
inline const std::string kViewportTarget = "viewport";

}  // namespace lamplighter
