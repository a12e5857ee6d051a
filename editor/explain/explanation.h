// Explains the brightness of a point: what each light contributes, what it would contribute without
// occluders, and which objects block it.
#pragma once

#include <string>
#include <vector>

#include "editor/explain/light_samples.h"
#include "editor/explain/picked_point.h"

namespace lamplighter {

enum class LightArrival {
  lit,        // all samples that face the point are visible
  partly,     // some of them are visible
  shadowed,   // all of them are hidden
  away,       // no sample faces the point: it is behind the light, outside its cone, or faces away
  leftOut,    // light linking excludes the object (renderer/scene/light_linking.h)
  unsampled,  // the method has no sample on it: brighter lights got all of them
  off         // hidden, or with zero strength
};
const char* nameOf(LightArrival state);  // "lit"

struct BlockingObject {
  NodeId node = kNoNode;
  std::string name;
  float withheld = 0.0f;  // irradiance that the object blocks [lx]
  int samples = 0;        // samples of the light for which it is the first occluder
};

// The share of one light of the scene. The sky with all of its suns is one light.
struct LightShare {
  NodeId light = kNoNode;  // the sky: kNoNode
  std::string name;
  LightArrival state = LightArrival::off;
  bool leavesOut = false;                 // light linking excludes the object of the point
  float direct = 0.0f, bounced = 0.0f;    // irradiance [lx]
  float withheld = 0.0f;                  // blocked direct irradiance [lx]
  int samples = 0, facing = 0, seen = 0;  // samples on the light itself
  int bouncedFacing = 0, bouncedSeen = 0;
  std::vector<BlockingObject> blockers;  // of direct light, strongest blocker first

  float given() const { return direct + bounced; }
};

struct Explanation {
  PickedPoint point;
  std::string object;              // its name
  float irradiance = 0.0f;         // [lx]
  std::vector<LightShare> lights;  // lights that contribute or could contribute, strongest first

  float shareOf(const LightShare& light) const {
    return irradiance > 0.0f ? light.given() / irradiance : 0.0f;
  }
};

// The ray from the point, in the unit of the scene, to a sample. Both ends are offset from their
// surfaces. The length of the direction is the distance, unless the sample is parallel light.
Ray rayTo(const PickedPoint& point, const shared::Vpl& vpl);

// The irradiance E at the point (in metres) [lx].
float irradianceAt(const RayCaster& rays, const PickedPoint& point, const LightSamples& samples);

// Traces a ray from the point (in metres) to each sample. `scene` gives the names of the nodes.
Explanation explain(const Scene& scene, const RenderScene& world, const RayCaster& rays,
                    const PickedPoint& point, const LightSamples& samples);

}  // namespace lamplighter
