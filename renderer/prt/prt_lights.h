// Irradiance at the vertices of complex objects by precomputed radiance transfer (paper 1, 4.4.1).
// At each light point of an object, the light of the VPLs that see it is stored as spherical
// harmonics in the object's own space. Each vertex blends these and multiplies them with its
// transfer.
//
// The sums are kept from frame to frame, as in light maps. They are fixed-point numbers: each
// coefficient of a VPL is rounded to a multiple of 2⁻²⁴ W/m² and added as a double, which is exact
// up to 2²⁹ W/m². Adding a VPL and subtracting it again restores the same bits, in any order.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "renderer/prt/prt_shape.h"
#include "renderer/prt/transfer_validation.h"
#include "renderer/prt/transfers.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/visibility/visibility_database.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

class PrtLights {
 public:
  struct Options {
    TransferOptions transfer;
    int mostPoints = 128;        // light points per object, at most kMostLightPoints
    float clampDistance = 0.0f;  // of ShadingParams [m]
    // limit for lightsToLeave(); for values of at least 1 no light is excluded because of its error
    float mostError = 1.0f;
    size_t mostBytes = SIZE_MAX;  // for all objects; objects that do not fit have no transfer
    bool operator==(const Options&) const = default;
  };

  explicit PrtLights(TransferCache cache = TransferCache(),
                     Transfers::Compute compute = computeTransfer)
      : transfers_(std::move(cache), std::move(compute)) {}

  // By slot.
  struct Lights {
    std::span<const shared::Vpl> vpls;  // as in the database, with their intensities
    // false: the shadows of this light do not yet show all movements
    std::vector<bool> areUpToDate;
    std::vector<bool> areLast;  // of the last bounce, so not reflected again; empty: none is
  };
  // Applies the changes. Call after the database is updated and before its clearChanged(). When all
  // lights are up to date, the irradiance afterwards equals the one computed from scratch. `waits`:
  // wait for transfer that is not ready; otherwise its objects are not lit by it until it is ready.
  // Returns whether the visible result changed.
  bool update(const RenderScene& scene, const RenderSceneChanges& changes, const RayCaster& rays,
              const VisibilityDatabase& visibility, const Lights& lights, const Options& options,
              bool waits);

  // Whether pixels of a leaf patch start from this irradiance: pixels on the front of triangles
  // that are in no chart.
  bool covers(const ObjectPatches& patches, uint32_t object, int leaf) const {
    return objects_[object].transfer != nullptr &&
           patches.patches[static_cast<size_t>(leaf)].chart == kNone;
  }
  bool hasTransfer(uint32_t object) const { return objects_[object].transfer != nullptr; }
  // By object, whether its transfer includes the interreflection between its parts.
  std::vector<uint8_t> reflecting() const;
  // Whether the object is to have transfer, ready or not.
  bool wantsTransfer(uint32_t object) const { return objects_[object].isWanted; }
  // The light points of the object, in world space; none without transfer.
  std::span<const vec3> lightPoints(uint32_t object) const { return objects_[object].places; }
  // Whether the normal points to the front side of the triangle.
  bool isFront(uint32_t object, uint32_t triangle, const vec3& normal) const;
  // By slot, whether this irradiance includes the light. Pixels sum the other lights: those too
  // near to be blended between light points, those that make hard shadows, and those for which the
  // error of transfer would be too large. Only for objects with transfer.
  std::span<const uint8_t> held(uint32_t object) const { return objects_[object].held; }
  // E at a point on a triangle of the object [W/m²].
  vec3 irradiance(uint32_t object, uint32_t triangle, const vec3& position) const;
  // E at each vertex of the object; empty: it has no transfer (yet).
  std::span<const vec3> irradiance(uint32_t object) const { return objects_[object].irradiance; }

  // Counts of objects with and without transfer, and of lights that pixels sum because of the error
  // of transfer.
  struct Left {
    int objects = 0, wholly = 0;
    int lights = 0;       // over all other objects
    int withoutRoom = 0;  // objects without transfer because memory is short
  };
  Left left() const;

  // Memory of all objects, transfer and light.
  size_t bytes() const;

  size_t objects() const { return objects_.size(); }
  const Revision& revision(uint32_t object) const { return objects_[object].revision; }
  const Revision& coverage() const { return coverage_; }  // of the result of covers()

  Transfers::Progress progress() const { return transfers_.progress(); }
  // State of the computation in the background. Objects without transfer are lit per pixel.
  std::exception_ptr takeError() { return transfers_.takeError(); }
  // Rays to VPLs since construction (rays that the database made unnecessary are not counted).
  uint64_t rays() const { return raysTraced_; }
  uint64_t raysSpared() const { return raysSpared_; }
  // Upper bound per changed light: one ray to each light point.
  uint64_t raysPerLight() const;

 private:
  // Sums of one light point. First r, g, b of the light that object parts reflect; it uses the
  // whole transfer. Then r, g, b of a correction that uses only the direct transfer: plus light
  // that is not reflected, minus light whose direct part pixels sum.
  static constexpr size_t kSums = size_t{3} * kShCoefficients;
  // How an object receives the light in a slot. `own`: not at all, and its pixels do not sum it
  // either. `near`: not by transfer, because the light is too near. `left`: not by transfer,
  // because of its error. `straight`: only direct light; `reflected`: only interreflection; `all`:
  // both.
  enum class Take : uint8_t { own, near, left, straight, reflected, all };
  static bool mayTake(Take take) { return take >= Take::left; }
  static bool hasStraight(Take take) { return take == Take::straight || take == Take::all; }
  static bool hasReflected(Take take) { return take >= Take::reflected; }
  struct Object {
    PrtShape shape;
    bool isWanted = false;  // it may have transfer, and has room
    bool lacksRoom = false;
    TransferKey key{};
    std::shared_ptr<const RenderScene> own;  // until the transfer is ready
    std::shared_ptr<const Transfer> transfer;
    OwnSpace space;
    IncidentLightPoints points;
    std::vector<vec3> places;  // of the points, world space
    std::vector<ValidationPoint> checks;
    std::vector<double> sums;          // points × 2 · kSums
    std::vector<Take> takes;           // by slot, as used in the sums
    std::vector<LightErrors> checked;  // by slot
    std::vector<uint8_t> hidden;       // slots × points, as used in the sums
    std::vector<uint8_t> held;         // by slot
    std::vector<vec3> irradiance;      // by vertex
    Revision revision;
    int lightsLeft = 0;   // lights that pixels sum because of their error
    bool isLeft = false;  // pixels sum all direct light
    size_t bytes = 0;     // of all the above
    void countBytes();
    void dropTransfer() { *this = Object{.shape = std::move(shape)}; }
  };
  struct Frame;

  std::vector<uint32_t> reshape(const Frame& frame, std::span<const uint32_t> some);
  void findObjects(const Frame& frame, std::span<const uint32_t> others);
  std::vector<uint32_t> findRoom(const Frame& frame);
  void placeObject(const Frame& frame, uint32_t object);
  // For some slots: how each light is taken, apart from hardness and error; and slots × points,
  // whether hidden.
  struct Looked {
    std::vector<Take> takes;
    std::vector<uint8_t> hidden;
  };
  Looked look(const Frame& frame, uint32_t object, std::span<const uint32_t> slots);
  bool sumLights(const Frame& frame, uint32_t object, std::span<const uint32_t> slots);
  bool isReflected(size_t slot) const;
  void addLight(Object& object, const shared::Vpl& vpl, Take take, size_t point, double sign);
  Take takeOf(const Frame& frame, uint32_t object, size_t slot) const;
  void lightVertices(Object& object);

  Transfers transfers_;
  const RenderScene* scene_ = nullptr;
  Options options_;
  bool isKnown_ = false;
  std::vector<Object> objects_;
  std::vector<shared::Vpl> lights_;  // by slot, as used in the sums
  std::vector<bool> isHard_;         // by slot: its shadows are too hard for transfer
  std::vector<bool> areLast_;        // by slot
  std::vector<bool> isStale_;        // by slot: something moved since its shadows were computed
  Revision coverage_;
  uint64_t raysTraced_ = 0, raysSpared_ = 0;
};

}  // namespace lamplighter
