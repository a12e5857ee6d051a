#include "renderer/methods/field_light/parameters.h"

namespace lamplighter {

const ParameterTable<LightFieldParameters>& lightFieldParameters() {
  using P = LightFieldParameters;
  static const ParameterTable<P> table{
      {&P::fieldTexel,
       "field_texel",
       "Texel of the field",
       "m",
       "Side of the surface texels that store the light of the field. Half the side: four times "
       "the texels, memory and work. Texels are larger if field_memory is too small.",
       {0.02, 10.0, kLogarithmic},
       ParameterGroup::quality},
      {&P::fieldDivisions,
       "field_directions",
       "Directions",
       "directions",
       "Directions along which light travels, each in both senses. More: finer shadows of bounced "
       "light; memory and work grow in proportion.",
       {{"33", 4}, {"129", 8}, {"513", 16}, {"2049", 32}}},
      {&P::fieldSight,
       "field_sight",
       "Visibility",
       "",
       "How to find what a texel sees in a direction. lines: on a grid of parallel lines, as in "
       "paper 5; the cost grows with the number of triangles. rays: exact, one ray for each texel "
       "and direction. automatic: rays in levels with more than 16 triangles per texel, otherwise "
       "lines.",
       {{"automatic", FieldSightChoice::automatic},
        {"lines", FieldSightChoice::lines},
        {"rays", FieldSightChoice::rays}}},
      {&P::fieldCell,
       "field_cell",
       "Cell of lines",
       "texels",
       "Distance of parallel lines, as a multiple of the side of a texel. Smaller: fewer light "
       "leaks at edges; half the distance costs up to four times the work. Not used with rays.",
       {0.1, 10.0, kLogarithmic},
       ParameterGroup::quality},
      {&P::fieldLamps, "field_lamps", "Lamps in the field",
       "Area lights and emissive surfaces send their light along the directions of the field, as "
       "in paper 5, instead of light samples. The cost does not depend on the number of lights, "
       "but the light of small lamps is visibly split into single directions.",
       ParameterGroup::quality},
      {&P::fieldSets,
       "field_sets",
       "Sets of directions",
       "sets",
       "Number of rotated sets of directions that are averaged at rest, so that single directions "
       "are not visible in bounced light. Each further set costs as much time as the first, spread "
       "over frames at rest, and almost no memory. 1: only the first set.",
       {1, 256, kLogarithmic},
       ParameterGroup::quality},
      {&P::fieldMemory,
       "field_memory",
       "Memory of the field",
       "MiB",
       "Approximate memory for what texels see in all directions, 4 bytes for each texel and "
       "direction. If it is too small, texels are larger.",
       {1, 65536, kLogarithmic},
       ParameterGroup::budgets,
       "More: smaller texels on large levels, down to field_texel."}};
  return table;
}

void LightFieldStats::take(const LightField& light) {
  fieldTexels = static_cast<int>(light.texels().size());
  fieldDirections = static_cast<int>(light.directions().size());
  fieldTexelSide = light.texelSide();
  fieldSamples = light.counts().partners.samples;
  fieldCrossings = light.counts().partners.crossings;
  fieldRays = light.counts().partners.rays + light.counts().lampRays;
  fieldBytes = light.counts().bytes;
  fieldPrepared = 100.0f * light.prepared();
}

const StatisticTable<LightFieldStats>& lightFieldStatistics() {
  using S = LightFieldStats;
  using enum StatisticKind;
  static const StatisticTable<S> table{
      {&S::fieldTexels,
       {.name = "field_texels",
        .label = "Texels of the field",
        .unit = "texels",
        .meaning = "Surface texels that store the light of the field."}},
      {&S::fieldTexelSide,
       {.name = "field_texel_side",
        .label = "Side of texels",
        .unit = "m",
        .meaning = "Side of the texels of the field that memory allows.",
        .budget = "field_memory",
        .cost = "texels of {}"}},
      {&S::fieldDirections,
       {.name = "field_directions",
        .label = "Directions",
        .unit = "directions",
        .meaning = "Directions along which light travels, each in both senses."}},
      {&S::fieldSamples,
       {.name = "field_samples",
        .label = "Partners found",
        .unit = "partners",
        .meaning =
            "Pairs of a texel and a direction whose visible texel was computed in this frame.",
        .kind = work}},
      {&S::fieldCrossings,
       {.name = "field_crossings",
        .label = "Crossings of lines",
        .unit = "crossings",
        .meaning =
            "Intersections of parallel lines with surfaces that were computed in this frame.",
        .kind = work}},
      {&S::fieldRays,
       {.name = "field_rays",
        .label = "Rays of the field",
        .unit = "rays",
        .meaning = "Rays that were traced in this frame for the visibility and the direct light of "
                   "texels.",
        .kind = work}},
      {&S::fieldPrepared,
       {.name = "field_prepared",
        .label = "Prepared",
        .unit = "%",
        .meaning = "Share of the directions in which visibility is computed. Below 100%, bounced "
                   "light is partly outdated or uses fewer directions.",
        .kind = pending,
        .status = "light field {}",
        .shownFrom = 0.0,
        .shownBelow = 100.0}},
      {&S::fieldBytes,
       {.name = "field_bytes",
        .label = "Memory of the field",
        .unit = "bytes",
        .meaning = "Memory of the visibility and the light of texels.",
        .budget = "field_memory",
        .cost = "{}"}}};
  return table;
}

}  // namespace lamplighter
