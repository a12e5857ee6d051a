// Reading of IES profiles gives an InputError, or intensities in [0, 1] in every direction. ies_fit
// tests the values that are computed from them.
#include <cmath>

#include "renderer/base/error.h"
#include "renderer/scene/ies/ies_table.h"
#include "tests/fuzz/targets/scratch.h"

using namespace lamplighter;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const auto profile = parseIesTable(fuzz::textOf(data, size), "fuzz.ies");
    for (int i = 0; i < 26; ++i) {
      const vec3 d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (d == vec3(0.0f)) continue;
      const float v = profile->at(glm::normalize(d));
      if (!(v >= 0.0f && v <= 1.0001f)) fuzz::broken("an intensity in [0, 1]");
      const float tilt = profile->atTilt(glm::normalize(d));
      if (!(tilt >= 0.0f && tilt <= 1000.1f)) fuzz::broken("a factor of the tilt in [0, 1000]");
    }
    if (!std::isfinite(profile->peak)) fuzz::broken("a finite peak");
  } catch (const InputError& e) {
    if (std::string_view(e.what()).find('\n') != std::string_view::npos)
      fuzz::broken("a message of one line");
  }
  return 0;
}
