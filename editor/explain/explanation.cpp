#include "editor/explain/explanation.h"

#include <algorithm>
#include <map>

#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/light_linking.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

// E of one sample without occluders [lx].
float unshadowed(const PickedPoint& p, const LightSamples::Sample& s, float clampDistance) {
  if (isLeftOut(p.leftOutBy, static_cast<uint32_t>(s.vpl.footprint.y))) return 0.0f;
  return luminance(vec3(s.vpl.intensity)) *
         shared::vplGeometry(s.vpl, p.position, p.normal, p.geometricNormal, clampDistance);
}

std::string nameIn(const Scene& scene, NodeId id) {
  if (id == kNoNode) return "sky";
  const Node* node = scene.find(id);
  return node == nullptr || node->name.empty() ? "(unnamed)" : node->name;
}

bool isMeantToLight(const Scene& scene, const Node& node) {
  if (node.area || node.punctual) return true;
  if (node.mesh == kNone) return false;
  const auto& primitives = scene.meshes[static_cast<size_t>(node.mesh)]->primitives;
  return std::any_of(primitives.begin(), primitives.end(), [&](const Primitive& p) {
    return p.material != kNone && scene.materials[static_cast<size_t>(p.material)].emits();
  });
}

LightArrival stateOf(const LightShare& l) {
  if (l.leavesOut) return LightArrival::leftOut;
  if (l.samples == 0) return LightArrival::unsampled;
  if (l.facing == 0) return LightArrival::away;
  if (l.seen == 0) return LightArrival::shadowed;
  return l.seen == l.facing ? LightArrival::lit : LightArrival::partly;
}

// One entry for each light that emits or is intended to emit.
std::map<NodeId, LightShare> allLights(const Scene& scene, const RenderScene& world) {
  std::map<NodeId, LightShare> shares;
  for (const Node& node : scene.nodes)
    if (isMeantToLight(scene, node)) shares[node.id].light = node.id;
  const LightSet lights(world);
  for (const Emitter& e : lights.emitters()) {
    if (!(luminance(e.flux) > 0.0f)) continue;  // it is off
    LightShare& l = shares[e.node];
    l.light = e.node;
    l.state = LightArrival::unsampled;
  }
  for (auto& [id, l] : shares) l.name = nameIn(scene, id);
  return shares;
}

void addSample(const RenderScene& world, const RayCaster& rays, const PickedPoint& point,
               const LightSamples::Sample& sample, float given, LightShare& l) {
  const bool isDirect = sample.id.bounce == 0;
  if (isDirect) ++l.samples;
  if (!(given > 0.0f)) return;
  ++(isDirect ? l.facing : l.bouncedFacing);
  const Hit hit = rays.intersect(rayTo(point, sample.vpl));
  if (!hit) {
    ++(isDirect ? l.seen : l.bouncedSeen);
    (isDirect ? l.direct : l.bounced) += given;
    return;
  }
  if (!isDirect) return;
  l.withheld += given;
  const NodeId node = world.objects[hit.object].node;
  auto blocker = std::find_if(l.blockers.begin(), l.blockers.end(),
                              [&](const BlockingObject& b) { return b.node == node; });
  if (blocker == l.blockers.end())
    blocker = l.blockers.insert(blocker, BlockingObject{node, "", 0, 0});
  blocker->withheld += given;
  ++blocker->samples;
}

}  // namespace

const char* nameOf(LightArrival state) {
  switch (state) {
    case LightArrival::lit:
      return "lit";
    case LightArrival::partly:
      return "partly";
    case LightArrival::shadowed:
      return "shadowed";
    case LightArrival::away:
      return "faces away";
    case LightArrival::leftOut:
      return "left out";
    case LightArrival::unsampled:
      return "no samples";
    case LightArrival::off:
      break;
  }
  return "off";
}

Ray rayTo(const PickedPoint& p, const shared::Vpl& vpl) {
  const vec3 start = p.position + rayEpsilon(p.position) * p.geometricNormal;
  const vec3 axis(vpl.normal);
  if (vpl.position.w == shared::kVplDirectional) return {start, 0.0f, axis};
  vec3 end(vpl.position);
  if (vpl.position.w == shared::kVplCosine) end += rayEpsilon(end) * axis;
  return {start, 0.0f, end - start, 1.0f};
}

float irradianceAt(const RayCaster& rays, const PickedPoint& metres, const LightSamples& samples) {
  const PickedPoint point = inUnits(metres, samples.unit);
  float sum = 0.0f;
  for (const LightSamples::Sample& s : samples.samples) {
    const float given = unshadowed(point, s, samples.clampDistance);
    if (given > 0.0f && !rays.occluded(rayTo(point, s.vpl))) sum += given;
  }
  return sum;
}

Explanation explain(const Scene& scene, const RenderScene& world, const RayCaster& rays,
                    const PickedPoint& point, const LightSamples& samples) {
  Explanation out;
  out.point = point;
  for (const RenderObject& o : world.objects)  // light linking may have changed since
    if (o.node == point.node) out.point.leftOutBy = o.leftOutBy;
  out.object = nameIn(scene, point.node);
  std::map<NodeId, LightShare> shares = allLights(scene, world);
  const PickedPoint at = inUnits(out.point, samples.unit);
  for (const LightSamples::Sample& s : samples.samples) {
    const auto found = shares.find(s.id.light);
    if (found == shares.end()) continue;  // its light was just deleted
    if (s.id.bounce == 0)
      found->second.leavesOut =
          isLeftOut(out.point.leftOutBy, static_cast<uint32_t>(s.vpl.footprint.y));
    addSample(world, rays, at, s, unshadowed(at, s, samples.clampDistance), found->second);
  }
  for (auto& [id, l] : shares) {
    if (l.state != LightArrival::off) l.state = stateOf(l);
    for (BlockingObject& b : l.blockers) b.name = nameIn(scene, b.node);
    std::stable_sort(
        l.blockers.begin(), l.blockers.end(),
        [](const BlockingObject& a, const BlockingObject& b) { return a.withheld > b.withheld; });
    out.irradiance += l.given();
    out.lights.push_back(std::move(l));
  }
  std::stable_sort(out.lights.begin(), out.lights.end(),
                   [](const LightShare& a, const LightShare& b) {
                     const float mayA = a.given() + a.withheld, mayB = b.given() + b.withheld;
                     return mayA != mayB ? mayA > mayB : a.state < b.state;
                   });
  return out;
}

}  // namespace lamplighter
