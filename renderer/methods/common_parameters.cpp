#include "renderer/methods/common_parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& bounces() {
  static const ParameterSpec spec{"bounces", "Bounces",
                                  "",        "Indirect bounces; 0 is direct light only.",
                                  2,         0,
                                  64,        false,
                                  {},        ParameterGroup::lightSamples};
  return spec;
}

const ParameterSpec& seed() {
  static const ParameterSpec spec{"seed",  "Seed",
                                  "",      "Chooses another set of random numbers.",
                                  1,       0,
                                  1000000, false,
                                  {},      ParameterGroup::lightSamples};
  return spec;
}

const ParameterSpec& vpls() {
  static const ParameterSpec spec{"vpls", "Light samples",
                                  "",     "Virtual point lights in all, direct and indirect.",
                                  300,    1,
                                  65536,  true,
                                  {},     ParameterGroup::lightSamples};
  return spec;
}

const ParameterSpec& directShare() {
  static const ParameterSpec spec{
      "direct_share",
      "Direct share",
      "",
      "Share of the light samples that lie on the lights themselves; the rest carry bounced light.",
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
                                  "Side of each light sample's shadow map while things change.",
                                  64,
                                  8,
                                  1024,
                                  true,
                                  {},
                                  ParameterGroup::quality};
  return spec;
}

const ParameterSpec& updates() {
  static const ParameterSpec spec{"updates", "Updates a frame",
                                  "",        "Light samples that may change in one frame, at most.",
                                  100,       1,
                                  65536,     true,
                                  {},        ParameterGroup::budgets};
  return spec;
}

const ParameterSpec& clampDistance() {
  static const ParameterSpec spec{
      "clamp_distance",
      "Clamp distance",
      "m",
      "Light samples nearer than this light as if they were this far: bounds 1/d².",
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
      "An occluder must be nearer than the receiver by this share of the distance.",
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
                                  "Paths traced for each pixel until the picture is settled.",
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
                                  "Paths traced for each pixel in one frame.",
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
      "Surfaces that are seen reflect light by their metallic and roughness. Light bounces on as "
      "from matt surfaces all the same. Off: what is seen is matt too.",
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
                                  "Smoother surfaces are seen as if they were this rough: a mirror "
                                  "would show light samples and "
                                  "point lights as dots.",
                                  0.1f,
                                  0.05,
                                  1.0,
                                  false,
                                  {},
                                  ParameterGroup::picture};
  return spec;
}

}  // namespace lamplighter::parameters
