// The light field: bounced light and the light of the sky at texels of the surface, from all
// directions alike (paper 5, the virtual light field on the GPU).
// Its cost does not depend on the number or the size of what emits.
//
// For each direction, each texel has a partner: what it sees there. Partners are found over several
// frames, direction by direction; until then old ones stay. When all are found, the light is that
// of a fresh start, bit for bit.
#pragma once

#include <vector>

#include "renderer/light_field/field_gather.h"
#include "renderer/light_field/field_senders.h"
#include "renderer/light_field/partner_table.h"
#include "renderer/texels/scene_texels.h"
#include "renderer/texels/texel_irradiance.h"
#include "renderer/texels/texel_light.h"

namespace lamplighter {

// How partners are found: by a rule on the scene, or as in FieldSight.
enum class FieldSightChoice : uint8_t { automatic, lines, rays };

struct LightFieldOptions {
  float texel = 0.1f;  // side where memory allows it [m]
  int divisions = 16;  // of the octahedron: 2 divisions² + 1 directions
  FieldSightChoice sight = FieldSightChoice::automatic;
  float cell = 1.0f;       // side of the cells of lines [texels]
  bool withLamps = false;  // area lights and surfaces that emit send their light along the field
  int sets = 4;            // of directions, each turned; all but the first at rest
  size_t memory = size_t{128} << 20;  // of partners, about
  int bounces = 2;
  bool showsSky = true, showsBounces = true;  // what irradiance() is the sum of
  uint32_t seed = 1;
  bool operator==(const LightFieldOptions&) const = default;
};

class LightField final : public TexelIrradiance {
 public:
  // Takes the changes of each frame, also of those without update().
  void outdate(const RenderSceneChanges& changes) { unseen_.merge(changes); }
  // Goes on by about so much work; its unit is a sample transported along a line.
  void update(const RenderScene& scene, Services& services, const LightFieldOptions& options,
              uint64_t mostWork);

  bool isDone() const override;
  // Share of the partners of the first set that are those of now.
  float prepared() const { return table_.shareCurrent(); }
  // Partners of all sets that are still to be found, about.
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
  // Of the first set.
  const FieldDirections& directions() const { return directions_; }
  std::span<const FieldReceiver> receivers() const { return receivers_; }
  const PartnerTable& partners() const { return table_; }
  // What partners send to irradiance() [W/(m² sr)], by PartnerNumbers.
  const PartnerRadiance& sent() const { return sent_; }
  FieldGeometry geometryOf(const RenderScene& scene, const RayCaster& rays) const {
    return geometryOf(scene, rays, directions_, 0);
  }

  // Of the last update.
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
  // What partners send [W/(m² sr)], by PartnerNumbers: the sky, and lamps that send their light
  // along the field; for the last bounce, texels and what is shown of these.
  PartnerRadiance sources_, sent_;
  std::vector<vec3> lampLight_;        // irradiance by lamps and suns, by texel [W/m²]
  FieldSums sourceSums_, bounceSums_;  // of the first set
  FieldSums setSums_;                  // of the other sets so far: what is shown
  size_t nextOfSets_ = 0;              // direction of the other sets
  std::vector<vec3> former_;           // light of before, while partners are found from nothing
  std::vector<vec3> irradiance_;       // by texel
  std::vector<vec3> bounced_;          // irradiance by all bounces but the last, by block [W/m²]
  std::vector<vec3> reflected_;        // by texel, without the last bounce [W/m²]
  bool hasSources_ = false;            // sourceSums_ are those of now
  bool isLit_ = false;                 // irradiance_ is that of now
  uint32_t version_ = 0;
  Counts counts_;
};

}  // namespace lamplighter
