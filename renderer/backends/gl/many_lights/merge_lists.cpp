// Passes of light lists, merged over objects (paper 1, 4.3.5).
#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/backends/gl/many_lights/light_lists.h"
#include "renderer/base/error.h"
#include "renderer/light_maps/pass_merging.h"
#include "shaders/shared/patches.h"

namespace lamplighter::gl {

std::span<uint32_t> LightLists::shadowedOf(size_t group, size_t place) {
  const glm::uvec2 range = ranges_[group * stride_ + place];
  return std::span(entries_).subspan(size_t{range.x} + (range.y & 65535u), range.y >> 16);
}

void LightLists::mergePasses(int lightsPerPass) {
  for (size_t g = 0; g < groups_.size(); ++g) mergeGroup(g, lightsPerPass);
}

void LightLists::mergeGroup(size_t group, int lightsPerPass) {
  const auto lightOf = [](uint32_t entry) {
    return entry % static_cast<uint32_t>(shared::kTakeShadow);
  };
  const size_t lights = groups_[group].count;
  // Elements refer to objects by their indices in objects_.
  std::vector<PassElement> elements(objects_.size());
  tbb::parallel_for(size_t{0}, objects_.size(), [&](size_t o) {
    std::vector<bool> needed(lights, false);
    for (const size_t place : objects_[o].places)
      for (const uint32_t entry : shadowedOf(group, place)) needed[lightOf(entry)] = true;
    elements[o].objects = {static_cast<uint32_t>(o)};
    for (uint32_t light = 0; light < lights; ++light)
      if (needed[light]) elements[o].lights.push_back(light);
  });
  const MergedPasses merged = lamplighter::mergePasses(elements, lightsPerPass);
  passes_[group] = merged.passes;
  passesSaved_ += merged.saved;
  if (merged.passes > shared::kMostPasses) {
    throw InputError("many_lights", std::to_string(merged.passes) + " passes are too many",
                     "raise lights_per_pass or switch merge_passes off");
  }

  std::vector<uint32_t> passOf(objects_.size() * lights, 0);
  size_t first = 0;
  for (const PassElement& element : merged.elements) {
    for (size_t i = 0; i < element.lights.size(); ++i) {
      const size_t pass = first + i / static_cast<size_t>(lightsPerPass);
      for (const uint32_t o : element.objects)
        passOf[o * lights + element.lights[i]] = static_cast<uint32_t>(pass);
    }
    first += static_cast<size_t>(passesOf(element, lightsPerPass));
  }
  tbb::parallel_for(size_t{0}, objects_.size(), [&](size_t o) {
    for (const size_t place : objects_[o].places) {
      const std::span<uint32_t> entries = shadowedOf(group, place);
      for (uint32_t& entry : entries)
        entry += passOf[o * lights + lightOf(entry)] * static_cast<uint32_t>(shared::kPassUnit);
      std::sort(entries.begin(), entries.end());
    }
  });
}

}  // namespace lamplighter::gl
