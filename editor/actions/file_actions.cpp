#include "editor/actions/arguments.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

void addFileActions(ActionRegistry& r) {
  r.add({"file.open",
         "Open…",
         "FILE",
         "Opens a glTF level.",
         "Ctrl+O",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 1, 1, "file.open FILE");
           s.requestOpen(a[0]);
         },
         {}});
  r.add({"file.save",
         "Save",
         "[force]",
         "Saves the level to its file. With force, also if another program has changed the file "
         "since.",
         "Ctrl+S",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 0, 1, "file.save [force]");
           if (!a.empty() && a[0] != "force")
             throw InputError(a[0], "is no way to save", "give force or nothing");
           if (s.document().path.empty())
             throw InputError("file.save", "the level has no file yet", "use file.save_as FILE");
           s.save(s.document().path, !a.empty());
         },
         {}});
  r.add({"file.save_as",
         "Save as…",
         "FILE",
         "Saves the level to another .gltf or .glb file.",
         "Ctrl+Shift+S",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 1, 1, "file.save_as FILE");
           s.save(a[0]);
         },
         {}});
  r.add({"app.screenshot",
         "Screenshot",
         "[FILE]",
         "Writes the window as a PNG file.",
         "F12",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 0, 1, "app.screenshot [FILE]");
           s.requestScreenshot(s.writablePath(a.empty() ? "screenshot.png" : a[0]));
         },
         {}});
  r.add({"app.palette",
         "Command palette",
         "",
         "Lists all actions by name, to be chosen and run.",
         "Ctrl+P",
         [](Session&, const Arguments&) {},  // the window opens the dialog
         {},
         true});
  r.add({"script.wait",
         "Wait until settled",
         "",
         "Renders frames until the picture no longer changes. For scripts.",
         "",
         [](Session& s, const Arguments&) {
           constexpr int kPatience = 100000;  // frames
           for (int i = 0; i < kPatience; ++i)
             if (s.renderFrame().settled) return;
           throw InputError("script.wait", "the picture does not settle", "set smaller counts");
         },
         {}});
  r.add({"app.quit",
         "Quit",
         "",
         "Quits the program.",
         "Ctrl+Q",
         [](Session& s, const Arguments&) { s.requestQuit(); },
         {}});
}

}  // namespace lamplighter
