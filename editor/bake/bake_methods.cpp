#include "editor/bake/bake_methods.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/methods/many_lights/parameters.h"
#include "renderer/methods/path_tracer/parameters.h"
#include "renderer/methods/path_tracer/reference_method.h"

namespace lamplighter {
namespace {

// Places along a side of a flat light by which its shadows are found.
constexpr int kMask = 32;
// Of texels from which light is gathered: their side [m], and the largest form factor of groups
// [%].
constexpr float kGatheredTexel = 0.1f, kGatherError = 2.0f;

BakeLightOptions referenceOptions(Settings settings) {
  const PathTracerParameters parameters = pathTracerParameters().read(settings);
  BakeLightOptions light;
  light.method = BakeMethod::reference;
  light.paths.bounces = parameters.bounces;
  light.paths.seed = static_cast<uint32_t>(parameters.seed);
  light.paths.glossyBounces = parameters.glossyBounces;
  light.paths.leastRoughness = parameters.leastRoughness;
  light.samples = parameters.samplesPerPixel;
  return light;
}

// Options of all methods except the reference. Their parameters have the names of those of
// many_lights; missing ones get its defaults.
BakeLightOptions sampledOptions(const ManyLightsParameters& parameters) {
  BakeLightOptions light;
  light.paths.bounces = parameters.bounces;  // of probes
  light.paths.seed = static_cast<uint32_t>(parameters.seed);
  light.counts.total = parameters.vpls;
  light.counts.directShare = parameters.directShare;
  light.counts.bounces = parameters.bounces;
  light.counts.seed = static_cast<uint32_t>(parameters.seed);
  light.clampDistance = parameters.clampDistance;
  return light;
}

BakeLightOptions manyLightsOptions(Settings settings) {
  return sampledOptions(manyLightsParameters().read(settings));
}

BakeLightOptions meshOptions(Settings settings) {
  // Exact soft shadows, and fewer rays.
  if (!settings.has("mask")) settings.set("mask", std::to_string(kMask));
  const ManyLightsParameters parameters = manyLightsParameters().read(settings);
  BakeLightOptions light = sampledOptions(parameters);
  light.method = BakeMethod::meshes;
  light.surface = parameters.surfaceLight(parameters.bounces, parameters.seed);
  return light;
}

BakeLightOptions gatherOptions(Settings settings) {
  // Places near edges see single texels. Groups are seen by several of their texels.
  if (!settings.has("texel")) settings.set("texel", kGatheredTexel);
  if (!settings.has("link_error")) settings.set("link_error", kGatherError);
  const ManyLightsParameters parameters = manyLightsParameters().read(settings);
  BakeLightOptions light = sampledOptions(parameters);
  light.method = BakeMethod::links;
  light.surface.mask = kMask;
  light.texels = parameters.radiosity(parameters.bounces, parameters.seed);
  return light;
}

}  // namespace

const std::vector<BakeMethodInfo>& bakeMethods() {
  static const std::vector<BakeMethodInfo> all{
      {"many_lights", "its settled light samples, with exact shadows", manyLightsOptions},
      {"multi_mesh", "smooth bounced light from surface elements", meshOptions},
      {"surface_shadow_maps", "bounced light gathered at each texel", gatherOptions},
      {kReferenceMethod, "path tracing", referenceOptions}};
  return all;
}

BakeLightOptions bakeLightOptions(const std::string& method, const Settings& settings) {
  const auto it = std::ranges::find(bakeMethods(), method, &BakeMethodInfo::name);
  if (it == bakeMethods().end())
    throw std::logic_error("there is no method of baking named " + method);
  return it->options(settings);
}

}  // namespace lamplighter
