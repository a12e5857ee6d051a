#include "renderer/methods/many_lights/parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& technique() {
  static const ParameterSpec spec{
      "technique",
      "Technique",
      "",
      "naive: every light sample with its shadow map at every pixel. visibility: maps are looked "
      "up only where the geometry cannot tell whether something stands between. light_maps: "
      "besides, light without shadows is summed once for flat surfaces, and pixels only take "
      "shadows away.",
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
          std::string(what) +
              " in one frame, at most; one light sample is refreshed in any case. "
              "0: no limit.",
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
      "Samples of bounced light and of the sky that are tried for each that is wanted: those that "
      "bring most to what the camera sees are taken. 1: all are taken.",
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
      "Shadow maps among which each sun's light is divided, at most, small ones where the camera "
      "sees what it may light. They come on top of the light samples.",
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
      "Once nothing else is left to do, shadow maps are rendered again with so many times the "
      "texels a side, as far as map memory goes: shadows at rest are sharper and leak less. "
      "Whatever an edit touches has a small map again at once. 1: maps stay as they are.",
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
      limitOf("max_shadow_maps", "Maps a frame", "Shadow maps rendered");
  return spec;
}

const ParameterSpec& maxVisibilityTests() {
  static const ParameterSpec spec =
      limitOf("max_visibility_tests", "Tests a frame",
              "Occlusion pyramids of light samples tested against the scene");
  return spec;
}

const ParameterSpec& maxLightMapTexels() {
  static const ParameterSpec spec =
      limitOf("max_light_map_texels", "Texels a frame",
              "Texels of light maps, times lights added or taken away,");
  return spec;
}

const ParameterSpec& maxRays() {
  static const ParameterSpec spec =
      limitOf("max_rays", "Rays a frame",
              "Rays for shadow maps and light points of transfer (cpu backend)");
  return spec;
}

const ParameterSpec& maxPaths() {
  static const ParameterSpec spec{
      "max_paths",
      "Paths a frame",
      "",
      "Paths of bounced light that are walked again in one frame after an edit, at most. 0: no "
      "limit.",
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
      "Where shadow maps are looked up, one look-up may do for a group of light samples near each "
      "other that is far away, as long as the group has no more than this share of all light. So "
      "that more light samples cost less than their number. Highlights of the cpu backend show "
      "such a group as one light where it is small beside them. 0: a look-up for each. Nothing for "
      "naive, and with fewer than 800 light samples.",
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
      "Shadow maps take no more memory than this. They are made for light samples that the view "
      "looks up and dropped when others need the room; where even those do not fit, some look "
      "up the map of their nearest neighbour (naive: their share goes to the others).",
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
      "What is known of each light sample at each patch takes no more memory than this. Where "
      "thousands of light samples on a large level would need more, patches are divided less far, "
      "so that more shadow maps are looked up; where even whole patches do not fit, all are looked "
      "up as by naive. The light stays the same. Nothing for naive.",
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
      "Light maps take no more memory than this. Where a large level would need more, their texels "
      "are larger than light_map_texel everywhere; where even two texels a side of each patch are "
      "too many, pixels sum all light. Only for light_maps.",
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
      "Transfer and the light by it take no more memory than this. Where not all complex meshes "
      "fit, the largest are lit pixel by pixel. Only with prt.",
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
      "How long a frame may take in the editor's window: light samples are refreshed as far as "
      "what they cost before allows. 0: counts alone. Recordings, replays and rendering without a "
      "window go by counts.",
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
      "Spacing of the light maps' texels; patches that would need more than 33 a side get 33.",
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
      "The gl backend adds at most this many light samples to a pixel in one draw. Fewer make for "
      "more draws and the same picture; a driver may want draws to be short.",
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
      "The gl backend sums lights that need their shadow maps by passes, each at most \"Lights a "
      "pass\" of them on all objects that want them, merged as in the paper, and counts them. It "
      "is "
      "slower than the lists of each patch, and the same picture. Nothing on the cpu backend, nor "
      "for naive.",
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
      "Light is summed at one pixel of each block of as many pixels a side and interpolated "
      "between; "
      "at edges of surfaces and shadows it is summed at each pixel. 1: at each everywhere. Nothing "
      "for naive.",
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
      "Complex meshes are lit at their vertices by precomputed radiance transfer: smoothly, with "
      "their own soft shadows, if asked for with what their parts reflect onto each other "
      "(prt_bounces), and without shadow maps. Computed once for each shape. Nothing for naive.",
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
      "With transfer, places on a complex mesh at which light is sampled, at most; how many by "
      "its size. With 1, as in the paper, no shadow ends upon the mesh.",
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
      "With transfer, how often light goes between the parts of a mesh within its transfer, as far "
      "as there are bounces at all: smoother than by the few light samples on it. 0: these light "
      "it, as they do elsewhere and as in naive.",
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
      "With transfer, how much of the light that falls straight on a mesh it may get wrong: lights "
      "of which it gets more wrong are summed at pixels, with their shadow maps, those first of "
      "which it gets most wrong. 1: none is.",
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
      "Pictures with shifted pixels that are averaged, one a frame, once the lights are settled.",
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
      "The light that the clamp near light samples takes away, most of it in corners, is given "
      "back "
      "to a picture that is settled: found once by a short ray a pixel and smoothed.",
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
      "Light samples in all to which a picture at rest is refined in the editor's window, batch by "
      "batch, with the light that the clamp takes away given back. 0: not at all. Recordings and "
      "replays do without; render does only where it is set.",
      65536,
      0,
      1 << 24,
      true,
      {},
      ParameterGroup::picture};
  return spec;
}

}  // namespace lamplighter::parameters
