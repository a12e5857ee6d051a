// Converts events to the state of pointer, buttons and keys in a frame. Converts window pixels back
// to names of targets for recordings.
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
  vec2 wheel{0.0f};                                          // in this frame
  std::array<bool, static_cast<size_t>(Key::count)> keys{};  // held
  std::vector<Key> pressed;                                  // in this frame, in order
  std::string text;                                          // typed in this frame, UTF-8

  bool held(Key key) const { return keys[static_cast<size_t>(key)]; }
  Modifiers modifiers() const { return {held(Key::ctrl), held(Key::shift), held(Key::alt)}; }
};

class InputRouter {
 public:
  explicit InputRouter(const WidgetMap& widgets) : widgets_(widgets) {}

  // Clears the state that belongs to one frame only.
  void beginFrame();
  // Applies an event that is not an action. Throws InputError for a widget that is not on the
  // screen.
  void apply(const InputEvent& event);
  const PointerKeys& state() const { return state_; }

  // Converts an event to its form in recordings: window pixels become viewport pixels or a position
  // on a widget. While a button is held, the target of the press is kept, so that a drag has the
  // same effect in another layout.
  InputEvent named(const InputEvent& event);

 private:
  vec2 windowPosition(const InputEvent& event) const;

  const WidgetMap& widgets_;
  PointerKeys state_;
  std::string dragTarget_;
  int namedButtons_ = 0;
  vec2 namedPointer_{-1.0f};
};

// The widget of the 3D view. Events address it in pixels, other widgets in fractions.
inline const std::string kViewportTarget = "viewport";

}  // namespace lamplighter
