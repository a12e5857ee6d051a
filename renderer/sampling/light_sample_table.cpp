#include "renderer/sampling/light_sample_table.h"

#include "renderer/scene/vpl.h"

namespace lamplighter {

std::vector<shared::Vpl> LightSampleTable::summedInOrder() const {
  std::vector<shared::Vpl> vpls;
  vpls.reserve(samples.size());
  for (const LightSample& sample : samples)
    if (const shared::Vpl& vpl = summed[static_cast<size_t>(sample.vpl.slot)];
        isLight(vpl) && brightness(vpl) > 0.0f)
      vpls.push_back(vpl);
  return vpls;
}

std::vector<SceneVpl> liveSamples(std::span<const LightSample> samples) {
  std::vector<SceneVpl> live;
  for (const LightSample& sample : samples)
    if (sample.isLive) live.push_back(sample);
  return live;
}

}  // namespace lamplighter
