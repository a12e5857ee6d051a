// Why a point is as bright or as dark as it is: what each light gives there, what it would give if
// nothing stood between, and what does.
#pragma once

#include <string>
#include <vector>

#include "editor/explain/light_samples.h"
#include "editor/explain/picked_point.h"

namespace lamplighter {

enum class LightArrival {
  lit,        // by all of its samples that face the point
  partly,     // by some of them
  shadowed,   // by none: all are hidden
  away,       // none faces the point: it is behind the light or outside its cone, or looks away
  leftOut,    // the light leaves the object out (renderer/scene/light_linking.h)
  unsampled,  // the method has no sample on it: brighter lights took them all
  off         // hidden, or without strength
};
const char* nameOf(LightArrival state);  // "lit"

struct BlockingObject {
  NodeId node = kNoNode;
  std::string name;
  float withheld = 0.0f;  // irradiance that it keeps away [lx]
  int samples = 0;        // of the light, before which it stands first
};

// A light of the scene; the sky with all of its suns is one.
struct LightShare {
  NodeId light = kNoNode;  // the sky: kNoNode
  std::string name;
  LightArrival state = LightArrival::off;
  bool leavesOut = false;                 // the object that the point is on
  float direct = 0.0f, bounced = 0.0f;    // irradiance [lx]
  float withheld = 0.0f;                  // direct irradiance that does not arrive [lx]
  int samples = 0, facing = 0, seen = 0;  // on the light itself
  int bouncedFacing = 0, bouncedSeen = 0;
  std::vector<BlockingObject> blockers;  // of direct light, the one that withholds most first

  float given() const { return direct + bounced; }
};

struct Explanation {
  PickedPoint point;
  std::string object;              // its name
  float irradiance = 0.0f;         // [lx]
  std::vector<LightShare> lights;  // those that give or could give most first

  float shareOf(const LightShare& light) const {
    return irradiance > 0.0f ? light.given() / irradiance : 0.0f;
  }
};

// From the point to a sample; both ends stand off their surfaces. Its direction is as long as the
// way, unless the sample is parallel light.
Ray rayTo(const PickedPoint& point, const shared::Vpl& vpl);

// E at the point [lx].
float irradianceAt(const RayCaster& rays, const PickedPoint& point, const LightSamples& samples);

// A ray to each sample. `scene` names the nodes.
Explanation explain(const Scene& scene, const RenderScene& world, const RayCaster& rays,
                    const PickedPoint& point, const LightSamples& samples);

}  // namespace lamplighter
