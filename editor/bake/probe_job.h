// Bakes light probes of a scene to files, for moving objects in an engine.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/bake/bake_job.h"
#include "renderer/probes/probe_light.h"

namespace lamplighter {

struct ProbeJobOptions {
  ProbeGridOptions grid;
  PathTracerOptions paths;       // bounces and seed
  int samples = 1024;            // paths per probe
  std::filesystem::path output;  // folder; created if it does not exist
  std::string name;              // prefix of the names of all files
};

struct ProbeReport {
  std::array<size_t, kProbeStates> counts{};  // number of probes by state
  float spacing = 0.0f;                       // [m]
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;
};

// The names of the files that bakeProbes() writes into its folder.
std::vector<std::string> probeFileNames(const std::string& name);

// Writes NAME_probes.json and NAME_probes.exr (renderer/probes/probe_file.h), both or neither.
// Returns nullopt if `progress` returns false; `progress` receives the number of probes.
// Deterministic. Throws InputError, also if the scene has no surface.
std::optional<ProbeReport> bakeProbes(const Scene& scene, const ProbeJobOptions& options,
                                      const BakeProgress& progress);

}  // namespace lamplighter
