#include "ui/app/frame_parts.h"

#include <new>

#include <imgui_internal.h>

#include "editor/notices/failure_text.h"

namespace lamplighter {

namespace {

void undoEdit(Session& session) {
  try {
    session.cancelDrag();
    session.editing().cancel();
  } catch (const std::bad_alloc&) {
    // It stays open, and Escape or the next action ends it.
  }
}

}  // namespace

void FrameParts::run(Session& session, const std::string& part, const std::function<void()>& work) {
  try {
    work();
    told_.erase(part);
  } catch (const std::exception& e) {
    if (strict_) throw;
    undoEdit(session);
    const ImGuiContext* context = ImGui::GetCurrentContext();
    if (context != nullptr && context->WithinFrameScope) ImGui::ErrorCheckEndFrameRecover(nullptr);
    const std::string text = part + ": " + failureText(e);
    if (std::string& told = told_[part]; told != text) {
      told = text;
      session.setStatus(text, NoticeKind::error);
    }
  }
}

}  // namespace lamplighter
