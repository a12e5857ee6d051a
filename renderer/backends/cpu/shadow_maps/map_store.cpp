#include "renderer/backends/cpu/shadow_maps/map_store.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <string>

#include <tbb/parallel_for.h>

#include "renderer/base/error.h"

namespace lamplighter::cpu {
namespace {

// Rows per task. Per-map preparation is repeated for each task.
constexpr int kRowsPerTask = 2 * ShadowRaster::kBand;
// The smallest number of moves that are remembered, and the largest number of moved objects for
// which only a part of a map is rendered.
constexpr ptrdiff_t kMostMoves = 1024;
constexpr size_t kMostMoved = 16;

bool isAtPlaceOf(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent;
}

}  // namespace

bool MapStore::reserve(int slots, const MapRoom& coarse, const MapRoom& fine) {
  if (static_cast<size_t>(slots) == maps_.size() && of(MapSize::coarse).room == coarse &&
      of(MapSize::fine).room == fine)
    return false;
  maps_.clear();
  maps_.resize(static_cast<size_t>(slots));
  for (const MapSize size : {MapSize::coarse, MapSize::fine}) {
    const MapRoom& room = size == MapSize::coarse ? coarse : fine;
    if (of(size).resolution() != room.resolution) of(size).grid = ShadowMapGrid(room.resolution);
    of(size).room = room;
    const auto side = static_cast<size_t>(room.resolution);
    of(size).memory = MapMemory(side * side, static_cast<size_t>(room.maps));
  }
  return true;
}

void MapStore::make(Map& map, MapSize size) {
  drop(map);
  Size& s = of(size);
  try {
    map.texels = s.memory.take();
    map.isTraced.assign(static_cast<size_t>(s.resolution() / ShadowRaster::kBand + 1), 0);
  } catch (const std::bad_alloc&) {
    throw InputError(
        "many_lights",
        "no memory for another shadow map of " + std::to_string(s.resolution()) + "² texels",
        "lower map_memory or map_resolution");
  }
  map.size = size;
}

void MapStore::castersChange() {
  castersChanged_ = true;
  movedSince_.clear();
  moves_.clear();
  for (Map& map : maps_) map.moves.reset();
}

void MapStore::castersMove(const RenderScene& scene, const RenderSceneChanges& changes) {
  for (size_t i = 0; i < changes.movedObjects.size(); ++i) {
    const uint32_t object = changes.movedObjects[i];
    moves_.push_back({object, changes.movedBounds[i], scene.objects[object].bounds});
    movedSince_.push_back(object);
  }
  moveCount_ += changes.movedObjects.size();
  if (moves_.size() > 2 * kMostMoves) moves_.erase(moves_.begin(), moves_.end() - kMostMoves);
}

// The blocks whose content may have changed; empty if all may have.
std::vector<uint8_t> MapStore::outdated(const Map& map) const {
  if (!map.moves || moveCount_ - *map.moves > moves_.size()) return {};
  struct ObjectMotion {
    uint32_t object;
    const Bounds *from, *to;
  };
  std::vector<ObjectMotion> ways;  // since the map was rendered
  for (size_t i = moves_.size() - (moveCount_ - *map.moves); i < moves_.size(); ++i) {
    const Move& move = moves_[i];
    const auto way = std::ranges::find(ways, move.object, &ObjectMotion::object);
    if (way != ways.end())
      way->to = &move.after;
    else if (ways.size() < kMostMoved)
      ways.push_back({move.object, &move.before, &move.after});
    else
      return {};
  }
  std::vector<Sphere> spheres;
  for (const ObjectMotion& way : ways)
    for (const Bounds* box : {way.from, way.to})
      if (!box->empty()) spheres.push_back({box->centre(), box->radius()});
  return raster_.blocksThatSee(of(map.size).grid, map.light, spheres);
}

uint64_t MapStore::render(const RenderScene& scene, const RayCaster& rays,
                          std::span<const shared::Vpl> lights, MapSize size,
                          std::span<ShadowMapDiff> changes) {
  if (castersChanged_ || !movedSince_.empty()) {
    // If it draws now, or no longer, what is not traced may differ in rounding.
    const bool drew = raster_.isUseful();
    raster_.setScene(scene, castersChanged_ ? nullptr : &movedSince_);
    if (raster_.isUseful() != drew)
      for (Map& map : maps_) map.moves.reset();
  }
  castersChanged_ = false;
  movedSince_.clear();
  std::vector<bool> isNew;
  const auto mapOf = [&](const shared::Vpl& light) -> Map& {
    return maps_[static_cast<size_t>(light.slot)];
  };
  for (const shared::Vpl& light : lights) {
    Map& map = mapOf(light);
    const bool isThere = map.texels != nullptr && map.size == size;
    isNew.push_back(!isThere || !isAtPlaceOf(light, map.light));
    if (!isThere) make(map, size);
  }
  std::atomic<uint64_t> cast = 0;
  tbb::parallel_for(size_t{0}, lights.size(), [&](size_t i) {
    cast += render(rays, lights[i], isNew[i], mapOf(lights[i]), changes[i]);
  });
  return cast;
}

uint64_t MapStore::render(const RayCaster& rays, const shared::Vpl& light, bool isNew, Map& map,
                          ShadowMapDiff& change) {
  const std::span<float> texels = texelsOf(map);
  std::vector<float> before;
  std::vector<uint8_t> wanted;
  if (!isNew) {
    before.assign(texels.begin(), texels.end());
    wanted = outdated(map);
  }
  map.light = light;
  map.moves = moveCount_;
  std::atomic<uint64_t> cast = 0;
  const int resolution = of(map.size).resolution();
  const int tasks = (resolution + kRowsPerTask - 1) / kRowsPerTask;
  tbb::parallel_for(0, tasks, [&](int task) {
    const int first = task * kRowsPerTask, last = std::min(first + kRowsPerTask, resolution);
    cast +=
        raster_.render(rays, of(map.size).grid, light, first, last, texels, wanted, map.isTraced);
  });
  change = isNew ? ShadowMapDiff()
                 : diffShadowMaps(before, texels, resolution,
                                  light.position.w == shared::kVplDirectional);
  return cast;
}

void MapStore::drop(int slot) { drop(maps_[static_cast<size_t>(slot)]); }

void MapStore::drop(Map& map) {
  if (map.texels == nullptr) return;
  of(map.size).memory.giveBack(map.texels);
  map = {};
}

}  // namespace lamplighter::cpu
