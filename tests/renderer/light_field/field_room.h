// A closed room with a box and a tilted plate, with texels and what they see.
#pragma once

#include "renderer/light_field/field_gather.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {

struct FieldRoom {
  RenderScene scene;
  std::unique_ptr<RayCaster> rays;
  ObjectCharts charts{std::filesystem::path()};
  std::vector<ObjectAtlas> atlases;
  TexelSet texels;
  FieldSurface surface;
  FieldDirections directions;
  std::vector<FieldReceiver> receivers;
  float cell = 0.0f;

  explicit FieldRoom(int divisions = 8, float texel = 0.25f)
      : directions(divisions, 1), cell(texel) {
    Scene room;
    addMesh(room, roomMesh(vec3(4.0f, 3.0f, 4.0f), addMaterial(room, vec3(0.7f))));
    const NodeId box =
        addMesh(room, boxMesh(vec3(1.0f), addMaterial(room, vec3(0.5f))), vec3(0.3f, -0.5f, 0.2f));
    room.find(box)->local.rotation = glm::angleAxis(0.4f, glm::normalize(vec3(1, 2, 3)));
    scene = renderSceneOf(room);
    rays = std::make_unique<RayCaster>(scene);
    const auto found = charts.find(scene, 1.0f / texel);
    atlases.assign(found.begin(), found.end());
    texels = TexelSet(scene, atlases, TexelOrder::zigzag);
    texels.findBuried(scene, *rays);
    surface = FieldSurface(scene, atlases, texels, false);
    for (size_t t = 0; t < texels.size(); ++t) {
      const SurfaceSpot& spot = texels[t].spot;
      receivers.push_back({spot.position, spot.rayOrigin(), spot.normal, spot.geometricNormal,
                           texels[t].object, false, true, texels.isBuried(t)});
    }
  }
  FieldGeometry geometry(FieldSight sight) const {
    return {scene, *rays, atlases, surface, receivers, directions, 0, cell, sight};
  }
  PartnerNumbers numbers() const {
    return {static_cast<uint32_t>(receivers.size()), static_cast<uint32_t>(directions.size())};
  }
  // Of all directions, by direction, then by texel.
  std::vector<uint32_t> partners(FieldSight sight, PartnerCounts* counts = nullptr) const {
    std::vector<uint32_t> out(receivers.size() * directions.size());
    std::vector<LineRaster> rasters(1);
    for (uint32_t d = 0; d < directions.size(); ++d) {
      const PartnerTarget target{d, out.data() + d * receivers.size()};
      const PartnerCounts found = findPartners(geometry(sight), {&target, 1}, rasters);
      if (counts != nullptr) counts->add(found);
    }
    return out;
  }
  // Irradiance of all texels.
  std::vector<vec3> gathered(const std::vector<uint32_t>& partners,
                             const PartnerRadiance& radiance) const {
    std::vector<PartnerRow> rows;
    for (uint32_t d = 0; d < directions.size(); ++d)
      rows.push_back({d, partners.data() + d * receivers.size()});
    FieldSums sums(receivers.size(), vec4(0.0f));
    addGathered(receivers, directions, rows, radiance, sums);
    std::vector<vec3> out;
    for (const vec4& sum : sums) out.push_back(irradianceOf(sum));
    return out;
  }
};

}  // namespace lamplighter::test
