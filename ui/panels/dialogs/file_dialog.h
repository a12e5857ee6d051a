// The file browser of the editor: folders, places, and a text line for a name, a path or a part of
// a name. Keyboard: arrows choose an entry, Enter confirms it, Backspace in an empty line and
// Alt+Up open the parent folder, Ctrl+1 etc. open the places, Escape cancels.
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
  std::string file_;      // the text line
  bool filters_ = false;  // the user typed in the line: it filters the list
  int chosen_ = -1;       // index of the shown entry chosen by arrow keys
  std::vector<FileEntry> entries_;
  std::string error_;
};

}  // namespace lamplighter
