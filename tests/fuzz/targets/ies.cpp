// IES profiles: an InputError, or intensities in [0, 1] in every direction.
#include <cmath>

#include "renderer/error.h"
#include "renderer/scene/ies_profile.h"
#include "tests/fuzz/targets/scratch.h"

using namespace lamplighter;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const auto profile = parseIes(fuzz::textOf(data, size), "fuzz.ies");
    for (int i = 0; i < 26; ++i) {
      const vec3 d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (d == vec3(0.0f)) continue;
      const float v = profile->at(glm::normalize(d));
      if (!(v >= 0.0f && v <= 1.0001f)) fuzz::broken("an intensity in [0, 1]");
    }
    if (!std::isfinite(profile->peak) || !std::isfinite(profile->solidAngle))
      fuzz::broken("a finite peak");
  } catch (const InputError&) {
  }
  return 0;
}
