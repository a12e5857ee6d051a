#include "renderer/methods/many_lights/parameters.h"

namespace lamplighter {
namespace {

using enum ParameterGroup;
using P = ManyLightsParameters;

// A limit for one kind of work per frame.
ParameterTable<P> limit(int P::*member, const char* name, const char* label, const char* work,
                        const char* benefit) {
  return {member,
          name,
          label,
          "",
          std::string("Maximum number of ") + work +
              " per frame; at least one light sample is refreshed. Lower: shorter frames, but an "
              "edit takes longer to arrive. 0: no limit.",
          {0, 1e9, kLogarithmic},
          budgets,
          benefit};
}

}  // namespace

const ParameterTable<P>& manyLightsParameters() {
  static const ParameterTable<P> table{
      {&P::vpls,
       "vpls",
       "Light samples",
       "",
       "Number of virtual point lights (VPLs), direct and indirect together. Cost grows with it, a "
       "little less than linearly.",
       {1, 65536, kLogarithmic},
       lightSamples},
      {&P::directShare,
       "direct_share",
       "Direct share",
       "",
       "Share of the light samples that are placed on the lights; the others carry bounced light. "
       "More: less noise in direct light, more in bounced light, at about the same cost.",
       {0.0, 1.0},
       lightSamples},
      pathParameters(),
      {&P::indirect,
       "indirect",
       "Bounced light",
       "",
       "How bounced light is computed. samples: light samples carry it. meshes: it is stored on "
       "surfaces, with the light of the sky; smooth and up to date in every frame; all light "
       "samples are placed on lamps and suns. links: texels of the surfaces exchange it along "
       "links that are computed once, so that moving lights trace no rays between texels. "
       "imperfect: 1,024 light samples for it are chosen for each view, with shadow maps drawn "
       "from points (method imperfect_shadow_maps); nothing is precomputed, at any size of the "
       "level. field: texels exchange light, also of the sky, with what they see in a fixed set of "
       "directions (method light_field). automatic: on the cpu backend links in rooms without sky "
       "and glossy materials whose surfaces are larger than texels, imperfect in levels of very "
       "many triangles without a sky or with more than 32 lamps and 10,000 triangles, otherwise "
       "meshes; samples on gl "
       "and with prt.",
       {{"automatic", ManyLightsIndirect::automatic},
        {"samples", ManyLightsIndirect::samples},
        {"meshes", ManyLightsIndirect::meshes},
        {"links", ManyLightsIndirect::links},
        {"imperfect", ManyLightsIndirect::imperfect},
        {"field", ManyLightsIndirect::field}},
       lightSamples},
      surfaceLightParameters(),
      storedDepthParameters(),
      lightFieldParameters(),
      {&P::importance,
       "importance",
       "Candidates",
       "",
       "Candidates that are traced for each sample of bounced light and sky light. Those that "
       "contribute most to the view are kept: first three for each sample, by their contribution "
       "without shadows, then one of these, by rays to the view. Larger values cost more rays "
       "after each edit; above 8 no gain was measured. At most 65536 candidates in total, or eight "
       "for each sample if that is more. 1: all are kept.",
       {1, 256},
       lightSamples},
      {&P::mapResolution,
       "map_resolution",
       "Shadow map size",
       "texels",
       "Resolution (width and height) of the shadow map of each light sample while the scene "
       "changes. Larger: sharper shadows; twice the resolution costs four times the memory and "
       "rays.",
       {8, 1024, kLogarithmic},
       quality},
      {&P::settledMapScale,
       "settled_map_scale",
       "Finer maps at rest",
       "",
       "Factor for the resolution of shadow maps once all other work is done, as far as map_memory "
       "allows. Shadows at rest are sharper and leak less light; rendering time and memory of a "
       "map grow with the square of the factor. An edit returns the maps that it affects to the "
       "small size. Not used while repair is on. 1: off.",
       {1, 16},
       quality},
      {&P::sunMaps,
       "sun_maps",
       "Maps of a sun",
       "",
       "Maximum number of shadow maps per sun, in addition to the light samples. Maps cover small "
       "areas where the camera sees surfaces that the sun may light. More: sharper sun shadows, "
       "more maps to render.",
       {1, 4096, kLogarithmic},
       quality},
      {&P::groupShare,
       "group_share",
       "Group share",
       "%",
       "Light samples that are distant and close to each other may share one shadow look-up if "
       "together they have at most this share of all light. Larger: less cost of many light "
       "samples, coarser shadows. On the cpu backend their highlights may be merged into one. 0: "
       "off. No effect with naive or below 800 light samples.",
       {0.0, 5.0},
       quality},
      frameBudgetParameters().only(kUpdates),
      limit(&P::maxShadowMaps, "max_shadow_maps", "Maps per frame", "shadow maps rendered",
            "More: shadows follow an edit in fewer frames."),
      limit(&P::maxVisibilityTests, "max_visibility_tests", "Tests per frame",
            "occlusion pyramids tested against the scene",
            "More: the visibility database is complete sooner, so that fewer pixels read shadow "
            "maps."),
      limit(&P::maxLightMapTexels, "max_light_map_texels", "Texels per frame",
            "light map texels updated, counted once per light that is added or removed,",
            "More: light without shadows follows an edit in fewer frames."),
      limit(&P::maxRays, "max_rays", "Rays per frame",
            "rays for shadow maps and transfer (cpu backend)",
            "More: shadows follow an edit in fewer frames. The size of the maps decides how many "
            "rays each takes."),
      {&P::maxPaths,
       "max_paths",
       "Paths per frame",
       "",
       "Maximum number of paths of bounced light that are traced again per frame after an edit. "
       "Lower: shorter frames, but bounced light takes longer to arrive. 0: no limit.",
       {0, 1000000, kLogarithmic},
       budgets,
       "More: bounced light follows moving objects and lights in fewer frames."},
      frameBudgetParameters().only("frame_time"),
      {&P::mapMemory,
       "map_memory",
       "Map memory",
       "MiB",
       "Memory limit for shadow maps. Maps exist only for light samples that the view needs. If "
       "they do not fit, a light sample uses the map of its nearest neighbour (naive: its light "
       "goes to the others).",
       {1, 65536, kLogarithmic},
       budgets,
       "More: every light sample that the view needs has a shadow map of its own."},
      {&P::visibilityMemory,
       "visibility_memory",
       "Visibility memory",
       "MiB",
       "Memory limit for the visibility database. If a large level with many light samples needs "
       "more, patches are divided less and more shadow maps are read; if even whole patches do not "
       "fit, all maps are read as with naive. The picture keeps its light. No effect with naive.",
       {1, 65536, kLogarithmic},
       budgets,
       "More: patches of large levels are divided further, for fewer look-ups."},
      {&P::lightMapMemory,
       "light_map_memory",
       "Light map memory",
       "MiB",
       "Memory limit for light maps. If a level needs more, all texels become larger than "
       "light_map_texel; if two texels per side of each patch are too many, light is summed per "
       "pixel. Only with light_maps.",
       {1, 65536, kLogarithmic},
       budgets,
       "More: smaller texels on large levels, down to light_map_texel."},
      {&P::prtMemory,
       "prt_memory",
       "Transfer memory",
       "MiB",
       "Memory limit for precomputed radiance transfer. If not all complex meshes fit, the largest "
       "are lit per pixel. Only with prt.",
       {1, 65536, kLogarithmic},
       budgets,
       "More: larger complex meshes are lit by transfer."},
      {&P::shareMemory,
       "share_memory",
       "Memory of light shares",
       "MiB",
       "Memory limit for the contributions of single lights to a settled picture, 12 bytes per "
       "pixel and light, so that a change of brightness is shown in the next frame. If it is too "
       "small, only the brightest lights have a contribution of their own. 0: none.",
       {0, 65536, kLogarithmic},
       budgets,
       "More: more lights, or larger pictures, whose brightness changes at once."},
      {&P::clampDistance,
       "clamp_distance",
       "Clamp distance",
       "m",
       "Minimum distance in the 1/d² term of a light sample. Larger values hide bright spots near "
       "light samples but remove light from corners (see bias_compensation). No cost in time.",
       {0.0, 10.0},
       quality},
      {&P::shadowBias,
       "shadow_bias",
       "Shadow bias",
       "",
       "An occluder casts a shadow only if it is nearer than the receiver by this share of the "
       "distance. Larger: less shadow acne, more light leaks. No cost in time.",
       {0.0, 0.1},
       quality},
      {&P::technique,
       "technique",
       "Technique",
       "",
       "naive: every light sample with its shadow map at every pixel. visibility: reads shadow "
       "maps only where the geometry cannot decide whether the light is blocked. light_maps: also "
       "sums unshadowed light once for flat surfaces; pixels only subtract shadows. All show the "
       "same light; light_maps is fastest for edits.",
       {{"naive", ManyLightsTechnique::naive},
        {"visibility", ManyLightsTechnique::visibility},
        {"light_maps", ManyLightsTechnique::lightMaps}},
       technique},
      {&P::lightMapTexel,
       "light_map_texel",
       "Light map texel",
       "m",
       "Size of light map texels. Patches that need more than 33 texels per side get 33. Smaller: "
       "more memory and more work per edit.",
       {0.01, 2.0, kLogarithmic},
       quality},
      {&P::lightsPerPass,
       "lights_per_pass",
       "Lights per pass",
       "",
       "Maximum number of light samples per draw call on the gl backend. Lower values mean more "
       "and shorter draw calls, for drivers that limit their duration; the picture is the same.",
       {1, 1024, kLogarithmic},
       technique},
      {&P::mergePasses, "merge_passes", "Merge passes",
       "The gl backend draws lights with shadow maps in passes of at most lights_per_pass lights, "
       "merged over objects as in the paper, and counts them. Same picture, slower than the light "
       "lists per patch. No effect on the cpu backend or with naive.",
       technique},
      {&P::block,
       "block",
       "Block",
       "pixels",
       "Light is summed at one pixel of each block of this size and interpolated between; pixels "
       "at edges of surfaces and shadows are summed in full. 1: every pixel. Larger: faster, "
       "softer detail. No effect with naive.",
       {{"1", 1}, {"2", 2}, {"4", 4}, {"8", 8}},
       quality},
      {&P::prt, "prt", "Transfer",
       "Lights complex meshes at their vertices by precomputed radiance transfer: smooth, with "
       "soft self-shadows and, with prt_bounces, reflections between parts of a mesh, without "
       "shadow maps. Computed once per shape. No effect with naive.",
       technique},
      {&P::prtPoints,
       "prt_points",
       "Light points",
       "",
       "Maximum number of points on a complex mesh where incident light is sampled for transfer; "
       "larger meshes get more. 1, as in the paper: no shadow edge falls onto the mesh. More "
       "points cost visibility tests per edit.",
       {1, 255, kLogarithmic},
       quality},
      {&P::prtBounces,
       "prt_bounces",
       "Transfer bounces",
       "",
       "Bounces between the parts of a mesh inside its transfer, up to the parameter bounces. "
       "Smoother than the few light samples on the mesh; each bounce costs time when the transfer "
       "of a shape is computed. 0: light samples carry them, as elsewhere and as with naive.",
       {0, 4},
       quality},
      {&P::prtError,
       "prt_error",
       "Transfer error",
       "",
       "Maximum relative error of direct light by transfer. Lights that exceed it are summed per "
       "pixel with shadow maps, the worst first. Smaller: more exact, more work per pixel. 1: no "
       "limit.",
       {0.0, 1.0},
       quality},
      surfaceParameters(),
      {&P::antialias,
       "antialias",
       "Samples per pixel",
       "",
       "Number of pictures with shifted pixels that are averaged once the light is settled. Each "
       "costs a frame at rest, in which all pixels are shaded again. More: smoother edges, later "
       "settled. 1: off.",
       {1, 256, kLogarithmic},
       picture},
      {&P::biasCompensation, "bias_compensation", "Bias compensation",
       "Adds the light that clamp_distance removed, mostly in corners, once the picture is "
       "settled: "
       "one short ray per pixel, then smoothed. Near lamps of few triangles and even radiance, it "
       "replaces the sum of light samples by the form factor in closed form.",
       picture},
      {&P::refine,
       "refine",
       "Refine to",
       "",
       "Without repair: total number of light samples with which a picture at rest is refined in "
       "the editor's window, in batches, including the light that clamp_distance removed. More: "
       "less noise, longer work at rest. 0: off. Recordings and replays do not refine; render does "
       "only if this is set.",
       {0, 1 << 24, kLogarithmic},
       picture}};
  return table;
}

const ParameterTable<ManyLightsParameters>& directSampleParameters() {
  static const ParameterTable<ManyLightsParameters> table{
      manyLightsParameters().only("vpls"), manyLightsParameters().only("antialias"),
      manyLightsParameters().only("share_memory"), manyLightsParameters().only("refine")};
  return table;
}

}  // namespace lamplighter
