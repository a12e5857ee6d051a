// Actions for external files: dropped on the window, or opened recently.
#include <filesystem>

#include "editor/actions/arguments.h"
#include "editor/document/sky_text.h"
#include "editor/edits/edits.h"
#include "editor/lights/light_profile.h"
#include "editor/lights/new_light.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "editor/session/user_state.h"
#include "renderer/base/error.h"
#include "renderer/scene/ies/ies_profile.h"

namespace lamplighter {

namespace {

namespace fs = std::filesystem;

// Other pictures could be meant for a light.
constexpr std::string_view kDroppedSkies[] = {".hdr", ".exr"};
constexpr std::string_view kDropped[] = {".gltf", ".glb", ".hdr", ".exr", ".ies"};

// Searches relative to the working directory, then to the level's folder.
fs::path foundBesideLevel(const Session& s, const std::string& name) {
  const fs::path beside = s.document().path.parent_path() / name;
  std::error_code error;
  return fs::exists(name, error) || !fs::exists(beside, error) ? fs::path(name) : beside;
}

// Sets the profile of the selected point and spot lights. If none is selected, adds a new light on
// the surface under the pointer. One undo step in both cases.
void dropProfile(Session& s, const fs::path& file) {
  const auto profile = readIes(foundBesideLevel(s, file.string()).string());
  const Scene& scene = s.document().scene;
  std::vector<Node> lights;
  for (const NodeId id : s.document().selection) {
    Node n = *scene.find(id);
    if (!takesProfile(n)) continue;
    n.punctual = withProfile(scene, n, profile);
    lights.push_back(std::move(n));
  }
  const std::string name = file.filename().string();
  if (!lights.empty()) {
    const std::string whose =
        lights.size() == 1 ? lights[0].name : std::to_string(lights.size()) + " lights";
    setNodes(s.editing(), "Profile " + name, std::move(lights));
    return s.setStatus(name + " is now the profile of " + whose);
  }
  auto place = s.surfaceUnderPointer({});
  if (!place) place = s.surfaceAhead();
  if (!place) throw InputError(name, "there is no surface for a new light", "point at a surface");
  Node n = newLight("point", glm::length(place->position - s.view().eye),
                    s.document().render.exposureEv, s.unit());
  n.id = s.editing().newNodeId();
  n.name = file.stem().string() + " " + std::to_string(n.id);
  n.punctual = withProfile(scene, n, profile);
  // The light's axis, along which downlights shine, is its −Z. It must point away from the surface.
  Scene with = scene;
  with.nodes.push_back(n);
  if (const auto local = placedOn(with, n.id, *place, s.unit())) n.local = *local;
  addNodes(s.editing(), "Add " + n.name, {n});
  s.select({n.id});
  s.setStatus("Added a light with the profile " + name);
}

void drop(Session& s, const Arguments& files) {
  for (const std::string& file : files) {
    const fs::path path(file);
    if (hasExtension(path, kSceneExtensions)) {
      s.requestOpen(path);
      return;  // the other files would be placed in the level that is being closed
    }
    if (hasExtension(path, kProfileExtensions)) {
      dropProfile(s, path);
    } else if (hasExtension(path, kDroppedSkies)) {
      const Sky& before = s.document().scene.sky;
      s.setSky(Sky::picture(findSkyImage(file, s.document().path.parent_path()), before.rotation,
                            before.scale));
      s.setStatus("The sky is now " + path.filename().string());
    } else {
      throw InputError(path.filename().string(), "cannot be dropped here",
                       "drop a level (.gltf, .glb), a sky (.hdr, .exr) or a profile (.ies)");
    }
  }
}

std::vector<ActionChoice> recent(const Session& s) {
  std::vector<ActionChoice> out;
  for (const fs::path& file : s.home().preferences.recentFiles)
    out.push_back({std::to_string(out.size() + 1), file.string()});
  return out;
}

}  // namespace

void addDropActions(ActionRegistry& r) {
  r.add({"file.drop", "Take a file in", "FILE [FILE]…",
         "Handles files that are dropped on the window: opens a level, sets a .hdr or .exr picture "
         "as the sky, and assigns an .ies profile to the selected lights or to a new light under "
         "the pointer.",
         "", [](Session& s, const Arguments& a) { drop(s, a); }})
      .asks = {.title = "Take a file in", .extensions = kDropped};
  Action again{"file.open_recent",
               "Open recent",
               "N",
               "Opens a recent level. 1 is the most recent.",
               "",
               [](Session& s, const Arguments& a) {
                 const auto& files = s.home().preferences.recentFiles;
                 const float n = numberOf(a[0]);
                 for (size_t i = 0; i < files.size(); ++i)
                   if (n == static_cast<float>(i + 1)) return s.requestOpen(files[i]);
                 throw InputError(a[0], "is not the number of a recent file",
                                  files.empty()
                                      ? "there are none"
                                      : "give one from 1 to " + std::to_string(files.size()));
               },
               {}};
  again.choices = recent;
  r.add(std::move(again));
}

}  // namespace lamplighter
