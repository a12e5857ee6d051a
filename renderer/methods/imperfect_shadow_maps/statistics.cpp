#include "renderer/methods/imperfect_shadow_maps/statistics.h"

namespace lamplighter {

void ImperfectStats::take(const ImperfectPicture& picture) {
  bouncedSamples = static_cast<int>(picture.lights().lights.size());
  potentialLights = static_cast<int>(picture.map().size());
  pathsWalked = picture.map().walked();
  defended = picture.lights().defended;
  occluderPoints = static_cast<int>(picture.points().size());
  pointsPending = static_cast<int>(picture.points().pendingFrames());
  pointBytes = picture.points().memoryBytes();
  raysTraced += picture.raysTraced();
}

const StatisticTable<ImperfectStats>& imperfectStatistics() {
  using S = ImperfectStats;
  static const StatisticTable<S> table{
      {&S::lightSamples,
       {.name = "light_samples",
        .label = "Light samples",
        .unit = "samples",
        .meaning = "Light samples on the lights, for direct light."}},
      {&S::bouncedSamples,
       {.name = "bounced_samples",
        .label = "Bounced samples",
        .unit = "samples",
        .meaning = "Light samples that carry bounced light."}},
      {&S::potentialLights,
       {.name = "potential_lights",
        .label = "Potential samples",
        .unit = "samples",
        .meaning = "Vertices of light paths among which bounced samples are chosen."}},
      {&S::pathsWalked,
       {.name = "reflective_paths",
        .label = "Paths traced",
        .unit = "paths",
        .meaning = "Light paths that were traced again in this frame.",
        .kind = StatisticKind::work}},
      {&S::defended,
       {.name = "defended",
        .label = "Flux out of sight",
        .unit = "share",
        .meaning = "Share of the bounced flux that cannot reach any view sample; only the "
                   "defensive share of samples represents it."}},
      {&S::occluderPoints,
       {.name = "occluder_points",
        .label = "Occluder points",
        .unit = "points",
        .meaning = "Points on the surfaces from which imperfect shadow maps are drawn."}},
      {&S::pointsPending,
       {.name = "points_pending",
        .label = "Points to place",
        .unit = "frames",
        .meaning = "Frames until all points are placed for the current view.",
        .kind = StatisticKind::pending}},
      {&S::pointBytes,
       {.name = "point_bytes",
        .label = "Memory of points",
        .unit = "bytes",
        .meaning = "Memory of occluder points and of the data by which they are chosen."}},
      commonStatistics()};
  return table;
}

}  // namespace lamplighter
