#include "renderer/methods/field_light/parameters.h"

namespace lamplighter {

const ParameterTable<LightFieldParameters>& lightFieldParameters() {
  using P = LightFieldParameters;
  static const ParameterTable<P> table{
      {&P::fieldTexel,
       "field_texel",
       "Texel of the field",
       "m",
       "Side of the texels of surface that keep the light of the field. Texels are larger where "
       "field_memory is short.",
       {0.02, 10.0, kLogarithmic},
       ParameterGroup::quality},
      {&P::fieldDivisions,
       "field_directions",
       "Directions",
       "directions",
       "Directions along which light travels, each both ways. More: finer shadows of bounced "
       "light, "
       "more memory and work.",
       {{"33", 4}, {"129", 8}, {"513", 16}, {"2049", 32}}},
      {&P::fieldSight,
       "field_sight",
       "Visibility",
       "",
       "How texels find what they see in a direction. lines: on a grid of parallel lines, as paper "
       "5 has it. rays: exactly; the cost depends less on the number of triangles. automatic: rays "
       "where there are many triangles for each texel.",
       {{"automatic", FieldSightChoice::automatic},
        {"lines", FieldSightChoice::lines},
        {"rays", FieldSightChoice::rays}}},
      {&P::fieldCell,
       "field_cell",
       "Cell of lines",
       "texels",
       "Distance of parallel lines, as a multiple of the side of a texel. Smaller: less leaks at "
       "edges, more work.",
       {0.1, 10.0, kLogarithmic},
       ParameterGroup::quality},
      {&P::fieldLamps, "field_lamps", "Lamps in the field",
       "Area lights and surfaces that emit send their light along the directions of the field, as "
       "paper 5 has it, in place of light samples. The cost does not depend on how many there are; "
       "small lamps show single directions.",
       ParameterGroup::quality},
      {&P::fieldSets,
       "field_sets",
       "Sets of directions",
       "sets",
       "Sets of turned directions that are averaged once the scene is at rest, so that bounced "
       "light does not show single directions. 1: only those that are kept.",
       {1, 256, kLogarithmic},
       ParameterGroup::quality},
      {&P::fieldMemory,
       "field_memory",
       "Memory of the field",
       "MiB",
       "Memory for what texels see in all directions, about. If it is short, texels are larger.",
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
        .meaning = "Texels of surface that keep the light of the field."}},
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
        .meaning = "Directions along which light travels, each both ways."}},
      {&S::fieldSamples,
       {.name = "field_samples",
        .label = "Partners found",
        .unit = "partners",
        .meaning = "Pairs of a texel and a direction for which it was found in this frame what the "
                   "texel sees.",
        .kind = work}},
      {&S::fieldCrossings,
       {.name = "field_crossings",
        .label = "Crossings of lines",
        .unit = "crossings",
        .meaning = "Crossings of parallel lines with surfaces that were found in this frame.",
        .kind = work}},
      {&S::fieldRays,
       {.name = "field_rays",
        .label = "Rays of the field",
        .unit = "rays",
        .meaning = "Rays for what texels see, and for the direct light of texels, that were traced "
                   "in this frame.",
        .kind = work}},
      {&S::fieldPrepared,
       {.name = "field_prepared",
        .label = "Prepared",
        .unit = "%",
        .meaning = "Share of the directions in which it is found what texels see. Until all are, "
                   "bounced light is in part that of before, or of fewer directions.",
        .kind = pending,
        .status = "light field {}",
        .shownFrom = 0.0,
        .shownBelow = 100.0}},
      {&S::fieldBytes,
       {.name = "field_bytes",
        .label = "Memory of the field",
        .unit = "bytes",
        .meaning = "Memory of what texels see and of their light.",
        .budget = "field_memory",
        .cost = "{}"}}};
  return table;
}

}  // namespace lamplighter
