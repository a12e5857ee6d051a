#include "renderer/methods/surface_shadow_maps/parameters.h"

namespace lamplighter {
namespace {

const ParameterTable<StoredDepthParameters>& storedDepthParameters() {
  using P = StoredDepthParameters;
  static const ParameterTable<P> table{
      {&P::texel,
       "texel",
       "Texel",
       "m",
       "Side of the texels that keep bounced light and what they see. Texels are larger where "
       "depth_memory is short.",
       {0.02, 10.0, kLogarithmic},
       ParameterGroup::quality},
      {&P::order,
       "texel_order",
       "Order of texels",
       "",
       "Along which texels depths are compressed. zigzag: row by row. spiral: along the border of "
       "a "
       "chart, then inwards. greedy: always the nearest texel.",
       {{"zigzag", TexelOrder::zigzag},
        {"spiral", TexelOrder::spiral},
        {"greedy", TexelOrder::greedy}}},
      {&P::map,
       "depth_map",
       "Depth map",
       "",
       "How the directions around a texel are divided. cube: six faces. octahedral: one square.",
       {{"cube", DepthMapKind::cube}, {"octahedral", DepthMapKind::octahedral}}},
      {&P::resolution,
       "depth_resolution",
       "Depth resolution",
       "pixels",
       "Side of a depth map, or of a face of the cube.",
       {8, 128, kLogarithmic}},
      {&P::visibility,
       "link_visibility",
       "Visibility",
       "",
       "How texels find out what they see when links are made. stored: by their depths. rays: by "
       "rays, to compare with.",
       {{"stored", TexelVisibility::stored}, {"rays", TexelVisibility::rays}}},
      {&P::linkError,
       "link_error",
       "Link error",
       "%",
       "Surfaces that may fill more of the view of a texel are divided. Less: more links, more "
       "exact bounced light.",
       {0.02, 10.0, kLogarithmic},
       ParameterGroup::quality,
       "Less: more exact bounced light."},
      {&P::depthMemory,
       "depth_memory",
       "Depth memory",
       "MiB",
       "Memory for depths and links, about. If it is short, texels are larger.",
       {1, 65536, kLogarithmic},
       ParameterGroup::budgets,
       "More: smaller texels on large levels, down to texel."}};
  return table;
}

}  // namespace

const ParameterTable<SurfaceShadowMapsParameters>& surfaceShadowMapsParameters() {
  static const ParameterTable<SurfaceShadowMapsParameters> table{
      pathParameters(), frameBudgetParameters(), surfaceParameters(), storedDepthParameters()};
  return table;
}

}  // namespace lamplighter
