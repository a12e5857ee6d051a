#include "editor/actions/arguments.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "editor/session/user_state.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

bool hasFile(const Session& s) { return !s.document().path.empty(); }

// Whether the argument at `index` is there. It can only be `force`.
bool isForced(const Arguments& a, size_t index) {
  if (a.size() <= index) return false;
  if (a[index] != "force") throw InputError(a[index], "is not an option", "give force or nothing");
  return true;
}

ActionAsk askForFileToSave() {
  return {.kind = ActionAsk::Kind::saveFile,
          .title = "Save as",
          .extensions = kSceneExtensions,
          .suggested = [](const Session& s) {
            return hasFile(s) ? s.document().path.string() : "untitled.gltf";
          }};
}

}  // namespace

void addFileActions(ActionRegistry& r) {
  r.add({"file.open", "Open", "FILE", "Opens a glTF level.", "Ctrl+O",
         [](Session& s, const Arguments& a) { s.requestOpen(a[0]); }})
      .asks = {.title = "Open a scene", .extensions = kSceneExtensions};
  Action& save = r.add(
      {"file.save", "Save", "[force]",
       "Saves the level to its file. With force, also if another program has changed the file "
       "since.",
       "Ctrl+S", [](Session& s, const Arguments& a) {
         if (!hasFile(s))
           throw InputError("file.save", "the level has no file yet", "use file.save_as FILE");
         s.save(s.document().path, isForced(a, 0));
       }});
  save.asks = askForFileToSave();
  save.asks->when = [](const Session& s) { return !hasFile(s); };
  save.asks->answeredBy = "file.save_as";
  save.saves = [](const Session& s, const Arguments& a) {
    return a.empty() ? s.document().path : "";
  };
  Action& saveAs = r.add(
      {"file.save_as", "Save as", "FILE [force]",
       "Saves the level to another .gltf or .glb file. With force, also if another program has "
       "changed the file since.",
       "Ctrl+Shift+S", [](Session& s, const Arguments& a) { s.save(a[0], isForced(a, 1)); }});
  saveAs.asks = askForFileToSave();
  saveAs.saves = [](const Session&, const Arguments& a) {
    return a.size() == 1 ? std::filesystem::path(a[0]) : "";
  };
  r.add({"app.screenshot", "Screenshot", "[FILE]", "Writes the window as a PNG file.", "F12",
         [](Session& s, const Arguments& a) {
           s.requestScreenshot(s.writablePath(a.empty() ? "screenshot.png" : a[0]));
         }});
  r.add({"app.palette", "Command palette", "", "Lists all actions by name, to be chosen and run.",
         "Ctrl+P", [](Session& s, const Arguments&) { s.home().opensPalette = true; }, nullptr,
         true});
  r.add({"script.wait", "Wait until settled", "",
         "Renders frames until the picture no longer changes. For scripts.", "",
         [](Session& s, const Arguments&) {
           constexpr int kPatience = 100000;  // frames
           for (int i = 0; i < kPatience; ++i)
             if (s.renderFrame().settled) return;
           throw InputError("script.wait", "the picture does not settle",
                            "use fewer light samples");
         }});
  r.add({"app.quit", "Quit", "", "Quits the program.", "Ctrl+Q",
         [](Session& s, const Arguments&) { s.requestQuit(); }});
}

}  // namespace lamplighter
