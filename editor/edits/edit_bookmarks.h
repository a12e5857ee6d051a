// Other camera bookmarks.
#pragma once

#include <utility>
#include <vector>

#include "editor/edits/command.h"

namespace lamplighter {

class EditBookmarks final : public Command {
 public:
  EditBookmarks(std::string label, const Document& document, std::vector<CameraBookmark> after)
      : label_(std::move(label)), before_(document.scene.bookmarks), after_(std::move(after)) {}
  std::string label() const override { return label_; }
  void apply(Document& document) override { document.scene.bookmarks = after_; }
  void revert(Document& document) override { document.scene.bookmarks = before_; }
  bool absorb(const Command&) override { return false; }
  bool changesNothing() const override { return before_ == after_; }
  size_t bytes() const override {
    return sizeof *this + sizeof(CameraBookmark) * (before_.size() + after_.size());
  }

 private:
  std::string label_;
  std::vector<CameraBookmark> before_, after_;
};

}  // namespace lamplighter
