#include "renderer/sampling/light_sample_table.h"

#include "renderer/scene/vpl.h"

namespace lamplighter {

std::vector<LightSample> LightSampleTable::samplesInOrder() const {
  std::vector<LightSample> all;
  all.reserve(order.size());
  for (const int slot : order) all.push_back((*this)[slot]);
  return all;
}

std::vector<shared::Vpl> LightSampleTable::summedInOrder() const {
  std::vector<shared::Vpl> vpls;
  vpls.reserve(order.size());
  for (const int slot : order)
    if (const shared::Vpl& vpl = summed[static_cast<size_t>(slot)]; isLight(vpl))
      vpls.push_back(vpl);
  return vpls;
}

}  // namespace lamplighter
