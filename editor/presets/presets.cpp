#include "editor/presets/presets.h"

#include <functional>
#include <optional>

#include "renderer/methods/many_lights/parameters.h"
#include "renderer/path_repair/repaired_method.h"

namespace lamplighter {
namespace {

// The values of one parameter in draft, work and final. The values of work are the defaults. The
// number of bounces and the frame time are not part of quality: they have controls of their own.
// Drags with draft follow sooner, because light on surfaces is found at fewer places by fewer rays.
// Final differs from work in how long a picture at rest gets better: by the methods table
// (docs/results/methods.md) more light samples and finer maps only make drags slower.
struct Row {
  const ParameterSpec& spec;
  ParameterValue draft;
  std::optional<ParameterValue> final = std::nullopt;  // none: the default
};

const std::vector<Row>& rows() {
  const auto& p = manyLightsParameters();
  static const std::vector<Row> all{
      {p["vpls"], 100},
      {p["importance"], 4},
      {p["map_resolution"], 32},
      {p["settled_map_scale"], 1},
      {p["map_memory"], 64},
      {p["light_map_texel"], 0.2f},
      {p["block"], std::string("8")},
      {p["antialias"], 1},
      {p["bias_compensation"], false},
      {p["coarse_edge"], 0.5f},
      {p["gather_rays"], 32},
      {p["link_memory"], 8},
      {p["refine"], 0, 1 << 20},
      {repairParameters()["repair"], 16, 4096},
      {sampleParameters()["samples_per_pixel"], 16, 1024},
  };
  return all;
}

Preset made(std::string name, std::string label, std::string help,
            const std::function<ParameterValue(const Row&)>& value) {
  Preset preset{std::move(name), std::move(label), std::move(help), {}};
  for (const Row& row : rows()) preset.values.set(row.spec.name, value(row));
  return preset;
}

}  // namespace

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all{
      made("draft", "Draft",
           "Few light samples, coarse light on surfaces and few paths: fastest response to edits, "
           "lowest accuracy.",
           [](const Row& row) { return row.draft; }),
      made("work", "Work",
           "The defaults: fast enough to drag lights, accurate enough to judge them.",
           [](const Row& row) { return row.spec.defaultValue; }),
      made("final", "Final",
           "Like work while anything changes; at rest 4,096 paths for each pixel repair the "
           "picture, instead of 256.",
           [](const Row& row) { return row.final.value_or(row.spec.defaultValue); }),
  };
  return all;
}

RenderSettings withPreset(const RenderSettings& settings, const Preset& preset) {
  RenderSettings result = settings;
  for (const Row& row : rows()) {
    const ParameterValue& value = preset.values.values().at(row.spec.name);
    if (value == row.spec.defaultValue)
      result.values.reset(row.spec.name);
    else
      result.values.set(row.spec.name, value);
  }
  return result;
}

bool hasPreset(const RenderSettings& settings, const Preset& preset) {
  for (const Row& row : rows()) {
    const auto& set = settings.values.values();
    const auto it = set.find(row.spec.name);
    const ParameterValue& value = it == set.end() ? row.spec.defaultValue : it->second;
    if (value != preset.values.values().at(row.spec.name)) return false;
  }
  return true;
}

}  // namespace lamplighter
