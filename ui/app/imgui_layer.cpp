#include "ui/app/imgui_layer.h"

#include <algorithm>

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "renderer/base/error.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

Cursor cursorOf(ImGuiMouseCursor cursor) {
  switch (cursor) {
    case ImGuiMouseCursor_TextInput:
      return Cursor::text;
    case ImGuiMouseCursor_ResizeEW:
      return Cursor::resizeHorizontal;
    case ImGuiMouseCursor_ResizeNS:
      return Cursor::resizeVertical;
    case ImGuiMouseCursor_Hand:
      return Cursor::hand;
    case ImGuiMouseCursor_Arrow:
      return Cursor::arrow;
    default:
      return Cursor::other;
  }
}

void mapKeys(ImGuiIO& io) {
  const auto map = [&](ImGuiKey theirs, Key ours) { io.KeyMap[theirs] = static_cast<int>(ours); };
  map(ImGuiKey_Tab, Key::tab);
  map(ImGuiKey_LeftArrow, Key::left);
  map(ImGuiKey_RightArrow, Key::right);
  map(ImGuiKey_UpArrow, Key::up);
  map(ImGuiKey_DownArrow, Key::down);
  map(ImGuiKey_PageUp, Key::pageUp);
  map(ImGuiKey_PageDown, Key::pageDown);
  map(ImGuiKey_Home, Key::home);
  map(ImGuiKey_End, Key::end);
  map(ImGuiKey_Insert, Key::insert);
  map(ImGuiKey_Delete, Key::del);
  map(ImGuiKey_Backspace, Key::backspace);
  map(ImGuiKey_Space, Key::space);
  map(ImGuiKey_Enter, Key::enter);
  map(ImGuiKey_Escape, Key::escape);
  map(ImGuiKey_A, Key::a);
  map(ImGuiKey_C, Key::c);
  map(ImGuiKey_V, Key::v);
  map(ImGuiKey_X, Key::x);
  map(ImGuiKey_Y, Key::y);
  map(ImGuiKey_Z, Key::z);
}

// In menus and dialogs Enter activates the focused item, as Space does. Elsewhere it goes to a text
// field.
bool enterPresses() {
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  if (g.NavWindow == nullptr || !g.IO.NavVisible || g.IO.WantTextInput) return false;
  return (g.NavWindow->Flags & ImGuiWindowFlags_Popup) != 0 || g.NavLayer == ImGuiNavLayer_Menu;
}

}  // namespace

ImGuiLayer::ImGuiLayer(Platform& platform) : platform_(platform), context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // the layout is fixed, and a replay must not depend on a file
  io.LogFilename = nullptr;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  // The same behaviour on every system, so that a recording replays anywhere.
  io.ConfigMacOSXBehaviors = false;
  io.MouseDrawCursor = false;
  mapKeys(io);
  io.ClipboardUserData = this;
  io.GetClipboardTextFn = [](void* self) -> const char* {
    auto& layer = *static_cast<ImGuiLayer*>(self);
    layer.clipboard_ = layer.platform_.clipboard();
    return layer.clipboard_.c_str();
  };
  io.SetClipboardTextFn = [](void* self, const char* text) {
    static_cast<ImGuiLayer*>(self)->platform_.setClipboard(text);
  };
  if (platform_.hasGl() && !ImGui_ImplOpenGL3_Init("#version 450 core"))
    throw InputError("OpenGL: the user interface can't be drawn; update the graphics driver");
}

ImGuiLayer::~ImGuiLayer() {
  ImGui::SetCurrentContext(context_);
  if (platform_.hasGl()) ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
}

void ImGuiLayer::rescale(float scale) {
  if (scale == scale_) return;
  scale_ = scale;
  theme::apply(scale);
  ImGuiIO& io = ImGui::GetIO();
  if (platform_.hasGl()) {
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  } else {
    // Text is measured with the same atlas, even if nothing is drawn.
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
  }
}

void ImGuiLayer::beginFrame(const PointerKeys& input, float seconds, float scale) {
  ImGui::SetCurrentContext(context_);
  rescale(scale);
  ImGuiIO& io = ImGui::GetIO();
  const glm::ivec2 size = platform_.size();
  io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
  io.DeltaTime = std::max(seconds, 1e-4f);
  io.MousePos = {input.pointer.x, input.pointer.y};
  for (size_t i = 0; i < input.buttons.size(); ++i) io.MouseDown[i] = input.buttons[i];
  io.MouseWheel = input.wheel.y;
  io.MouseWheelH = input.wheel.x;
  for (size_t i = 0; i < input.keys.size(); ++i) io.KeysDown[i] = input.keys[i];
  if (input.held(Key::enter) && enterPresses()) {
    io.KeysDown[static_cast<size_t>(Key::enter)] = false;
    io.KeysDown[static_cast<size_t>(Key::space)] = true;
  }
  // With Ctrl or Alt these keys are shortcuts and do not navigate. In a text field they belong to
  // the text. F6 changes the panel.
  if ((input.held(Key::ctrl) || input.held(Key::alt)) && !io.WantTextInput) {
    for (const Key key : {Key::left, Key::right, Key::up, Key::down, Key::pageUp, Key::pageDown})
      io.KeysDown[static_cast<size_t>(key)] = false;
  }
  if (input.held(Key::ctrl)) io.KeysDown[static_cast<size_t>(Key::tab)] = false;
  io.KeyCtrl = input.held(Key::ctrl);
  io.KeyShift = input.held(Key::shift);
  // Alt alone would open a menu, but the camera uses Alt to orbit. Alt also slows down dragged
  // values.
  io.KeyAlt = input.held(Key::alt) && (io.WantTextInput || io.MouseDown[0]);
  io.KeySuper = input.held(Key::super);
  io.AddInputCharactersUTF8(input.text.c_str());
  if (platform_.hasGl()) ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void ImGuiLayer::endFrame(bool draws) {
  ImGui::Render();
  platform_.setCursor(cursorOf(ImGui::GetMouseCursor()));
  if (!platform_.hasGl() || !draws) return;
  platform_.beginDrawing();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace lamplighter
