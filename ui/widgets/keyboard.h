// Keys that panels read themselves.
#pragma once

#include <imgui.h>

namespace lamplighter {

// A key of the keyboard, whatever has the focus.
inline bool pressed(ImGuiKey key, bool repeats = false) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeats);
}

// Space or Enter on the last item, while it is the one that is marked for the keyboard.
inline bool pressedByKey() {
  return ImGui::GetIO().NavVisible && ImGui::IsItemFocused() &&
         (pressed(ImGuiKey_Space) || pressed(ImGuiKey_Enter));
}

}  // namespace lamplighter
