#include "renderer/prt/prt_shape.h"

#include <algorithm>

#include "renderer/prt/incident_light_points.h"

namespace lamplighter {
namespace {

// By area: what a simple object has besides charts are slivers with too few vertices to represent
// light.
bool isMostlyComplex(const RenderScene& scene, const RenderObject& o,
                     const ObjectPatches& patches) {
  double loose = 0.0, all = 0.0;
  for (uint32_t t = 0; t < o.triangleCount(); ++t) {
    const uint32_t* corner = &scene.indices[o.firstIndex + 3 * static_cast<size_t>(t)];
    // In node space, so that rotation does not change the result.
    const vec3& a = scene.localPositions[corner[0]];
    const double area = glm::length(
        glm::cross(scene.localPositions[corner[1]] - a, scene.localPositions[corner[2]] - a));
    const auto patch = static_cast<size_t>(patches.patchOfTriangle[t]);
    all += area;
    if (patches.patches[patch].chart == kNone) loose += area;
  }
  return loose > 0.5 * all;
}

// Light at vertices would be wrong if pixel normals come from a texture. An emissive object lights
// itself by VPLs that its transfer does not include.
bool mayHaveTransfer(const RenderScene& scene, const RenderObject& o) {
  const Material& m = scene.materials[static_cast<size_t>(o.material)];
  const bool mayEmit = scene.nominalEmission[static_cast<size_t>(o.material)] != vec3(0.0f);
  return !o.isAreaLight && !mayEmit && !m.isClear() && m.normalTexture.texture == kNone;
}

// The longest side of its bounds in its own space [m].
float sizeOf(const RenderScene& scene, const RenderObject& o, const OwnSpace& space) {
  Bounds bounds;
  for (uint32_t i = 0; i < o.vertexCount; ++i)
    bounds.add(space.stretch * scene.localPositions[o.firstVertex + i]);
  const vec3 extent = bounds.extent();
  return std::max({extent.x, extent.y, extent.z}) * space.scale;
}

}  // namespace

PrtShape prtShapeOf(const RenderScene& scene, uint32_t object, const ObjectPatches& patches,
                    int mostPoints) {
  const RenderObject& o = scene.objects[object];
  PrtShape out;
  for (const int root : patches.roots)
    if (patches.patches[static_cast<size_t>(root)].chart == kNone) out.looseRoots.push_back(root);
  const auto space = ownSpaceOf(o);
  if (out.looseRoots.empty() || !space || !mayHaveTransfer(scene, o) ||
      !isMostlyComplex(scene, o, patches))
    return {};
  out.mayHaveTransfer = true;
  out.stretch = space->stretch;
  out.points = lightPointsFor(sizeOf(scene, o, *space), mostPoints);
  for (const int patch : patches.patchOfTriangle)
    out.isLoose.push_back(patches.patches[static_cast<size_t>(patch)].chart == kNone);
  return out;
}

}  // namespace lamplighter
