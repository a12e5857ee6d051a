// Actions of the camera: bookmarks, cameras of the level, steps by keys.
#include <algorithm>
#include <cmath>

#include "editor/actions/arguments.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

constexpr float kStepSeconds = 0.25f;  // seconds of flight per step

int slotOf(const std::string& text) {
  const float number = numberOf(text);
  if (number != std::floor(number) || number < 1.0f || number > kCameraBookmarks)
    throw InputError(text, "is not the number of a bookmark", "give one from 1 to 9");
  return static_cast<int>(number);
}

const CameraBookmark* find(const Session& s, int slot) {
  for (const CameraBookmark& b : s.document().scene.bookmarks)
    if (b.slot == slot) return &b;
  return nullptr;
}

void store(Session& s, int slot) {
  const std::string number = std::to_string(slot);
  Transaction edit = s.editing().begin("Bookmark " + number);
  std::vector<CameraBookmark>& all = edit.bookmarks();
  std::erase_if(all, [&](const CameraBookmark& b) { return b.slot == slot; });
  const View& view = s.view();
  all.push_back({slot, view.eye, view.orientation, view.yfov});
  std::sort(all.begin(), all.end(),
            [](const CameraBookmark& a, const CameraBookmark& b) { return a.slot < b.slot; });
  edit.commit();
  s.setStatus("Stored this view as bookmark " + number + "; press " + number + " to return to it");
}

void go(Session& s, int slot) {
  const CameraBookmark* b = find(s, slot);
  if (b == nullptr) {
    const std::string number = std::to_string(slot);
    throw InputError("bookmark " + number, "is empty",
                     "press Ctrl+" + number + " to store the current view in it");
  }
  View view = s.view();
  view.eye = b->eye;
  view.orientation = b->orientation;
  view.yfov = b->yfov;
  s.setView(view);
  s.setStatus("Bookmark " + std::to_string(slot));
}

void clear(Session& s, int slot) {
  Transaction edit = s.editing().begin("Clear bookmark " + std::to_string(slot));
  if (std::erase_if(edit.bookmarks(), [&](const CameraBookmark& b) { return b.slot == slot; }) == 0)
    throw InputError("bookmark " + std::to_string(slot), "is empty",
                     "give the number of a stored bookmark");
  edit.commit();
}

std::vector<ActionChoice> bookmarks(const Session& s) {
  std::vector<ActionChoice> out;
  for (const CameraBookmark& b : s.document().scene.bookmarks)
    out.push_back({std::to_string(b.slot), "Bookmark " + std::to_string(b.slot)});
  return out;
}

std::vector<ActionChoice> slots(const Session& s) {
  std::vector<ActionChoice> out;
  for (int slot = 1; slot <= kCameraBookmarks; ++slot) {
    const std::string number = std::to_string(slot);
    out.push_back(
        {number, "Bookmark " + number + (find(s, slot) != nullptr ? " (overwrite)" : "")});
  }
  return out;
}

std::vector<ActionChoice> cameras(const Session& s) {
  std::vector<ActionChoice> out;
  for (const Node& n : s.document().scene.nodes)
    if (n.camera != kNone) out.push_back({n.name, n.name});
  return out;
}

void addBookmarkActions(ActionRegistry& r) {
  const auto add = [&](const char* name, const char* label, const char* help,
                       void (*run)(Session&, int), const char* keys,
                       std::vector<ActionChoice> (*choices)(const Session&)) {
    Action action{name, label, "1…9",
                  help, "",    [run](Session& s, const Arguments& a) {
                    run(s, slotOf(a[0])); },
                  {},   true};
    action.choices = choices;
    r.add(std::move(action));
    for (int slot = 1; keys != nullptr && slot <= kCameraBookmarks; ++slot) {
      const std::string number = std::to_string(slot);
      r.addKey(std::string(name) + " " + number, keys + number);
    }
  };
  add("bookmark.store", "Store bookmark", "Stores the camera view under a number, in the level.",
      store, "Ctrl+", slots);
  add("bookmark.go", "Go to bookmark", "Sets the camera to a stored view.", go, "", bookmarks);
  add("bookmark.clear", "Clear bookmark", "Deletes a stored view.", clear, nullptr, bookmarks);
}

}  // namespace

void addCameraActions(ActionRegistry& r) {
  addBookmarkActions(r);
  Action camera{"camera.go",
                "Camera of the level",
                "NAME",
                "Sets the view to one of the level's cameras.",
                "",
                [](Session& s, const Arguments& a) {
                  const Node& n = nodeNamed(s.document(), a[0]);
                  if (n.camera == kNone)
                    throw InputError(a[0], "is not a camera", "give the name of a camera");
                  const View& view = s.view();
                  s.setView(viewOfCamera(s.document().scene, n, view.width, view.height));
                  s.setStatus("Camera " + n.name);
                },
                {},
                true};
  camera.choices = cameras;
  r.add(std::move(camera));
  r.add({"camera.move", "Move the camera", "RIGHT UP FORWARD",
         "Moves the camera in steps. A step is the distance flown in a quarter of a second.", "",
         [](Session& s, const Arguments& a) {
           const vec3 way = glm::clamp(vectorOf(a, 0), vec3(-1e4f), vec3(1e4f));
           View view = s.view();
           view.eye += kStepSeconds * s.cameraSpeed() *
                       (way.x * view.right() + way.y * vec3(0, 1, 0) + way.z * view.forward());
           s.setView(view);
         },
         nullptr, true});
  r.add({"camera.turn", "Turn the camera", "LEFT UP", "Turns the camera by angles in degrees.", "",
         [](Session& s, const Arguments& a) {
           View view = s.view();
           const float pitch = std::asin(std::clamp(view.forward().y, -1.0f, 1.0f));
           const float limit = glm::radians(89.0f);  // beyond it the picture would be upside down
           const float up =
               std::clamp(pitch + glm::radians(std::fmod(numberOf(a[1]), 360.0f)), -limit, limit) -
               pitch;
           const float left = glm::radians(std::fmod(numberOf(a[0]), 360.0f));
           view.orientation = glm::normalize(glm::angleAxis(left, vec3(0, 1, 0)) *
                                             glm::angleAxis(up, view.right()) * view.orientation);
           s.setView(view);
         },
         nullptr, true});
  r.addKey("camera.turn 10 0", "Alt+Left");
  r.addKey("camera.turn -10 0", "Alt+Right");
  r.addKey("camera.turn 0 10", "Alt+Up");
  r.addKey("camera.turn 0 -10", "Alt+Down");
  r.addKey("camera.move -1 0 0", "Ctrl+Left");
  r.addKey("camera.move 1 0 0", "Ctrl+Right");
  r.addKey("camera.move 0 0 1", "Ctrl+Up");
  r.addKey("camera.move 0 0 -1", "Ctrl+Down");
  r.addKey("camera.move 0 1 0", "Ctrl+Page_up");
  r.addKey("camera.move 0 -1 0", "Ctrl+Page_down");
}

}  // namespace lamplighter
