// Keys that panels read directly.
#pragma once

#include <imgui.h>

namespace lamplighter {

// A key of the keyboard, independent of the focus.
inline bool pressed(ImGuiKey key, bool repeats = false) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeats);
}

// Space or Enter on the last item, if it has the keyboard focus.
inline bool pressedByKey() {
  return ImGui::GetIO().NavVisible && ImGui::IsItemFocused() &&
         (pressed(ImGuiKey_Space) || pressed(ImGuiKey_Enter));
}

}  // namespace lamplighter
