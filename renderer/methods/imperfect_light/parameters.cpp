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
  out.biasCompensation = false;
  out.settle = ImperfectRest::imperfect;
  out.raysChoose = false;
  return out;
}

const ParameterTable<ImperfectParameters>& imperfectParameters() {
  using enum ParameterGroup;
  using P = ImperfectParameters;
  static const ParameterTable<P> table{
      {&P::asPublished, "as_published", "As published",
       "Uses the values of the paper instead of the parameters below, except for the number of "
       "samples and the size of maps: guided view samples for each frame, billboards, pull-push, "
       "no defensive share, and imperfect maps at rest. More errors of visibility, and a new "
       "choice of samples whenever the camera moves.",
       quality},
      {&P::bouncedSamples,
       "bounced_samples",
       "Bounced samples",
       "",
       "Number of light samples that carry bounced light, chosen for the view. Each costs an "
       "imperfect shadow map in every frame in which something changes.",
       {64, 65536, kLogarithmic},
       lightSamples},
      {&P::potentialLights,
       "potential_lights",
       "Potential samples",
       "",
       "Number of vertices of light paths, over all bounces, among which the samples are chosen. "
       "More: better choice, more rays after an edit.",
       {64, 1048576, kLogarithmic},
       lightSamples},
      pathParameters(),
      {&P::viewChoice,
       "view_choice",
       "View samples by",
       "",
       "Visible points that estimate the contribution of a potential sample to the view. fixed: "
       "the same points for all samples, found by rays. random: pixels of a jittered grid, "
       "different for each sample. guided: pixels near the image of the potential sample. random "
       "and guided are estimated again whenever the view changes, which costs time while the "
       "camera moves.",
       {{"fixed", ViewChoice::fixed},
        {"random", ViewChoice::random},
        {"guided", ViewChoice::guided}},
       lightSamples},
      {&P::viewSamples,
       "view_samples",
       "View samples",
       "",
       "Number of visible points that estimate the contribution of each potential sample. More: "
       "better choice; the time of a choice grows in proportion.",
       {1, 1024, kLogarithmic},
       lightSamples},
      {&P::defence,
       "defence",
       "Defensive share",
       "%",
       "Share of the samples that is chosen by flux only. The others are chosen by an estimate "
       "without occlusion and could be too bright without this share. More: fewer samples where "
       "the view needs them.",
       {0.0, 100.0},
       lightSamples},
      {&P::betweenTexels, "between_texels", "Between texels",
       "Places samples between potential samples that are close in the picture, so that they slide "
       "over surfaces as the camera moves. Less exact; off: samples lie exactly at potential "
       "samples.",
       lightSamples},
      {&P::adapt,
       "adapt",
       "Adapt to the view",
       "",
       "Whether samples and occluder points are chosen for the view. off: samples by flux, points "
       "evenly on all surfaces. steady: for a view near the camera, which stays the same during "
       "small camera motion. each_frame: for every view, as published; samples are chosen again in "
       "each frame in which the camera moves.",
       {{"off", ViewAdaption::off},
        {"steady", ViewAdaption::steady},
        {"each_frame", ViewAdaption::eachFrame}},
       lightSamples},
      {&P::occluderPoints,
       "occluder_points",
       "Occluder points",
       "points",
       "Points on the surfaces that are drawn into each imperfect shadow map; rounded down to a "
       "power of two. More: fewer errors of visibility; the time of each map grows in proportion.",
       {64, 65536, kLogarithmic},
       quality},
      {&P::twoSided, "two_sided", "Points for both ends",
       "Occluder points are dense where surfaces cover a large solid angle as seen from visible "
       "points and from light samples. Points are placed again whenever the light samples "
       "change. Off: only as seen from visible points, as published.",
       quality},
      {&P::resolution,
       "imperfect_resolution",
       "Imperfect map size",
       "texels",
       "Side of an imperfect shadow map; rounded down to a power of two. More: finer shadows, "
       "but more holes between points, which leak light, and more time per map.",
       {16, 256, kLogarithmic},
       quality},
      {&P::splats,
       "splats",
       "Points drawn as",
       "",
       "Shape in which occluder points are drawn. tilted: discs on the surface. billboard: discs "
       "that face the light, as published; causes more false shadows.",
       {{"billboard", SplatShape::billboard}, {"tilted", SplatShape::tilted}},
       quality},
      {&P::fill,
       "fill",
       "Holes filled",
       "",
       "How texels that no point covers are filled. planes: between points on one plane. "
       "pull_push: by means of their neighbourhood, as published, which adds false shadows. none: "
       "they stay empty, which takes no time but leaks light.",
       {{"none", HoleFilling::none},
        {"pull_push", HoleFilling::pullPush},
        {"planes", HoleFilling::planes}},
       quality},
      {&P::interleave,
       "interleave",
       "Interleaving",
       "pixels",
       "Side of the squares of pixels that share the samples while something changes: each pixel "
       "sums one part of them, and a blur distributes the light. Larger: shorter frames, more "
       "noise at small objects. At rest each pixel sums all samples. 1: always all.",
       {1, 16},
       quality},
      {&P::clampDistance,
       "clamp_distance",
       "Clamp distance",
       "m",
       "Minimum distance in the 1/d² term of a sample. Smaller: brighter corners, more bright "
       "spots. No cost in time.",
       {0.0, 10.0},
       quality},
      {&P::biasCompensation, "bias_compensation", "Bias compensation",
       "At rest, adds the bounced light that clamp_distance removes near surfaces. Costs rays at "
       "each pixel.",
       quality},
      {&P::settle,
       "settle",
       "At rest",
       "",
       "Shadow maps of the settled picture. maps: traced against all triangles, which takes more "
       "time at rest. imperfect: drawn from points, with false shadows and light leaks.",
       {{"imperfect", ImperfectRest::imperfect}, {"maps", ImperfectRest::maps}},
       quality},
      {&P::settledResolution,
       "settled_resolution",
       "Map size at rest",
       "texels",
       "Side of traced shadow maps. More: sharper shadows at rest; twice the side costs four times "
       "the rays.",
       {16, 1024, kLogarithmic},
       quality},
      {&P::raysChoose, "rays_choose", "Rays choose at rest",
       "At rest, rays measure how much of the light of potential samples reaches the view, and the "
       "samples are chosen again from that. Useful where walls block many samples. Costs rays from "
       "each potential sample to view samples.",
       lightSamples},
      frameBudgetParameters(),
      surfaceParameters()};
  return table;
}

}  // namespace lamplighter
