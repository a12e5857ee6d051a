// The file browser of the editor: folders, places, and a text line for a name, a path or a part of
// a name. Keyboard: arrows choose an entry, Enter confirms it, Backspace in an empty line and
// Alt+Up open the parent folder, Ctrl+1 etc. open the places, Escape cancels.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "editor/keys/action.h"
#include "ui/panels/dialogs/file_list.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

class FileDialog {
 public:
  // Opens the dialog for what an action asks, in the folder of `start`.
  void open(const std::string& action, const ActionAsk& asks, const std::filesystem::path& start);
  // The text of the action with the chosen file or folder, once; "": none yet.
  std::string draw(PanelContext ui);
  // Whether the last draw() closed the dialog without an answer.
  bool cancelled() const { return cancelled_; }

 private:
  bool writes() const { return asks_.kind == ActionAsk::Kind::saveFile; }
  bool choosesFolder() const { return asks_.kind == ActionAsk::Kind::folder; }
  void go(const std::filesystem::path& folder);
  std::vector<std::filesystem::path> places(const Session& session) const;
  void drawFolder(const PanelContext& ui);
  void drawPlaces(const PanelContext& ui);
  bool drawEntries(const PanelContext& ui, const std::vector<FileEntry>& shown);
  bool drawLine(const PanelContext& ui);
  bool pressKeys(const PanelContext& ui, const std::vector<FileEntry>& shown, bool entered);
  std::string answer() const;

  std::string action_;
  ActionAsk asks_;
  bool opening_ = false, takesFocus_ = false, scrolls_ = false, cancelled_ = false;
  std::filesystem::path folder_;
  std::string file_;      // the text line
  bool filters_ = false;  // the user typed in the line: it filters the list
  int chosen_ = -1;       // index of the shown entry chosen by arrow keys
  std::vector<FileEntry> entries_;
  std::string error_;
};

}  // namespace lamplighter
