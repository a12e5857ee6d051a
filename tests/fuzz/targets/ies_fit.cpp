// Processing of IES profiles gives an InputError, or lobes of finite strength and a solid angle of
// at most the whole sphere.
#include <cmath>

#include "renderer/base/error.h"
#include "renderer/scene/ies/ies_profile.h"
#include "tests/fuzz/targets/scratch.h"

using namespace lamplighter;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const auto profile = parseIes(fuzz::textOf(data, size), "fuzz.ies");
    if (!(profile->solidAngle >= 0.0f && profile->solidAngle <= 4.001f * kPi))
      fuzz::broken("a solid angle within the sphere");
    if (!(profile->cap > 0.0f && profile->cap <= 2.0f)) fuzz::broken("a cap within the sphere");
    if (profile->lobes.empty() || profile->lobes.size() > kMostLobes)
      fuzz::broken("one lobe to sixteen");
    for (const SpotLobe& l : profile->lobes)
      if (!(l.intensity > 0.0f && std::isfinite(l.intensity)))
        fuzz::broken("lobes of finite strength");
  } catch (const InputError&) {
  }
  return 0;
}
