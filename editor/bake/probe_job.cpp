#include "editor/bake/probe_job.h"

#include <spdlog/fmt/fmt.h>

#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "renderer/frame/world.h"
#include "renderer/probes/probe_file.h"

namespace lamplighter {

std::vector<std::string> probeFileNames(const std::string& name) {
  return {name + "_probes.json", name + "_probes.exr"};
}

std::optional<ProbeReport> bakeProbes(const Scene& scene, const ProbeJobOptions& o,
                                      const BakeProgress& progress) {
  World world;
  world.update(scene, SceneChanges::all());
  const RenderScene& render = world.scene();
  if (render.bounds.empty())
    throw InputError(o.name, "has no surface around which probes could be placed",
                     "give a scene with meshes");
  ProbeGrid grid = placeProbes(render, *world.rays(), o.grid);
  ProbeReport report;
  report.spacing = render.unit * grid.spacing;
  if (grid.isCoarser)
    report.warnings.push_back(fmt::format(
        "probes are {:.3g} m apart instead of {:.3g} m: there would be more than {} of them",
        report.spacing, render.unit * o.grid.spacing, o.grid.most));
  const size_t placed = grid.count(ProbeState::valid);
  const ProbeReference reference(render, *world.rays(), o.paths);
  std::vector<ProbeSh> light =
      probeLight(grid, reference.source(static_cast<uint32_t>(o.samples)), progress);
  if (light.empty()) return std::nullopt;
  markUnlit(render, light, grid);
  fillInvalid(grid, light);
  for (size_t i = 0; i < report.counts.size(); ++i)
    report.counts[i] = grid.count(static_cast<ProbeState>(i));
  if (report.counts[0] == 0)
    report.warnings.push_back(placed == 0
                                  ? "no probe has room: all are inside, near surfaces or outside"
                                  : "no light arrives at any probe");

  const std::vector<std::string> names = probeFileNames(o.name);
  const std::string text =
      probeText(grid, light, {names[1], render.unit, o.grid.padding, o.samples, o.paths.bounces});
  PendingFile table(o.output / names[0],
                    {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  PendingFile volume(o.output / names[1], probeVolume(grid, light));
  volume.putInPlace();
  try {
    table.putInPlace();
  } catch (...) {
    volume.undo();
    throw;
  }
  for (const std::string& name : names) report.files.push_back(o.output / name);
  return report;
}

}  // namespace lamplighter
