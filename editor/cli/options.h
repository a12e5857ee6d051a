// What the subcommands share: settings from flags, the view, and refusing outputs early.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "renderer/methods/gi_method.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/scene.h"

namespace lamplighter::cli {

// "640x360" → (640, 360). Throws InputError for anything else, or sizes over 16384.
std::pair<int, int> parseSize(const std::string& text);

// Sets a method's parameter from text; throws InputError with the method's parameter names when it
// has none of that name.
void setParameter(Settings& settings, const MethodInfo& method, const std::string& name,
                  const std::string& text);
// "name=value".
void setFromAssignment(Settings& settings, const MethodInfo& method, const std::string& assignment);

// What a frame may change at once in a run that nobody watches.
inline constexpr int kAllAtOnce = 65536;

// Flags of commands that run a method; empty where not given.
struct MethodFlags {
  std::string vpls, directShare, bounces, seed, spp;  // shortcuts
  std::vector<std::string> assignments;               // "name=value"
};
// For a run that nobody watches. Throws InputError; a shortcut that the method has no parameter for
// gives a warning on standard error.
Settings settingsOf(const MethodFlags& flags, const MethodInfo& method);

// The camera by name or index (""; the first one, or a view of everything when there is none).
View chooseView(const Scene& scene, const std::string& camera, int width, int height);

// Throws InputError when a file of that name could not be made: a folder that is not there or not
// writable, or an ending that is none of `endings` (such as ".png"; empty: any).
void requireWritable(const std::filesystem::path& file, const std::vector<std::string>& endings);

}  // namespace lamplighter::cli
