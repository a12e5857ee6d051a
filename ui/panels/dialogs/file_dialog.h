// The in-app file browser: folders, places, a line to type a name, a path or a part of a name in.
// By keys alone: arrows choose, Enter takes what is chosen, Backspace in an empty line and Alt+Up
// go up a folder, Ctrl+1 and so on go to the places, Escape leaves.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ui/panels/dialogs/file_list.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

class FileDialog {
 public:
  enum class Kind { open, save, picture, profile, lightPicture, timeline, folder };
  void open(Kind kind, const std::filesystem::path& start);
  // The chosen file or folder, once.
  std::optional<std::filesystem::path> draw(PanelContext ui);
  Kind kind() const { return kind_; }

 private:
  FileKind fileKind() const;
  bool writes() const { return kind_ == Kind::save || kind_ == Kind::timeline; }
  void go(const std::filesystem::path& folder);
  std::vector<std::filesystem::path> places(const Session& session) const;
  void drawFolder(const PanelContext& ui);
  void drawPlaces(const PanelContext& ui);
  bool drawEntries(const PanelContext& ui, const std::vector<FileEntry>& shown);
  bool drawLine(const PanelContext& ui);
  bool pressKeys(const PanelContext& ui, const std::vector<FileEntry>& shown, bool entered);
  std::optional<std::filesystem::path> result();

  Kind kind_ = Kind::open;
  bool opening_ = false, takesFocus_ = false, scrolls_ = false;
  std::filesystem::path folder_;
  std::string file_;      // the line
  bool filters_ = false;  // it was typed: what does not hold it is not listed
  int chosen_ = -1;       // of the entries shown, by arrow keys
  std::vector<FileEntry> entries_;
  std::string error_;
};

}  // namespace lamplighter
