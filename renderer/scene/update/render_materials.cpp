#include "renderer/scene/update/render_materials.h"

#include <algorithm>
#include <map>
#include <utility>

#include "renderer/scene/light_picture.h"
#include "renderer/scene/reference_brightness.h"

namespace lamplighter {

namespace {

// Black while the light does not shine: its surface stays visible, dark and selectable.
Material emitterMaterial(const AreaLight& light, bool shines, int picture) {
  Material m;
  m.name = "area light";
  m.baseColor = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  m.metallic = 0.0f;
  m.emissive = shines ? light.radiance : vec3(0.0f);
  m.emissiveTexture.texture = picture;
  // The surface's u points along the node's X, which is to the left when its front is seen.
  m.emissiveTexture.offset = vec2(1.0f, 0.0f);
  m.emissiveTexture.scale = vec2(-1.0f, 1.0f);
  return m;
}

Material darkCopy(const Material& material) {
  Material m = material;
  m.emissive = vec3(0.0f);
  return m;
}

}  // namespace

RenderMaterials::RenderMaterials(const Scene& scene, const std::vector<bool>& shining)
    : materials(scene.materials), textures(scene.textures), ofAreaLight(scene.nodes.size(), kNone) {
  materials.emplace_back().metallic = 0.0f;  // the default material
  for (const Material& m : materials) nominalEmission.push_back(m.emissive);
  // Lights with the same picture share a texture.
  std::map<const LightPicture*, int> known;
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    if (!scene.nodes[i].area) continue;
    const AreaLight& light = *scene.nodes[i].area;
    int texture = kNone;
    if (const LightPicture* picture = shownPicture(light)) {
      const auto [it, isNew] = known.emplace(picture, static_cast<int>(textures.size()));
      if (isNew)
        textures.push_back({picture->file, picture->image, Wrap::clamp, Wrap::clamp, false, false});
      texture = it->second;
    }
    ofAreaLight[i] = static_cast<int>(materials.size());
    materials.push_back(emitterMaterial(light, shining[i], texture));
    nominalEmission.push_back(light.radiance);
  }
  firstDark = static_cast<int>(materials.size());
  for (const Material& m : scene.materials) {
    materials.push_back(darkCopy(m));
    nominalEmission.push_back(m.emissive);
  }
}

int materialOf(const Scene& scene, const Primitive& p, bool shines, int firstDark) {
  if (p.material == kNone) return static_cast<int>(scene.materials.size());
  const bool isDark = !shines && scene.materials[static_cast<size_t>(p.material)].emits();
  return p.material + (isDark ? firstDark : 0);
}

void noteMaterial(const MaterialState& before, const MaterialState& now, int index,
                  bool isOfAreaLight, RenderSceneChanges& out) {
  out.references |=
      referenceBrightness(before.nominalEmission) != referenceBrightness(now.nominalEmission);
  Material was = before.material;
  was.name = now.material.name;  // does not affect rendering
  if (was == now.material) return;
  const bool emitted = was.emits();
  was.emissive = now.material.emissive;
  if ((isOfAreaLight || emitted == now.material.emits()) && was == now.material)
    out.emissions.push_back(index);
  else
    out.materials = true;
}

void takeMaterials(RenderScene& render, RenderMaterials now, RenderSceneChanges& out) {
  const auto count = static_cast<int>(now.materials.size() - static_cast<size_t>(now.firstDark));
  for (size_t i = 0; i < now.materials.size(); ++i) {
    const auto index = static_cast<int>(i);
    noteMaterial({render.materials[i], render.nominalEmission[i]},
                 {now.materials[i], now.nominalEmission[i]}, index,
                 index > count && index < now.firstDark, out);
  }
  render.materials = std::move(now.materials);
  render.nominalEmission = std::move(now.nominalEmission);
}

}  // namespace lamplighter
