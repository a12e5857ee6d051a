#include "renderer/methods/common_parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& bounces() {
  static const ParameterSpec spec{"bounces", "Bounces",
                                  "",        "Number of indirect bounces. 0: direct light only.",
                                  2,         0,
                                  64,        false,
                                  {},        ParameterGroup::lightSamples};
  return spec;
}

const ParameterSpec& seed() {
  static const ParameterSpec spec{"seed",  "Seed",
                                  "",      "Selects another set of random numbers.",
                                  1,       0,
                                  1000000, false,
                                  {},      ParameterGroup::lightSamples};
  return spec;
}

const ParameterSpec& vpls() {
  static const ParameterSpec spec{"vpls",
                                  "Light samples",
                                  "",
                                  "Number of virtual point lights (VPLs), direct and indirect "
                                  "together. Cost grows with it, a little less than linearly.",
                                  300,
                                  1,
                                  65536,
                                  true,
                                  {},
                                  ParameterGroup::lightSamples};
  return spec;
}

const ParameterSpec& directShare() {
  static const ParameterSpec spec{
      "direct_share",
      "Direct share",
      "",
      "Share of the light samples that are placed on the lights. The rest carry bounced light.",
      0.5f,
      0.0,
      1.0,
      false,
      {},
      ParameterGroup::lightSamples};
  return spec;
}

const ParameterSpec& mapResolution() {
  static const ParameterSpec spec{"map_resolution",
                                  "Shadow map size",
                                  "texels",
                                  "Resolution (width and height) of each light sample's shadow map "
                                  "while the scene changes.",
                                  64,
                                  8,
                                  1024,
                                  true,
                                  {},
                                  ParameterGroup::quality};
  return spec;
}

const ParameterSpec& updates() {
  static const ParameterSpec spec{"updates",
                                  "Updates a frame",
                                  "",
                                  "Maximum number of light samples that change per frame. Lower: "
                                  "shorter frames, but an edit takes longer to arrive.",
                                  100,
                                  1,
                                  65536,
                                  true,
                                  {},
                                  ParameterGroup::budgets};
  return spec;
}

const ParameterSpec& clampDistance() {
  static const ParameterSpec spec{
      "clamp_distance",
      "Clamp distance",
      "m",
      "Minimum distance in the 1/d² term of a light sample. Larger values hide bright spots near "
      "light samples but remove light from corners (see corner_light).",
      0.5f,
      0.0,
      10.0,
      false,
      {},
      ParameterGroup::quality};
  return spec;
}

const ParameterSpec& shadowBias() {
  static const ParameterSpec spec{
      "shadow_bias",
      "Shadow bias",
      "",
      "An occluder casts a shadow only if it is nearer than the receiver by this share of the "
      "distance. Larger: less shadow acne, more light leaks.",
      0.002f,
      0.0,
      0.1,
      false,
      {},
      ParameterGroup::quality};
  return spec;
}

const ParameterSpec& samplesPerPixel() {
  static const ParameterSpec spec{"samples_per_pixel",
                                  "Paths a pixel",
                                  "",
                                  "Paths traced per pixel until the picture is settled.",
                                  64,
                                  1,
                                  1048576,
                                  true,
                                  {},
                                  ParameterGroup::budgets};
  return spec;
}

const ParameterSpec& samplesPerFrame() {
  static const ParameterSpec spec{"samples_per_frame",
                                  "Paths a frame",
                                  "",
                                  "Paths traced per pixel in one frame. Higher: longer frames, "
                                  "fewer of them.",
                                  1,
                                  1,
                                  4096,
                                  true,
                                  {},
                                  ParameterGroup::budgets};
  return spec;
}

const ParameterSpec& speculars() {
  static const ParameterSpec spec{
      "speculars",
      "Speculars",
      "",
      "Surfaces that the camera sees reflect light by their metallic and roughness values. Bounces "
      "remain diffuse. Off: visible surfaces are diffuse, too. Costs time per glossy pixel.",
      true,
      0,
      0,
      false,
      {},
      ParameterGroup::picture};
  return spec;
}

const ParameterSpec& leastRoughness() {
  static const ParameterSpec spec{"least_roughness",
                                  "Least roughness",
                                  "",
                                  "Minimum roughness for reflections. Smoother surfaces are shown "
                                  "with this roughness; a mirror would show light samples as dots.",
                                  0.1f,
                                  0.05,
                                  1.0,
                                  false,
                                  {},
                                  ParameterGroup::picture};
  return spec;
}

}  // namespace lamplighter::parameters
