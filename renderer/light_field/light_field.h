// The light field: bounced light and the light of the sky at texels of the surface, along a fixed
// set of directions (paper 5, the virtual light field on the GPU). Its cost does not depend on the
// number or the size of emitters.
//
// For each direction, each texel has a partner: the texel or sky that it sees. Partners are
// computed over several frames, direction by direction; until then old ones are used. When all are
// computed, the light is bitwise equal to that of a new start.
#pragma once

#include <vector>

#include "renderer/light_field/field_gather.h"
#include "renderer/light_field/field_senders.h"
#include "renderer/light_field/partner_table.h"
#include "renderer/texels/scene_texels.h"
#include "renderer/texels/texel_irradiance.h"
#include "renderer/texels/texel_light.h"

namespace lamplighter {

// How partners are found: automatic (a rule that depends on the scene), or as in FieldSight.
enum class FieldSightChoice : uint8_t { automatic, lines, rays };

struct LightFieldOptions {
  float texel = 0.1f;  // side, if memory allows it [m]
  int divisions = 16;  // divisions of the octahedron: 2 divisions² + 1 directions
  FieldSightChoice sight = FieldSightChoice::automatic;
  float cell = 1.0f;       // side of the cells of lines [texels]
  bool withLamps = false;  // area lights and emissive surfaces send light along the field
  int sets = 4;            // rotated sets of directions; all except the first only at rest
  size_t memory = size_t{128} << 20;  // approximate limit for partners [bytes]
  int bounces = 2;
  bool showsSky = true, showsBounces = true;  // parts of irradiance()
  uint32_t seed = 1;
  bool operator==(const LightFieldOptions&) const = default;
};

class LightField final : public TexelIrradiance {
 public:
  // Call in each frame, also in frames without update().
  void outdate(const RenderSceneChanges& changes) { unseen_.merge(changes); }
  // Continues by about `mostWork`; the unit is a sample transported along a line.
  void update(const RenderScene& scene, Services& services, const LightFieldOptions& options,
              uint64_t mostWork);

  bool isDone() const override;
  // Share of the partners of the first set that are up to date.
  float prepared() const { return table_.shareCurrent(); }
  // Approximate number of missing partners of all sets.
  uint64_t samplesLeft() const;
  uint32_t version() const override { return version_; }
  uint32_t texelVersion() const override { return ground_.version(); }
  const std::vector<vec3>& irradiance() const override { return irradiance_; }
  TexelBlend blendAt(const RenderScene& scene, const RayCaster& rays, uint32_t object,
                     uint32_t triangle, bool isBack, const vec3& position) const override {
    return ground_.blendAt(scene, rays, object, triangle, isBack, position);
  }

  const std::vector<vec3>& reflected() const override { return reflected_; }
  vec3 skyTowards(const vec3& direction) const override;
  const TexelSet& texels() const override { return ground_.set(); }
  // Directions of the first set.
  const FieldDirections& directions() const { return directions_; }
  std::span<const FieldReceiver> receivers() const { return receivers_; }
  const PartnerTable& partners() const { return table_; }
  // Radiance of partners that contributes to irradiance() [W/(m² sr)], by PartnerNumbers.
  const PartnerRadiance& sent() const { return sent_; }
  FieldGeometry geometryOf(const RenderScene& scene, const RayCaster& rays) const {
    return geometryOf(scene, rays, directions_, 0);
  }

  // Work of the last update.
  struct Counts {
    PartnerCounts partners;
    uint64_t lampRays = 0;
    size_t bytes = 0;
  };
  const Counts& counts() const { return counts_; }
  float texelSide() const { return ground_.side(); }  // [m]
  void forget() { *this = LightField(); }

 private:
  void takeGeometry(const RenderScene& scene, Services& services,
                    const RenderSceneChanges& changes);
  FieldGeometry geometryOf(const RenderScene& scene, const RayCaster& rays,
                           const FieldDirections& directions, uint32_t set) const;
  void findReceivers(const RenderScene& scene);
  void findSets(const RenderScene& scene, const RayCaster& rays, uint64_t mostWork);
  size_t directionsOfSets() const {
    return static_cast<size_t>(options_.sets - 1) * directions_.size();
  }
  void send();
  void bounce(const RenderScene& scene);
  void show();
  void findReflected();

  LightFieldOptions options_;
  RenderSceneChanges unseen_;
  LightSet lights_;
  SceneTexels ground_;
  FieldSurface surface_;
  std::vector<FieldReceiver> receivers_;  // by texel
  FieldDirections directions_;
  FieldSight sight_ = FieldSight::lines;
  PartnerTable table_;
  SenderBlocks blocks_;
  std::vector<vec3> albedo_;  // by texel
  TexelLight lamps_;
  // Radiance of partners [W/(m² sr)], by PartnerNumbers. sources_: the sky, and lamps that send
  // light along the field. sent_: for the last bounce, texels and the shown part of sources_.
  PartnerRadiance sources_, sent_;
  std::vector<vec3> lampLight_;        // irradiance by lamps and suns, by texel [W/m²]
  FieldSums sourceSums_, bounceSums_;  // sums of the first set
  FieldSums setSums_;                  // sums of the shown light over the other sets so far
  size_t nextOfSets_ = 0;              // next direction of the other sets
  std::vector<vec3> former_;           // previous light, while all partners are computed again
  std::vector<vec3> irradiance_;       // by texel
  std::vector<vec3> bounced_;    // irradiance by all bounces except the last, by block [W/m²]
  std::vector<vec3> reflected_;  // by texel, without the last bounce [W/m²]
  bool hasSources_ = false;      // sourceSums_ are up to date
  bool isLit_ = false;           // irradiance_ is up to date
  uint32_t version_ = 0;
  Counts counts_;
};

}  // namespace lamplighter
