#include "renderer/image/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "renderer/base/error.h"

namespace lamplighter {

namespace {

constexpr std::array kMappers = {
    ToneMapperInfo{ToneMapper::linear, "linear", "Linear",
                   "No curve: what is over 1 is white. For judging values."},
    ToneMapperInfo{ToneMapper::reinhard, "reinhard", "Reinhard",
                   "By luminance, so that hues stay; white at 4 (Reinhard et al. 2002)."},
    ToneMapperInfo{ToneMapper::filmic, "filmic", "Filmic",
                   "A fit of the Academy's curve (Narkowicz 2016)."},
    ToneMapperInfo{ToneMapper::hable, "hable", "Hable",
                   "Filmic with a long shoulder, white at 11.2 (Hable 2010)."},
    ToneMapperInfo{ToneMapper::agx, "agx", "AgX",
                   "Bright colours fade to white without a turn of hue (Sobotka 2022, a fit)."},
};

}  // namespace

std::span<const ToneMapperInfo> toneMappers() { return kMappers; }

const ToneMapperInfo& infoOf(ToneMapper mapper) {
  return *std::find_if(kMappers.begin(), kMappers.end(),
                       [&](const ToneMapperInfo& m) { return m.mapper == mapper; });
}

const ToneMapperInfo& findToneMapper(std::string_view name) {
  const auto found = std::find_if(kMappers.begin(), kMappers.end(),
                                  [&](const ToneMapperInfo& m) { return m.name == name; });
  if (found != kMappers.end()) return *found;
  std::string names;
  for (const ToneMapperInfo& m : kMappers)
    names += (names.empty() ? "" : ", ") + std::string(m.name);
  throw InputError("tone mapper", "there is no tone mapper '" + std::string(name) + "'",
                   "give one of " + names);
}

vec3 toneMapPixel(const vec3& radiance, float exposureEv, ToneMapper mapper) {
  return shared::toneMap(radiance, std::exp2(exposureEv), static_cast<int>(mapper));
}

Image8 toneMap(const Image& radiance, float exposureEv, ToneMapper mapper) {
  Image8 out(radiance.width, radiance.height);
  const float scale = std::exp2(exposureEv);
  for (size_t i = 0; i < radiance.pixels.size(); ++i) {
    const vec3 shown = shared::toneMap(radiance.pixels[i], scale, static_cast<int>(mapper));
    for (int c = 0; c < 3; ++c)
      out.pixels[4 * i + static_cast<size_t>(c)] = static_cast<uint8_t>(shown[c] * 255.0f + 0.5f);
  }
  return out;
}

}  // namespace lamplighter
