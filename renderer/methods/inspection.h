// Access to internal data of a method, for debug views and tools: a set of capabilities. A view
// checks for those that it needs and is independent of the method.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/legend.h"
#include "renderer/sampling/light_sample_table.h"
#include "renderer/visibility/occlusion/occlusion.h"

namespace lamplighter {

enum class Capability : uint8_t { lights, patches, texels, elements, transfer, points, links };
const char* nameOf(Capability capability);  // in the plural: "light samples"

// Patches: pieces of surface for which the method knows which light samples reach them.
// Neighbouring leaves with equal visibility form one patch. All functions may be called in
// parallel.
class PatchView {
 public:
  virtual ~PatchView() = default;

  // The leaf at a point of a triangle of an object (index into RenderScene::objects).
  virtual int leafAt(uint32_t object, uint32_t triangle, const vec3& position) const = 0;
  // The patch to which a leaf belongs.
  virtual int patchOf(uint32_t object, int leaf) const = 0;
  struct Shape {
    int level = 0;         // how often its root was divided
    bool isPlanar = true;  // a rectangle; otherwise a box around geometry that is not planar
    vec2 size{0.0f};       // size of the rectangle; for a box, its diagonal [m]
  };
  virtual Shape shapeOf(uint32_t object, int patch) const = 0;

  // The occlusion between the patch of the leaf and each light sample: values of Occlusion, by
  // slot.
  virtual std::span<const uint8_t> states(uint32_t object, int leaf) const = 0;
  Occlusion state(uint32_t object, int leaf, int slot) const {
    return static_cast<Occlusion>(states(object, leaf)[static_cast<size_t>(slot)]);
  }
  // Calls visit(states) for each patch.
  using Visit = std::function<void(std::span<const uint8_t> states)>;
  virtual void forEachPatch(const Visit& visit) const = 0;
};

// Light that is stored in grids of texels on surfaces. All functions may be called in parallel.
class TexelView {
 public:
  virtual ~TexelView() = default;

  // A grid, and the position of a point in it. Texels are at the corners of the cells.
  struct Grid {
    vec2 size{0.0f};   // along the axes of the grid [m]
    vec2 cells{1.0f};  // along each axis
    vec2 at{0.0f};     // the point, in cells from the first texel
  };
  // None where the method stores no light.
  virtual std::optional<Grid> gridAt(uint32_t object, uint32_t triangle,
                                     const vec3& position) const = 0;
  // Irradiance E on the front of the surface [W/m²], at points for which gridAt() returns a grid.
  virtual vec3 irradianceAt(uint32_t object, uint32_t triangle, const vec3& position) const = 0;
};

// Surface elements at whose corners light is stored. All functions may be called in parallel.
class ElementView {
 public:
  virtual ~ElementView() = default;

  // A point on an element.
  struct Place {
    uint32_t element = 0;
    vec3 weights{1.0f, 0.0f, 0.0f};  // of its corners
    bool isCluster = false;          // it represents many small triangles
    float trust = 1.0f;  // share of the light of a pixel that comes from the element while the
                         // camera is still
  };
  // `weights`: barycentric weights of the second and third corner of the triangle. None where the
  // method stores no light.
  virtual std::optional<Place> placeAt(uint32_t object, uint32_t triangle, bool isBack,
                                       const vec2& weights) const = 0;

  struct Corner {
    vec3 irradiance{0.0f};  // stored irradiance [W/m²]
    float pending = 0.0f;   // share of its rays that are outdated or missing
    bool isBuried = false;  // inside of an object or behind a wall
  };
  virtual std::array<Corner, 3> cornersOf(uint32_t element) const = 0;
};

// Whether an object is lit by precomputed transfer.
enum class TransferState : uint8_t { none, pending, ready };

// A place in the scene where the method computes something, such as a probe.
struct InspectedPoint {
  vec3 position{0.0f}, normal{0.0f};  // a zero normal: no direction
  bool isStale = false;               // it waits for an update
};

// A point of a surface at which links are queried. Lengths are in the unit of the scene.
struct InspectedPlace {
  uint32_t object = 0, triangle = 0;  // index into RenderScene::objects; triangle of the object
  bool isBack = false;                // of the triangle
  vec2 weights{0.0f};                 // of the second and third corner of the triangle
  vec3 position{0.0f};                // world space
};

// Bounced light that a point receives from a part of a surface.
struct InspectedLink {
  vec3 from{0.0f}, to{0.0f};  // the point; the centre of the sender [unit of the scene]
  uint32_t object = 0;        // of the sender: index into RenderScene::objects
  vec3 irradiance{0.0f};      // contribution to the irradiance of the point [W/m²]
  float size = 0.0f;          // side of a square with the area of the sender [unit of the scene]
};

// Where the bounced light of a point comes from. The sum over all links equals the stored
// irradiance of the point by bounced light, within a relative error of 1e-5 once the picture is
// settled. Empty: the point gets no bounced light. None: the links are not computed yet.
using InspectedLinks =
    std::function<std::optional<std::vector<InspectedLink>>(const InspectedPlace& place)>;

// Valid until the method's next render() or reset(). Capabilities that a method does not have are
// null or empty.
struct Inspection {
  std::span<const LightSample> lights;  // in an order that does not change with edits
  // The samples exclude sky light except suns, which is stored on surfaces.
  bool lightsLeaveOutSky = false;
  // They also exclude emissive surfaces.
  bool lightsLeaveOutSurfaces = false;
  std::shared_ptr<const PatchView> patches;
  std::shared_ptr<const TexelView> texels;
  std::shared_ptr<const ElementView> elements;
  std::function<TransferState(uint32_t object)> transfer;
  std::function<std::vector<InspectedPoint>()> points;
  InspectedLinks links;
  // The method's own debug views (MethodInfo::views), by name. Each function draws one for the view
  // of the last frame.
  std::map<std::string, std::function<ViewPicture()>> pictures;

  bool has(Capability capability) const;
};

}  // namespace lamplighter
