#include "renderer/methods/many_lights/parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& technique() {
  static const ParameterSpec spec{
      "technique",
      "Technique",
      "",
      "naive: every light sample with its shadow map at every pixel. visibility: reads shadow maps "
      "only where the geometry cannot decide whether the light is blocked. light_maps: also sums "
      "unshadowed light once for flat surfaces; pixels only subtract shadows. All show the same "
      "light; light_maps is fastest for edits.",
      std::string("light_maps"),
      0,
      0,
      false,
      {"naive", "visibility", "light_maps"},
      ParameterGroup::technique};
  return spec;
}

namespace {

ParameterSpec limitOf(const char* name, const char* label, const char* what) {
  return {name,
          label,
          "",
          std::string("Maximum number of ") + what +
              " per frame; at least one light sample is refreshed. Lower: shorter frames, but an "
              "edit takes longer to arrive. 0: no limit.",
          0,
          0,
          1000000000,
          true,
          {},
          ParameterGroup::budgets};
}

}  // namespace

const ParameterSpec& importance() {
  static const ParameterSpec spec{
      "importance",
      "Candidates",
      "",
      "Candidates that are traced for each sample of bounced light and sky light. The samples that "
      "contribute most to what the camera sees are kept. 1: all candidates are kept. Costs rays "
      "after each edit.",
      8,
      1,
      64,
      false,
      {},
      ParameterGroup::lightSamples};
  return spec;
}

const ParameterSpec& sunMaps() {
  static const ParameterSpec spec{
      "sun_maps",
      "Maps of a sun",
      "",
      "Maximum number of shadow maps per sun, in addition to the light samples. Maps are small "
      "where the camera sees what the sun may light. More maps: sharper sun shadows, more maps to "
      "render.",
      128,
      1,
      4096,
      true,
      {},
      ParameterGroup::quality};
  return spec;
}

const ParameterSpec& settledMapScale() {
  static const ParameterSpec spec{
      "settled_map_scale",
      "Finer maps at rest",
      "",
      "Factor for the resolution of shadow maps once all other work is done, as far as map_memory "
      "allows. Shadows at rest are sharper and leak less. An edit returns the maps that it affects "
      "to the small size. 1: off.",
      6,
      1,
      16,
      false,
      {},
      ParameterGroup::quality};
  return spec;
}

const ParameterSpec& maxShadowMaps() {
  static const ParameterSpec spec =
      limitOf("max_shadow_maps", "Maps a frame", "shadow maps rendered");
  return spec;
}

const ParameterSpec& maxVisibilityTests() {
  static const ParameterSpec spec = limitOf("max_visibility_tests", "Tests a frame",
                                            "occlusion pyramids tested against the scene");
  return spec;
}

const ParameterSpec& maxLightMapTexels() {
  static const ParameterSpec spec =
      limitOf("max_light_map_texels", "Texels a frame",
              "light map texels updated, counted once per light that is added or removed,");
  return spec;
}

const ParameterSpec& maxRays() {
  static const ParameterSpec spec =
      limitOf("max_rays", "Rays a frame", "rays for shadow maps and transfer (cpu backend)");
  return spec;
}

const ParameterSpec& maxPaths() {
  static const ParameterSpec spec{
      "max_paths",
      "Paths a frame",
      "",
      "Maximum number of paths of bounced light that are traced again per frame after an edit. "
      "0: no limit.",
      0,
      0,
      1000000,
      true,
      {},
      ParameterGroup::budgets};
  return spec;
}

const ParameterSpec& groupShare() {
  static const ParameterSpec spec{
      "group_share",
      "Group share",
      "%",
      "Several distant light samples close to each other may share one shadow look-up if together "
      "they have at most this share of all light. Reduces the cost of many light samples. On the "
      "cpu backend their highlights may be shown as one. 0: off. No effect with naive or below 800 "
      "light samples.",
      0.2f,
      0.0,
      5.0,
      false,
      {},
      ParameterGroup::quality};
  return spec;
}

const ParameterSpec& mapMemory() {
  static const ParameterSpec spec{
      "map_memory",
      "Map memory",
      "MiB",
      "Memory limit for shadow maps. Maps exist only for light samples that the view needs. If "
      "they do not fit, a light sample uses the map of its nearest neighbour (naive: its light "
      "goes to the others).",
      512,
      1,
      65536,
      true,
      {},
      ParameterGroup::budgets};
  return spec;
}

const ParameterSpec& visibilityMemory() {
  static const ParameterSpec spec{
      "visibility_memory",
      "Visibility memory",
      "MiB",
      "Memory limit for the visibility database. If a large level with many light samples needs "
      "more, patches are divided less and more shadow maps are read; if even whole patches do not "
      "fit, all maps are read as with naive. The picture keeps its light. No effect with naive.",
      1024,
      1,
      65536,
      true,
      {},
      ParameterGroup::budgets};
  return spec;
}

const ParameterSpec& lightMapMemory() {
  static const ParameterSpec spec{
      "light_map_memory",
      "Light map memory",
      "MiB",
      "Memory limit for light maps. If a level needs more, all texels become larger than "
      "light_map_texel; if two texels per side of each patch are too many, light is summed per "
      "pixel. Only with light_maps.",
      1024,
      1,
      65536,
      true,
      {},
      ParameterGroup::budgets};
  return spec;
}

const ParameterSpec& prtMemory() {
  static const ParameterSpec spec{
      "prt_memory",
      "Transfer memory",
      "MiB",
      "Memory limit for precomputed radiance transfer. If not all complex meshes fit, the largest "
      "are lit per pixel. Only with prt.",
      1024,
      1,
      65536,
      true,
      {},
      ParameterGroup::budgets};
  return spec;
}

const ParameterSpec& frameTime() {
  static const ParameterSpec spec{
      "frame_time",
      "Frame time",
      "ms",
      "Target duration of a frame in the editor's window. Limits the refreshed light samples by "
      "their measured cost. 0: only the counts limit a frame. Recordings, replays and rendering "
      "without a window always use counts.",
      50.0f,
      0.0,
      1000.0,
      false,
      {},
      ParameterGroup::budgets};
  return spec;
}

const ParameterSpec& lightMapTexel() {
  static const ParameterSpec spec{
      "light_map_texel",
      "Light map texel",
      "m",
      "Size of light map texels. Patches that need more than 33 texels per side get 33. Smaller: "
      "more memory and more work per edit.",
      0.1f,
      0.01,
      2.0,
      true,
      {},
      ParameterGroup::quality};
  return spec;
}

const ParameterSpec& lightsPerPass() {
  static const ParameterSpec spec{
      "lights_per_pass",
      "Lights a pass",
      "",
      "Maximum number of light samples per draw call on the gl backend. Lower values mean more and "
      "shorter draw calls, for drivers that limit their duration; the picture is the same.",
      1024,
      1,
      1024,
      true,
      {},
      ParameterGroup::technique};
  return spec;
}

const ParameterSpec& mergePasses() {
  static const ParameterSpec spec{
      "merge_passes",
      "Merge passes",
      "",
      "The gl backend draws lights with shadow maps in passes of at most lights_per_pass lights, "
      "merged over objects as in the paper, and counts them. Same picture, slower than the light "
      "lists per patch. No effect on the cpu backend or with naive.",
      false,
      0,
      0,
      false,
      {},
      ParameterGroup::technique};
  return spec;
}

const ParameterSpec& block() {
  static const ParameterSpec spec{
      "block",
      "Block",
      "pixels",
      "Light is summed at one pixel of each block of this size and interpolated between; pixels at "
      "edges of surfaces and shadows are summed in full. 1: every pixel. Larger: faster, softer "
      "detail. No effect with naive.",
      std::string("4"),
      0,
      0,
      false,
      {"1", "2", "4", "8"},
      ParameterGroup::quality};
  return spec;
}

const ParameterSpec& prt() {
  static const ParameterSpec spec{
      "prt",
      "Transfer",
      "",
      "Lights complex meshes at their vertices by precomputed radiance transfer: smooth, with soft "
      "self-shadows and, with prt_bounces, reflections between parts of a mesh, without shadow "
      "maps. Computed once per shape. No effect with naive.",
      false,
      0,
      0,
      false,
      {},
      ParameterGroup::technique};
  return spec;
}

const ParameterSpec& prtPoints() {
  static const ParameterSpec spec{
      "prt_points",
      "Light points",
      "",
      "Maximum number of points on a complex mesh where incident light is sampled for transfer; "
      "larger meshes get more. 1, as in the paper: no shadow edge falls onto the mesh. More points "
      "cost visibility tests per edit.",
      128,
      1,
      255,
      true,
      {},
      ParameterGroup::quality};
  return spec;
}

const ParameterSpec& prtBounces() {
  static const ParameterSpec spec{
      "prt_bounces",
      "Transfer bounces",
      "",
      "Bounces between the parts of a mesh inside its transfer, up to the parameter bounces. "
      "Smoother than the few light samples on the mesh. 0: light samples carry them, as elsewhere "
      "and as with naive.",
      0,
      0,
      4,
      false,
      {},
      ParameterGroup::quality};
  return spec;
}

const ParameterSpec& prtError() {
  static const ParameterSpec spec{
      "prt_error",
      "Transfer error",
      "",
      "Maximum relative error of direct light by transfer. Lights that exceed it are summed per "
      "pixel with shadow maps, the worst first. 1: no limit.",
      0.15f,
      0.0f,
      1.0f,
      false,
      {},
      ParameterGroup::quality};
  return spec;
}

const ParameterSpec& antialias() {
  static const ParameterSpec spec{
      "antialias",
      "Samples a pixel",
      "",
      "Number of pictures with shifted pixels that are averaged once the light is settled, one per "
      "frame.",
      4,
      1,
      256,
      true,
      {},
      ParameterGroup::picture};
  return spec;
}

const ParameterSpec& cornerLight() {
  static const ParameterSpec spec{
      "corner_light",
      "Corner light",
      "",
      "Adds the light that clamp_distance removed, mostly in corners, once the picture is settled: "
      "one short ray per pixel, then smoothed.",
      true,
      0,
      0,
      false,
      {},
      ParameterGroup::picture};
  return spec;
}

const ParameterSpec& refine() {
  static const ParameterSpec spec{
      "refine",
      "Refine to",
      "",
      "Total number of light samples that a picture at rest is refined with in the editor's "
      "window, in batches, including the light that clamp_distance removed. 0: off. Recordings and "
      "replays do not refine; render does only if this is set.",
      65536,
      0,
      1 << 24,
      true,
      {},
      ParameterGroup::picture};
  return spec;
}

}  // namespace lamplighter::parameters
