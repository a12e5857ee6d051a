// The visibility database and the light maps as the capabilities of Inspection.
#pragma once

#include "renderer/light_maps/light_maps.h"
#include "renderer/methods/inspection.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

class DatabasePatches final : public PatchView {
 public:
  explicit DatabasePatches(const VisibilityDatabase& visibility) : visibility_(visibility) {}

  int leafAt(uint32_t object, uint32_t triangle, const vec3& position) const override;
  int patchOf(uint32_t object, int leaf) const override;
  Shape shapeOf(uint32_t object, int patch) const override;
  std::span<const uint8_t> states(uint32_t object, int leaf) const override;
  void forEachPatch(const Visit& visit) const override;

 private:
  const VisibilityDatabase& visibility_;
};

class LightMapTexels final : public TexelView {
 public:
  LightMapTexels(const VisibilityDatabase& visibility, const LightMaps& maps)
      : visibility_(visibility), maps_(maps) {}

  std::optional<Grid> gridAt(uint32_t object, uint32_t triangle,
                             const vec3& position) const override;
  vec3 irradianceAt(uint32_t object, uint32_t triangle, const vec3& position) const override;

 private:
  const VisibilityDatabase& visibility_;
  const LightMaps& maps_;
};

}  // namespace lamplighter
