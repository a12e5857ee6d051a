#include "ui/app/input_queue.h"

#include <bitset>
#include <set>

namespace lamplighter {

void InputQueue::push(InputEvent event) {
  // A mouse reports hundreds of positions per second. Only the last one before another event is
  // kept.
  if (event.kind == EventKind::pointer && !queue_.empty() &&
      queue_.back().kind == EventKind::pointer) {
    queue_.back() = std::move(event);
    return;
  }
  queue_.push_back(std::move(event));
}

std::vector<InputEvent> InputQueue::takeFrame() {
  std::vector<InputEvent> taken;
  std::bitset<8> buttons;
  std::set<Key> keys;
  bool acted = false;
  while (!queue_.empty()) {
    const InputEvent& event = queue_.front();
    bool fits = true;
    switch (event.kind) {
      case EventKind::pointer:
        fits = buttons.none() && !acted;
        break;
      case EventKind::button:
        fits = !buttons[static_cast<size_t>(event.button) & 7] && !acted;
        buttons.set(static_cast<size_t>(event.button) & 7);
        break;
      case EventKind::key:
        fits = !keys.contains(event.key) && !acted;
        keys.insert(event.key);
        break;
      case EventKind::action:
        // An action may change what is under the pointer, so the next events wait for its frame.
        fits = taken.empty() || acted;
        acted = true;
        break;
      case EventKind::wheel:
      case EventKind::text:
        fits = !acted;
        break;
    }
    if (!fits) break;
    taken.push_back(std::move(queue_.front()));
    queue_.pop_front();
  }
  return taken;
}

}  // namespace lamplighter
