// Irradiance at the vertices of complex objects by precomputed radiance transfer (paper 1, 4.4.1):
// light about each of an object's light points from the VPLs that see it, as spherical harmonics in
// the object's own space, blended and multiplied at each vertex with its transfer.
//
// Kept from frame to frame as light maps are. Sums are fixed-point numbers: each coefficient of a
// VPL is rounded to a multiple of 2⁻²⁴ W/m² and added as a double, which is exact up to 2²⁹ W/m².
// Adding a VPL and taking it away restores the very same bits in any order.
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
    int mostPoints = 128;         // light points an object, kMostLightPoints at most
    float clampDistance = 0.0f;   // of ShadingParams [m]
    float mostError = 1.0f;       // of lightsToLeave(); from 1 on no light is left for its error
    size_t mostBytes = SIZE_MAX;  // held in all; objects that do not fit have no transfer
    bool operator==(const Options&) const = default;
  };

  explicit PrtLights(TransferCache cache = TransferCache()) : transfers_(std::move(cache)) {}

  // By slot.
  struct Lights {
    std::span<const shared::Vpl> vpls;  // as the database has them, with their intensities
    std::vector<bool> areUpToDate;      // shown with all that moved: others keep their shadows
    std::vector<bool> areLast;  // of the last bounce, which nothing reflects; empty: none of them
  };
  // Takes in what changed; after the database did, before its clearChanged(). Afterwards, when all
  // lights are up to date, irradiance is what would be made from nothing. `waits`: for transfer
  // that is not ready; else its objects are not lit by it until it is. Returns whether what shows
  // changed.
  bool update(const RenderScene& scene, const RenderSceneChanges& changes, const RayCaster& rays,
              const VisibilityDatabase& visibility, const Lights& lights, const Options& options,
              bool waits);

  // Whether pixels of an object's leaf patch begin with what is here: those on the front of its
  // triangles that are in no chart.
  bool covers(const ObjectPatches& patches, uint32_t object, int leaf) const {
    return objects_[object].transfer != nullptr &&
           patches.patches[static_cast<size_t>(leaf)].chart == kNone;
  }
  bool hasTransfer(uint32_t object) const { return objects_[object].transfer != nullptr; }
  // By object, whether its transfer has what its parts reflect onto each other.
  std::vector<uint8_t> reflecting() const;
  // Whether it is to have one, ready or not.
  bool wantsTransfer(uint32_t object) const { return objects_[object].isWanted; }
  // Whether the normal is on the front of the object's triangle.
  bool isFront(uint32_t object, uint32_t triangle, const vec3& normal) const;
  // Whether irradiance here holds the light in each slot; pixels sum the others: those that are too
  // near to be blended between light points, those that make hard shadows, and those of which
  // transfer would get too much wrong. Only for objects with transfer.
  std::span<const uint8_t> held(uint32_t object) const { return objects_[object].held; }
  // E at a point of a triangle of the object [W/m²].
  vec3 irradiance(uint32_t object, uint32_t triangle, const vec3& position) const;
  // At each vertex of the object; empty: it has no transfer (yet).
  std::span<const vec3> irradiance(uint32_t object) const { return objects_[object].irradiance; }

  // Objects with transfer and such as lack it, and what the former leave to pixels for its error:
  // all light, or some of it.
  struct Left {
    int objects = 0, wholly = 0;
    int lights = 0;       // over all objects but those
    int withoutRoom = 0;  // objects that have no transfer for want of memory
  };
  Left left() const;

  // What is held by all objects, transfer and light.
  size_t bytes() const;

  size_t objects() const { return objects_.size(); }
  const Revision& revision(uint32_t object) const { return objects_[object].revision; }
  const Revision& coverage() const { return coverage_; }  // of what covers() says

  Transfers::Progress progress() const { return transfers_.progress(); }
  // Since they were made: rays to VPLs, and those that the database spared.
  uint64_t rays() const { return raysTraced_; }
  uint64_t raysSpared() const { return raysSpared_; }
  // That a light which changes takes at most: one to each light point.
  uint64_t raysPerLight() const;

 private:
  // A light point: all r, then g, then b of the light that parts reflect; then the same of what
  // else comes straight: light that is not reflected, less such as is left to pixels.
  static constexpr size_t kSums = size_t{3} * kShCoefficients;
  // What an object has by transfer of the light in a slot. `own`: nothing, and pixels have nothing
  // of it either; `near`: nothing, for it is too near.
  enum class Take : uint8_t { own, near, left, straight, reflected, all };
  static bool mayTake(Take take) { return take >= Take::left; }
  static bool hasStraight(Take take) { return take == Take::straight || take == Take::all; }
  static bool hasReflected(Take take) { return take >= Take::reflected; }
  struct Object {
    PrtShape shape;
    bool isWanted = false;  // it may have transfer, and has room
    bool lacksRoom = false;
    TransferKey key{};
    std::shared_ptr<const RenderScene> own;  // until its transfer is there
    std::shared_ptr<const Transfer> transfer;
    OwnSpace space;
    IncidentLightPoints points;
    std::vector<vec3> places;  // of the points, in the world
    std::vector<ValidationPoint> checks;
    std::vector<double> sums;          // points × 2 · kSums
    std::vector<Take> takes;           // by slot, as summed
    std::vector<LightErrors> checked;  // by slot
    std::vector<uint8_t> hidden;       // slots × points, as summed
    std::vector<uint8_t> held;         // by slot
    std::vector<vec3> irradiance;      // by vertex
    Revision revision;
    int lightsLeft = 0;   // to pixels for their error
    bool isLeft = false;  // so that transfer has none
    size_t bytes = 0;     // of all that
    void countBytes();
    void dropTransfer() { *this = Object{.shape = std::move(shape)}; }
  };
  struct Frame;

  std::vector<uint32_t> reshape(const Frame& frame, std::span<const uint32_t> some);
  void findObjects(const Frame& frame, std::span<const uint32_t> others);
  std::vector<uint32_t> findRoom(const Frame& frame);
  void placeObject(const Frame& frame, uint32_t object);
  // At some slots: how each is taken but for hardness and error, and slots × points whether hidden.
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
  std::vector<shared::Vpl> lights_;  // by slot, as summed
  std::vector<bool> isHard_;         // by slot: its shadows are too hard for transfer
  std::vector<bool> areLast_;        // by slot
  std::vector<bool> isStale_;        // by slot: something moved since its shadows were found
  Revision coverage_;
  uint64_t raysTraced_ = 0, raysSpared_ = 0;
};

}  // namespace lamplighter
