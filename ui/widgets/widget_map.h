// Where each named widget lies, so that recordings can say "render/vpls" and not pixels: a new
// layout does not break them. Panels fill it each frame; input is resolved with the map of the
// frame before, which is the one on the screen when a hand points at something.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "ui/widgets/rect.h"

namespace lamplighter {

class WidgetMap {
 public:
  struct Place {
    Rect rect;
    Rect visible;   // what fragment leaves of it
    int order = 0;  // later ones lie on top
  };

  // Starts a frame: what add() gathered becomes what find() and at() see.
  void flip();
  void add(const std::string& name, const Rect& rect, const Rect& visible);

  // nullptr: not on the screen.
  const Place* find(const std::string& name) const;
  // The topmost widget there, "" for none.
  std::string at(vec2 point) const;
  const std::map<std::string, Place>& all() const { return shown_; }

 private:
  std::map<std::string, Place> shown_;
  std::map<std::string, Place> next_;
};

}  // namespace lamplighter
