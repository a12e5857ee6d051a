// What the keyboard does to items that have only clicks of their own.
#pragma once

#include <imgui.h>

namespace lamplighter {

// Space or Enter on the last item, while it is the one that is marked for the keyboard.
inline bool pressedByKey() {
  const auto pressed = [](ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
  };
  return ImGui::GetIO().NavVisible && ImGui::IsItemFocused() &&
         (pressed(ImGuiKey_Space) || pressed(ImGuiKey_Enter));
}

}  // namespace lamplighter
