#include "renderer/methods/imperfect_light/parameters.h"

namespace lamplighter {

// Figures 8 and 11 of the paper, and sections 4 to 6.
ImperfectParameters ImperfectParameters::chosen() const {
  ImperfectParameters out = *this;
  if (!asPublished) return out;
  out.viewChoice = ViewChoice::guided;
  out.viewSamples = 16;
  out.defence = 0.0f;
  out.betweenTexels = true;
  out.adapt = ViewAdaption::eachFrame;
  out.occluderPoints = 8192;
  out.twoSided = false;
  out.splats = SplatShape::billboard;
  out.fill = HoleFilling::pullPush;
  out.interleave = 8;
  out.cornerLight = false;
  out.settle = ImperfectRest::imperfect;
  out.raysChoose = false;
  return out;
}

const ParameterTable<ImperfectParameters>& imperfectParameters() {
  using enum ParameterGroup;
  using P = ImperfectParameters;
  static const ParameterTable<P> table{
      {&P::asPublished, "as_published", "As published",
       "The values of the paper instead of those below, but for the number of samples and the size "
       "of maps: guided view samples for each frame, billboards, pull-push, no defensive share, "
       "and "
       "imperfect maps at rest.",
       quality},
      {&P::bouncedSamples,
       "bounced_samples",
       "Bounced samples",
       "",
       "Number of light samples that carry bounced light, chosen for the view. Each has an "
       "imperfect shadow map in every frame in which something changes.",
       {64, 65536, kLogarithmic},
       lightSamples},
      {&P::potentialLights,
       "potential_lights",
       "Potential samples",
       "",
       "Vertices of light paths among which the samples are chosen, in all bounces. More: finer "
       "choice, more rays after an edit.",
       {64, 1048576, kLogarithmic},
       lightSamples},
      pathParameters(),
      {&P::viewChoice,
       "view_choice",
       "View samples by",
       "",
       "Which visible points say what a potential sample brings to the view. fixed: the same for "
       "all, by rays. random: pixels of a jittered grid, others for each. guided: pixels near the "
       "image of the potential sample.",
       {{"fixed", ViewChoice::fixed},
        {"random", ViewChoice::random},
        {"guided", ViewChoice::guided}},
       lightSamples},
      {&P::viewSamples,
       "view_samples",
       "View samples",
       "",
       "Number of visible points by which each potential sample is weighed.",
       {1, 1024, kLogarithmic},
       lightSamples},
      {&P::defence,
       "defence",
       "Defensive share",
       "%",
       "Share of the samples that is chosen by flux alone. What is weighed leaves out what stands "
       "between, so that the rest could be too bright.",
       {0.0, 100.0},
       lightSamples},
      {&P::betweenTexels, "between_texels", "Between texels",
       "Samples lie between potential samples that are close in the picture, so that they slide "
       "over surfaces as the camera moves. Off: at potential samples, which is exact.",
       lightSamples},
      {&P::adapt,
       "adapt",
       "Adapt to the view",
       "",
       "off: samples by flux, and occluder points evenly on all surfaces. steady: for a view near "
       "the camera that stays while it moves a little. each_frame: for each view, as published.",
       {{"off", ViewAdaption::off},
        {"steady", ViewAdaption::steady},
        {"each_frame", ViewAdaption::eachFrame}},
       lightSamples},
      {&P::occluderPoints,
       "occluder_points",
       "Occluder points",
       "points",
       "Points on the surfaces that are drawn into each imperfect shadow map. A power of two is "
       "used.",
       {64, 65536, kLogarithmic},
       quality},
      {&P::twoSided, "two_sided", "Points for both ends",
       "Occluder points are dense where surfaces fill the view of visible places and of light "
       "samples. Off: of visible places alone, as published.",
       quality},
      {&P::resolution,
       "imperfect_resolution",
       "Imperfect map size",
       "texels",
       "Side of an imperfect shadow map. A power of two is used.",
       {16, 256, kLogarithmic},
       quality},
      {&P::splats,
       "splats",
       "Points drawn as",
       "",
       "tilted: discs on the surface. billboard: discs that face the light, as published.",
       {{"billboard", SplatShape::billboard}, {"tilted", SplatShape::tilted}},
       quality},
      {&P::fill,
       "fill",
       "Holes filled",
       "",
       "What becomes of texels that no point covers. planes: they are filled between points of one "
       "plane. pull_push: by means of their neighbourhood, as published, which adds false shadows. "
       "none: no occluder.",
       {{"none", HoleFilling::none},
        {"pull_push", HoleFilling::pullPush},
        {"planes", HoleFilling::planes}},
       quality},
      {&P::interleave,
       "interleave",
       "Interleaving",
       "pixels",
       "Side of the squares of pixels that share the samples while something changes: each pixel "
       "takes one part of them, and a blur spreads it. At rest each pixel has all. 1: always all.",
       {1, 16},
       quality},
      {&P::clampDistance,
       "clamp_distance",
       "Clamp distance",
       "m",
       "Smallest distance in the 1/d² term of a sample. Less: brighter corners, more bright spots.",
       {0.0, 10.0},
       quality},
      {&P::cornerLight, "corner_light", "Light in corners",
       "At rest, traces the bounced light that clamp_distance removes near surfaces.", quality},
      {&P::settle,
       "settle",
       "At rest",
       "",
       "Shadow maps of the settled picture. maps: traced against all triangles. imperfect: those "
       "of points.",
       {{"imperfect", ImperfectRest::imperfect}, {"maps", ImperfectRest::maps}},
       quality},
      {&P::settledResolution,
       "settled_resolution",
       "Map size at rest",
       "texels",
       "Side of traced shadow maps. More: sharper shadows at rest, which takes longer.",
       {16, 1024, kLogarithmic},
       quality},
      {&P::raysChoose, "rays_choose", "Rays choose at rest",
       "At rest, rays find how much of the light of potential samples reaches the view, and "
       "samples "
       "are chosen anew by it. Pays where walls stand between.",
       lightSamples},
      frameBudgetParameters(),
      surfaceParameters()};
  return table;
}

}  // namespace lamplighter
