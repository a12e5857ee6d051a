#include "editor/explain/light_senders.h"

#include <algorithm>
#include <map>
#include <span>

#include "renderer/registry/registry.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Surfaces that are searched for the one of the point.
constexpr int kMostHits = 8;
// Range of the search on both sides of the point, as a multiple of the offset of rays.
constexpr float kSearch = 16.0f;

using Place = LightSender::Place;

// Consecutive places that are near each other.
struct PlaceGroup {
  size_t begin = 0, end = 0;
  vec3 light{0.0f};
};

PlaceGroup groupOf(std::span<const Place> places, size_t begin, size_t end) {
  PlaceGroup group{begin, end, vec3(0.0f)};
  for (size_t i = begin; i < end; ++i) group.light += places[i].light;
  return group;
}

// Puts the places of a group in two halves of its box, along the longest side. Returns where the
// second one begins.
size_t divided(std::span<Place> places, const PlaceGroup& group) {
  Bounds box;
  const auto own = places.subspan(group.begin, group.end - group.begin);
  for (const Place& p : own) box.add(p.position);
  const vec3 size = box.extent();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const float middle = box.centre()[axis];
  const auto second = std::stable_partition(
      own.begin(), own.end(), [&](const Place& p) { return p.position[axis] < middle; });
  const auto count = static_cast<size_t>(second - own.begin());
  return group.begin + (count == 0 || count == own.size() ? own.size() / 2 : count);
}

// Up to `most` groups of places that are near each other, with about as much light each, strongest
// first. A group is where its strongest place is.
std::vector<Place> gathered(std::vector<Place> places, size_t most) {
  std::vector<PlaceGroup> groups{groupOf(places, 0, places.size())};
  const auto weight = [](const PlaceGroup& g) {
    return g.end - g.begin > 1 ? luminance(g.light) : 0.0f;
  };
  while (groups.size() < most) {
    const auto largest = std::ranges::max_element(groups, {}, weight);
    if (!(weight(*largest) > 0.0f)) break;
    const PlaceGroup whole = *largest;
    const size_t middle = divided(places, whole);
    *largest = groupOf(places, whole.begin, middle);
    groups.push_back(groupOf(places, middle, whole.end));
  }
  std::vector<Place> out;
  for (const PlaceGroup& g : groups) {
    if (g.begin == g.end) continue;
    const auto own = std::span(places).subspan(g.begin, g.end - g.begin);
    out.push_back(*std::ranges::max_element(own, {}, &Place::irradiance));
    out.back().light = g.light;
  }
  std::ranges::stable_sort(out, std::ranges::greater(), &Place::irradiance);
  return out;
}

// Sums what links bring, and keeps their places.
struct SenderSum {
  vec3 light{0.0f};
  std::vector<Place> places;

  void add(const InspectedLink& link) {
    light += link.irradiance;
    places.push_back({link.to, link.size, link.irradiance});
  }
  void add(const SenderSum& other) {
    light += other.light;
    places.insert(places.end(), other.places.begin(), other.places.end());
  }
  void finish(LightSender& out) {
    out.irradiance = luminance(light);
    out.colour = light / std::max({light.r, light.g, light.b, 1e-30f});
    out.places = gathered(std::move(places), LightSender::kMostPlaces);
  }
};

std::string nameOfNode(const Scene& scene, NodeId id) {
  const Node* node = scene.find(id);
  return node == nullptr || node->name.empty() ? "(unnamed)" : node->name;
}

}  // namespace

std::optional<InspectedPlace> placeOf(const RenderScene& world, const RayCaster& rays,
                                      const PickedPoint& point) {
  const float reach = kSearch * rayEpsilon(point.position);
  Ray ray{point.position + reach * point.geometricNormal, 0.0f, -point.geometricNormal,
          2.0f * reach};
  for (int i = 0; i < kMostHits; ++i) {
    const Hit hit = rays.intersect(ray);
    if (!hit) return std::nullopt;
    if (world.objects[hit.object].node == point.node)
      return InspectedPlace{hit.object,
                            hit.triangle,
                            isOnBack(world, hit, ray.direction),
                            {hit.u, hit.v},
                            surfaceAt(world, hit.object, hit.triangle, hit.u, hit.v).position};
    ray.tNear = hit.t + 0.1f * rayEpsilon(point.position);
  }
  return std::nullopt;
}

LightSenders lightSenders(const Scene& scene, const RenderScene& world, const RayCaster& rays,
                          const Inspection& inspection, const PickedPoint& point) {
  LightSenders out;
  out.all.name = "all surfaces";
  if (!inspection.links) {
    out.problem = "the method does not show it";
    out.remedy = "choose " + methodsThatShow(Capability::links);
    return out;
  }
  const auto place = placeOf(world, rays, inUnits(point, world.unit));
  const auto links = place ? inspection.links(*place) : std::vector<InspectedLink>();
  if (!links) {
    out.problem = "links are being found";
    out.remedy = "wait until the picture is settled";
    return out;
  }
  std::map<SenderKey, SenderSum> sums;
  SenderSum all;
  for (const InspectedLink& link : *links) {
    const RenderObject& o = world.objects[link.object];
    sums[{o.node, o.material}].add(link);
    all.add(link);
  }
  all.finish(out.all);
  out.irradiance = out.all.irradiance;
  std::vector<std::pair<SenderKey, SenderSum*>> order;
  for (auto& [key, sum] : sums) order.emplace_back(key, &sum);
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [](const auto& row) { return luminance(row.second->light); });
  size_t own = 0;
  while (own < std::min(order.size(), LightSenders::kMostRows) &&
         luminance(order[own].second->light) >= LightSenders::kLeastShare * out.irradiance)
    ++own;
  for (size_t i = 0; i < own; ++i) {
    LightSender& row = out.rows.emplace_back();
    row.key = order[i].first;
    row.name = nameOfNode(scene, row.key.node);
    row.material = world.materials[static_cast<size_t>(row.key.material)].name;
    order[i].second->finish(row);
  }
  SenderSum others;
  for (size_t i = own; i < order.size(); ++i) others.add(*order[i].second);
  if (luminance(others.light) < LightSenders::kLeastShare * out.irradiance) return out;
  const size_t count = order.size() - own;
  LightSender& row = out.rows.emplace_back();
  row.name = std::to_string(count) + (count == 1 ? " other" : " others");
  others.finish(row);
  return out;
}

}  // namespace lamplighter
