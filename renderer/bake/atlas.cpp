#include "renderer/bake/atlas.h"

#include <algorithm>
#include <span>

#include <spdlog/fmt/fmt.h>
#include <tbb/parallel_for.h>

#include "renderer/base/error.h"

namespace lamplighter {
namespace {

constexpr float kCoarser = 0.70710678f;
constexpr float kLeastTexelsPerMetre = 1e-3f;

bool isBaked(const RenderScene& scene, const RenderObject& o) {
  return !o.isAreaLight && !scene.materials[static_cast<size_t>(o.material)].isClear();
}

// The charts of one node, before they are placed on a page.
struct Group {
  NodeId node = kNoNode;
  std::vector<ObjectChart> charts;
  float area = 0.0f;  // total area of their bounding rectangles [m²]
};

void setDensity(Group& group, float texelsPerMetre) {
  for (ObjectChart& c : group.charts) lamplighter::setDensity(c, texelsPerMetre);
}

// If the charts do not all fit, the page is unchanged.
bool place(Group& group, Skyline& page, int number) {
  std::vector<PlacedChart*> charts;
  for (ObjectChart& c : group.charts) {
    charts.push_back(&c);
    c.page = number;
  }
  return placeOn(page, charts);
}

std::vector<Group> groupsOf(const RenderScene& scene, float texelsPerMetre) {
  std::vector<std::vector<MeshChart>> charts(scene.objects.size());
  tbb::parallel_for(size_t{0}, scene.objects.size(), [&](size_t i) {
    const RenderObject& o = scene.objects[i];
    if (isBaked(scene, o))
      charts[i] =
          unwrap(scene.positions, std::span(scene.indices).subspan(o.firstIndex, o.indexCount),
                 texelsPerMetre);
  });
  std::vector<Group> groups;
  for (size_t i = 0; i < charts.size(); ++i) {
    if (charts[i].empty()) continue;
    const NodeId node = scene.objects[i].node;
    if (groups.empty() || groups.back().node != node) groups.push_back({node, {}, 0.0f});
    for (MeshChart& c : charts[i]) {
      groups.back().area += c.extent().x * c.extent().y;
      ObjectChart& placed = groups.back().charts.emplace_back();
      placed.chart = std::move(c);
      placed.object = static_cast<uint32_t>(i);
    }
  }
  return groups;
}

}  // namespace

LightMapAtlas makeAtlas(const RenderScene& scene, const AtlasOptions& options) {
  LightMapAtlas atlas;
  atlas.pageSize = options.pageSize;
  const float wanted = options.texelsPerMetre * scene.unit;  // [texels per unit]
  std::vector<Group> groups = groupsOf(scene, wanted);
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.area > b.area; });
  std::vector<Skyline> pages;
  for (Group& group : groups) {
    float density = wanted;
    setDensity(group, density);
    bool isPlaced = false;
    for (size_t i = 0; i < pages.size() && !isPlaced; ++i)
      isPlaced = place(group, pages[i], static_cast<int>(i));
    while (!isPlaced) {
      Skyline fresh(options.pageSize);
      isPlaced = place(group, fresh, static_cast<int>(pages.size()));
      if (isPlaced) {
        pages.push_back(std::move(fresh));
      } else if ((density *= kCoarser) < kLeastTexelsPerMetre) {
        throw InputError("--page",
                         fmt::format("the {} parts of one object do not fit on a page of {} texels",
                                     group.charts.size(), options.pageSize),
                         "give a larger page");
      } else {
        setDensity(group, density);
      }
    }
    if (density < wanted) atlas.coarser.push_back({group.node, density / scene.unit});
    for (ObjectChart& c : group.charts) atlas.charts.push_back(std::move(c));
  }
  atlas.pages = static_cast<int>(pages.size());
  std::stable_sort(atlas.charts.begin(), atlas.charts.end(),
                   [](const ObjectChart& a, const ObjectChart& b) { return a.object < b.object; });
  return atlas;
}

}  // namespace lamplighter
