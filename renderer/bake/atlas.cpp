#include "renderer/bake/atlas.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include <spdlog/fmt/fmt.h>
#include <tbb/parallel_for.h>

#include "renderer/bake/skyline.h"
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
  std::vector<PlacedChart> charts;
  float area = 0.0f;  // total area of their bounding rectangles [m²]
};

void setDensity(Group& group, float texelsPerMetre) {
  for (PlacedChart& c : group.charts) {
    c.texelsPerMetre = texelsPerMetre;
    // Rounds up to whole texels, with a tolerance; at least one.
    const vec2 texels = glm::ceil(texelsPerMetre * c.chart.extent() - 1e-3f);
    c.size = glm::ivec2(glm::max(texels, vec2(1.0f))) + 2 * kGutter;
  }
}

// Places the charts on the page, tall ones first. If they do not all fit, the page is unchanged.
bool place(Group& group, Skyline& page, int number) {
  Skyline tried = page;
  std::vector<size_t> order(group.charts.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return group.charts[a].size.y > group.charts[b].size.y;
  });
  for (const size_t i : order) {
    const std::optional<glm::ivec2> at = tried.place(group.charts[i].size);
    if (!at) return false;
    group.charts[i].at = *at;
    group.charts[i].page = number;
  }
  page = std::move(tried);
  return true;
}

std::vector<Group> groupsOf(const RenderScene& scene, float texelsPerMetre) {
  std::vector<std::vector<BakeChart>> charts(scene.objects.size());
  tbb::parallel_for(size_t{0}, scene.objects.size(), [&](size_t i) {
    if (isBaked(scene, scene.objects[i]))
      charts[i] = unwrap(scene, static_cast<uint32_t>(i), texelsPerMetre);
  });
  std::vector<Group> groups;
  for (size_t i = 0; i < charts.size(); ++i) {
    if (charts[i].empty()) continue;
    const NodeId node = scene.objects[i].node;
    if (groups.empty() || groups.back().node != node) groups.push_back({node, {}, 0.0f});
    for (BakeChart& c : charts[i]) {
      groups.back().area += c.extent().x * c.extent().y;
      groups.back().charts.push_back({std::move(c), 0, {}, {}, 1.0f});
    }
  }
  return groups;
}

}  // namespace

LightMapAtlas makeAtlas(const RenderScene& scene, const AtlasOptions& options) {
  LightMapAtlas atlas;
  atlas.pageSize = options.pageSize;
  std::vector<Group> groups = groupsOf(scene, options.texelsPerMetre);
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.area > b.area; });
  std::vector<Skyline> pages;
  for (Group& group : groups) {
    float density = options.texelsPerMetre;
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
    if (density < options.texelsPerMetre) atlas.coarser.push_back({group.node, density});
    for (PlacedChart& c : group.charts) atlas.charts.push_back(std::move(c));
  }
  atlas.pages = static_cast<int>(pages.size());
  std::stable_sort(
      atlas.charts.begin(), atlas.charts.end(),
      [](const PlacedChart& a, const PlacedChart& b) { return a.chart.object < b.chart.object; });
  return atlas;
}

}  // namespace lamplighter
