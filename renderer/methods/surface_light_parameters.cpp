#include "renderer/methods/surface_light_parameters.h"

namespace lamplighter {

const ParameterTable<SurfaceLightParameters>& surfaceLightParameters() {
  using P = SurfaceLightParameters;
  static const ParameterTable<P> table{
      {&P::coarseEdge,
       "coarse_edge",
       "Coarse edge",
       "m",
       "Longest edge of the surface elements that exchange bounced light. Smaller: finer bounced "
       "shadows, more rays after an edit. Elements are larger if link_memory is too small.",
       {0.02, 10.0, kLogarithmic},
       ParameterGroup::quality},
      {&P::gatherRays,
       "gather_rays",
       "Gather rays",
       "",
       "Rays from each corner of an element that find the bounced light that arrives there. More: "
       "less noise; rays and memory grow in proportion. If link_memory is too small, they become "
       "fewer, but not fewer than 32.",
       {16, 4096, kLogarithmic},
       ParameterGroup::quality},
      {&P::mask,
       "mask",
       "Mask",
       "places",
       "Side of the bit mask that finds the visible part of a flat light, for direct light that "
       "bounces: exact soft shadows instead of one ray for each corner of an element. Costs more "
       "time after an edit. 0: rays.",
       {{"0", 0}, {"16", 16}, {"32", 32}, {"64", 64}},
       ParameterGroup::quality},
      {&P::projection,
       "projection",
       "Projection",
       "",
       "Directions of gather rays. hemisphere: all. plane: a square picture with an angle of 160°, "
       "as in paper 4, which misses 2.5% of the light at each bounce. Both trace the same number "
       "of rays.",
       {{"hemisphere", GatherProjection::hemisphere}, {"plane", GatherProjection::plane}},
       ParameterGroup::quality},
      {&P::linkMemory,
       "link_memory",
       "Link memory",
       "MiB",
       "Memory limit for the hits of gather rays, 8 bytes each. If it is too small, elements are "
       "larger.",
       {1, 65536, kLogarithmic},
       ParameterGroup::budgets,
       "More: smaller elements on large levels, down to coarse_edge."}};
  return table;
}

void SurfaceLightStats::take(const SurfaceLight::Counts& counts) {
  elements = static_cast<int>(counts.leaves);
  elementCorners = static_cast<int>(counts.samples);
  elementEdge = counts.edge;
  cornersTraced = static_cast<int>(counts.samplesTraced);
  masks = static_cast<int>(counts.masks);
  directFactors = counts.factorsFound;
  surfaceBytes = counts.bytes;
}

const StatisticTable<SurfaceLightStats>& surfaceLightStatistics() {
  using S = SurfaceLightStats;
  static const StatisticTable<S> table{
      {&S::elements,
       {.name = "elements",
        .label = "Elements",
        .unit = "elements",
        .meaning = "Surface elements that exchange bounced light."}},
      {&S::elementCorners,
       {.name = "element_corners",
        .label = "Corners of elements",
        .unit = "corners",
        .meaning = "Points at which gather rays find bounced light."}},
      {&S::elementEdge,
       {.name = "element_edge",
        .label = "Edge of elements",
        .unit = "m",
        .meaning = "Longest edge of elements that memory allows.",
        .budget = "link_memory",
        .cost = "edges of {}"}},
      {&S::cornersTraced,
       {.name = "corners_traced",
        .label = "Corners traced",
        .unit = "corners",
        .meaning = "Corners of elements with gather rays that were traced in this frame.",
        .kind = StatisticKind::work}},
      {&S::directFactors,
       {.name = "direct_factors",
        .label = "Direct factors",
        .unit = "factors",
        .meaning = "Pairs of an element and a light whose direct light was computed in this frame.",
        .kind = StatisticKind::work}},
      {&S::masks,
       {.name = "masks",
        .label = "Masks",
        .unit = "masks",
        .meaning = "Masks on lights that were drawn in this frame, for direct light that bounces.",
        .kind = StatisticKind::work}},
      {&S::surfaceBytes,
       {.name = "surface_bytes",
        .label = "Memory of light on surfaces",
        .unit = "bytes",
        .meaning = "Memory of elements, of the hits of their rays, and of their direct light.",
        .budget = "link_memory",
        .cost = "{}"}}};
  return table;
}

}  // namespace lamplighter
