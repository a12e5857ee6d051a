#include "ui/widgets/input_router.h"

#include "renderer/base/error.h"

namespace lamplighter {

void InputRouter::beginFrame() {
  state_.wheel = vec2(0.0f);
  state_.pressed.clear();
  state_.text.clear();
}

vec2 InputRouter::windowPosition(const InputEvent& event) const {
  if (event.target.empty()) return event.position;
  const WidgetMap::Place* place = widgets_.find(event.target);
  if (!place)
    throw InputError("widget '" + event.target +
                     "' is not on the screen; open the panel or menu that contains it first");
  if (event.target == kViewportTarget) return place->rect.min + event.position;
  return place->rect.min + event.position * place->rect.size();
}

void InputRouter::apply(const InputEvent& event) {
  switch (event.kind) {
    case EventKind::pointer:
      state_.pointer = windowPosition(event);
      break;
    case EventKind::button:
      if (event.button >= 0 && event.button < 3)
        state_.buttons[static_cast<size_t>(event.button)] = event.down;
      break;
    case EventKind::wheel:
      state_.wheel += event.wheel;
      break;
    case EventKind::key:
      if (event.down && !state_.held(event.key)) state_.pressed.push_back(event.key);
      state_.keys[static_cast<size_t>(event.key)] = event.down;
      break;
    case EventKind::text:
      state_.text += event.text;
      break;
    case EventKind::action:
      break;
  }
}

InputEvent InputRouter::named(const InputEvent& event) {
  InputEvent result = event;
  if (event.kind == EventKind::button) {
    if (event.down && namedButtons_++ == 0) dragTarget_ = widgets_.at(namedPointer_);
    if (!event.down && namedButtons_ > 0) --namedButtons_;
    return result;
  }
  if (event.kind != EventKind::pointer || !event.target.empty()) return result;
  namedPointer_ = event.position;
  std::string target = namedButtons_ > 0 ? dragTarget_ : widgets_.at(event.position);
  const WidgetMap::Place* place = widgets_.find(target);
  if (!place) return result;
  result.target = target;
  result.position = event.position - place->rect.min;
  if (target != kViewportTarget) result.position /= place->rect.size();
  return result;
}

}  // namespace lamplighter
