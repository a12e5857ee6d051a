#include "ui/widgets/widget_map.h"

#include <utility>

namespace lamplighter {

void WidgetMap::flip() { shown_ = std::exchange(next_, {}); }

void WidgetMap::add(const std::string& name, const Rect& rect, const Rect& visible) {
  if (visible.empty()) return;
  next_[name] = {rect, visible, static_cast<int>(next_.size())};
}

const WidgetMap::Place* WidgetMap::find(const std::string& name) const {
  const auto it = shown_.find(name);
  return it == shown_.end() ? nullptr : &it->second;
}

std::string WidgetMap::at(vec2 point) const {
  std::string best;
  int order = -1;
  for (const auto& [name, place] : shown_) {
    if (place.order > order && place.visible.contains(point)) {
      order = place.order;
      best = name;
    }
  }
  return best;
}

}  // namespace lamplighter
