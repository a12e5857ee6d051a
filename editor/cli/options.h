// Functions that the subcommands share: settings from flags, the choice of the view, and early
// checks of output files.
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

// Sets a parameter of the method from text. Throws InputError, with the names of the method's
// parameters, if the method has no such parameter.
void setParameter(Settings& settings, const MethodInfo& method, const std::string& name,
                  const std::string& text);
// "name=value".
void setFromAssignment(Settings& settings, const MethodInfo& method, const std::string& assignment);

// Limit of changes per frame for non-interactive runs: effectively no limit.
inline constexpr int kAllAtOnce = 65536;

// Flags of commands that run a method. A flag that is not given is empty.
struct MethodFlags {
  std::string vpls, directShare, bounces, seed, spp;  // shortcuts
  std::vector<std::string> assignments;               // "name=value"
};
// Sets the parameters that the flags name. Throws InputError. Prints a warning to standard error
// for a shortcut whose parameter the method does not have.
void applyFlags(Settings& settings, const MethodFlags& flags, const MethodInfo& method);
// Settings for a non-interactive run, with the flags applied.
Settings settingsOf(const MethodFlags& flags, const MethodInfo& method);

// The camera with that name or index. "": the first camera, or a view of the whole scene if it has
// no camera.
View chooseView(const Scene& scene, const std::string& camera, int width, int height);

// Throws InputError if the file could not be created: its folder does not exist or is not writable,
// or its extension is not in `endings` (for example ".png"; empty: any extension).
void requireWritable(const std::filesystem::path& file, const std::vector<std::string>& endings);

}  // namespace lamplighter::cli
