// The acceleration structures of a RayCaster.
#pragma once

#include <string>
#include <vector>

#include <embree3/rtcore.h>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// An error that Embree reported.
struct EmbreeError {
  RTCError code = RTC_ERROR_NONE;
  std::string text;
};

// One geometry per object, with the object's index as its id, in two Embree scenes. The first has
// one tree over all triangles, built with medium quality (surface area heuristic); it accepts
// packets flagged as coherent. The second is small: a tree of trees for objects that moved or were
// added since then, which is updated quickly. If the first scene can be rebuilt quickly, moved and
// removed objects are removed from it; otherwise a filter ignores them there. The hits do not
// depend on the scene in which an object is.
//
// Embree 3.13 does not return from coherent packets in a tree of trees.
class EmbreeScenes {
 public:
  // Keeps a reference. Throws like RayCaster.
  explicit EmbreeScenes(const RenderScene& scene);
  ~EmbreeScenes();
  EmbreeScenes(const EmbreeScenes&) = delete;
  EmbreeScenes& operator=(const EmbreeScenes&) = delete;

  void build();
  void update(const RenderSceneChanges& changes);

  RTCScene still() const { return still_; }
  RTCScene moving() const { return moving_; }
  bool hasMovers() const { return !movers_.empty(); }           // objects in moving()
  const Bounds& movingBounds() const { return movingBounds_; }  // of the movers, slightly enlarged
  // Whether hits in still() must be tested with isInStill().
  bool mustFilterStill() const { return toIgnore_ > 0 && !isQuicklyBuilt_; }
  bool isInStill(uint32_t object) const { return places_[object] == Place::inStill; }

 private:
  enum class Place : uint8_t { nowhere, inStill, inMoving };
  enum class InStill : uint8_t { no, opaque, masked };
  struct Passing {
    bool isThere = false, isClear = false, isMasked = false;
    bool operator==(const Passing&) const = default;
  };

  void release();
  void check();
  void commit(RTCScene embree);
  Passing passingOf(uint32_t object) const;
  bool mayHit(uint32_t object) const {
    return passing_[object].isThere && !passing_[object].isClear;
  }
  InStill inStillAs(uint32_t object) const {
    return passing_[object].isMasked ? InStill::masked : InStill::opaque;
  }
  void copyVertices(RTCGeometry geometry, const RenderObject& o) const;
  void copyIndices(RTCGeometry geometry, const RenderObject& o) const;
  void add(RTCScene embree, uint32_t object);
  bool shouldJoin(const std::vector<uint32_t>& moved) const;
  bool move(uint32_t object);
  void leave(uint32_t object);
  bool isAsInStill(uint32_t object) const;

  const RenderScene& scene_;
  EmbreeError error_;  // the first one since check()
  RTCDevice device_ = nullptr;
  RTCScene still_ = nullptr, moving_ = nullptr;
  // By object.
  std::vector<Place> places_;
  std::vector<InStill> inStill_;  // its state in still_, possibly at an old position
  std::vector<Passing> passing_;  // when it was added
  std::vector<uint32_t> movers_;
  Bounds movingBounds_;
  size_t toIgnore_ = 0;          // objects of still_ that moved or were removed: rays ignore them
  bool isQuicklyBuilt_ = false;  // still_
};

}  // namespace lamplighter
