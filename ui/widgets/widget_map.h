// The position of each named widget. Recordings contain names, for example "render/vpls", instead
// of pixels, so that a new layout does not break them. Panels fill the map in each frame. Input
// uses the map of the previous frame, because that is what the user sees.
#pragma once

#include <map>
#include <string>

#include "ui/widgets/rect.h"

namespace lamplighter {

class WidgetMap {
 public:
  struct Place {
    Rect rect;
    Rect visible;   // the part of it that is not clipped
    int order = 0;  // higher values are on top
  };

  // Starts a frame: find() and at() now use what add() collected in the last frame.
  void flip();
  void add(const std::string& name, const Rect& rect, const Rect& visible);

  // nullptr: not on the screen.
  const Place* find(const std::string& name) const;
  // The topmost widget at a point; "" for none.
  std::string at(vec2 point) const;
  const std::map<std::string, Place>& all() const { return shown_; }

 private:
  std::map<std::string, Place> shown_;
  std::map<std::string, Place> next_;
};

}  // namespace lamplighter
