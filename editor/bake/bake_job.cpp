#include "editor/bake/bake_job.h"

#include <bit>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <tbb/parallel_for.h>

#include "editor/document/document.h"
#include "editor/document/write_file.h"
#include "renderer/bake/page_dilation.h"
#include "renderer/bake/second_uvs.h"
#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/frame/world.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {
namespace {

// Increase whenever the content of tiles changes.
constexpr uint64_t kBakeVersion = 1;

// Hash of everything that the tiles depend on.
uint64_t keyOfBake(const Scene& scene, const RenderScene& render, const BakeJobOptions& o) {
  uint64_t key = kHashStart;
  const auto add = [&](uint64_t value) { key = hashedWith(key, value); };
  const auto addAll = [&](const auto& values) {
    add(values.size());
    forEachWord(values, add);
  };
  add(sceneHash(scene));
  addAll(render.positions), addAll(render.normals), addAll(render.indices);
  addAll(render.uv0), addAll(render.uv1), addAll(render.colors);
  for (const Texture& t : render.textures) addAll(t.image->pixels);
  add(kBakeVersion);
  add(std::bit_cast<uint32_t>(o.atlas.texelsPerMetre));
  add(static_cast<uint64_t>(o.atlas.pageSize));
  add(static_cast<uint64_t>(o.light.method));
  if (o.light.method == BakeMethod::reference) {
    add(static_cast<uint64_t>(o.light.paths.bounces));
    add(o.light.paths.seed);
    add(static_cast<uint64_t>(o.light.samples));
    if (o.light.paths.glossyBounces) add(std::bit_cast<uint32_t>(o.light.paths.leastRoughness));
  } else {
    add(static_cast<uint64_t>(o.light.counts.total));
    add(std::bit_cast<uint32_t>(o.light.counts.directShare));
    add(static_cast<uint64_t>(o.light.counts.bounces));
    add(o.light.counts.seed);
    add(std::bit_cast<uint32_t>(o.light.clampDistance));
  }
  if (o.light.method == BakeMethod::meshes) {
    const SurfaceLightOptions& s = o.light.surface;
    for (const int number : {s.bounces, s.gatherRays, s.mask}) add(static_cast<uint64_t>(number));
    add(std::bit_cast<uint32_t>(s.edge));
    add(s.linkBytes);
    add(s.seed);
    add(static_cast<uint64_t>(s.projection));
  }
  if (o.light.method == BakeMethod::links) {
    const TexelRadiosityOptions& t = o.light.texels;
    for (const float number : {t.texel, t.linkError}) add(std::bit_cast<uint32_t>(number));
    for (const int number : {t.map.resolution, t.bounces, o.light.surface.mask})
      add(static_cast<uint64_t>(number));
    add(static_cast<uint64_t>(t.order));
    add(static_cast<uint64_t>(t.map.kind));
    add(static_cast<uint64_t>(t.visibility));
    add(t.memory);
    add(t.seed);
  }
  return key;
}

std::vector<BakedTexel> find(const BakeTile& tile, const BakedLight& light, int pageSize) {
  std::vector<std::span<const BakePoint>> texels;
  for (size_t first = 0; first < tile.points.size();) {
    size_t end = first + 1;
    while (end < tile.points.size() && tile.points[end].x == tile.points[first].x &&
           tile.points[end].y == tile.points[first].y)
      ++end;
    texels.push_back(std::span(tile.points).subspan(first, end - first));
    first = end;
  }
  std::vector<BakedTexel> found(texels.size());
  tbb::parallel_for(size_t{0}, texels.size(), [&](size_t i) {
    const BakePoint& p = texels[i].front();
    const auto side = static_cast<uint32_t>(pageSize);
    const uint32_t texel = (static_cast<uint32_t>(tile.page) * side + p.y) * side + p.x;
    found[i] = {p.x, p.y, light.irradiance(texels[i], texel)};
  });
  return found;
}

std::string pageName(const BakeJobOptions& o, int page) {
  return fmt::format("{}-light-{}.exr", o.name, page);
}

std::string visibilityName(const BakeJobOptions& o) { return o.name + "-visibility.bin"; }

void warnOfSide(const char* what, float side, float wanted, float unit, BakeReport& report) {
  if (side > wanted)
    report.warnings.push_back(fmt::format(
        "{} has texels of {:.3g} m: smaller ones do not fit into depth_memory", what, side * unit));
}

void writeVisibility(const Scene& scene, const RenderScene& render, const RayCaster& rays,
                     const BakeJobOptions& o, BakeReport& report) {
  const SurfaceVisibility visibility = findVisibility(render, rays, *o.visibility);
  warnOfSide("visibility", visibility.side, o.visibility->texel, render.unit, report);
  report.files.push_back(o.output / visibilityName(o));
  writeWhole(report.files.back(), visibilityFile(scene, render, visibility));
}

// Throws InputError if tiles are missing.
void writePages(const std::vector<BakeTile>& tiles, const BakeParts& parts, const BakeJobOptions& o,
                BakeReport& report) {
  std::vector<Image> pages(static_cast<size_t>(report.pages),
                           Image(o.atlas.pageSize, o.atlas.pageSize, vec3(-1.0f)));
  int missing = 0;
  const BakeTile* first = nullptr;
  for (const BakeTile& tile : tiles) {
    const auto texels = parts.read(tile);
    if (!texels) {
      if (missing++ == 0) first = &tile;
      continue;
    }
    for (const BakedTexel& t : *texels)
      pages[static_cast<size_t>(tile.page)].at(t.x, t.y) = t.irradiance;
  }
  if (missing > 0)
    throw InputError(o.output.string(),
                     fmt::format("{} of {} tiles are missing, the first is number {}", missing,
                                 tiles.size(), first->number),
                     "bake all shards of the same scene and settings into this folder first");
  for (int i = 0; i < report.pages; ++i) {
    fillUnknown(pages[static_cast<size_t>(i)]);
    report.files.push_back(o.output / pageName(o, i));
    writeExr(pages[static_cast<size_t>(i)], report.files.back());
  }
}

void writeScene(const Scene& scene, const RenderScene& render, const LightMapAtlas& atlas,
                const BakeJobOptions& o, BakeReport& report) {
  report.files.push_back(o.output / (o.name + ".gltf"));
  saveGltf(withLightMapUvs(scene, render, atlas), report.files.back());

  // Maps nodes to pages, because core glTF cannot store this.
  nlohmann::ordered_json j;
  j["scene"] = o.name + ".gltf";
  j["texCoord"] = 1;
  j["quantity"] = "irradiance, W/m2, linear Rec. 709; reflected radiance is albedo / pi times it";
  for (int i = 0; i < report.pages; ++i) j["pages"].push_back(pageName(o, i));
  if (o.visibility) j["visibility"] = visibilityName(o);
  NodeId last = kNoNode;
  for (const ObjectChart& c : atlas.charts) {
    const NodeId id = render.objects[c.object].node;
    if (id == last) continue;
    last = id;
    j["nodes"].push_back({{"name", scene.find(id)->name},
                          {"page", c.page},
                          {"texels_per_metre", c.texelsPerMetre / render.unit}});
  }
  report.files.push_back(o.output / (o.name + "-light.json"));
  writeFile(report.files.back(), j.dump(2) + "\n");
}

}  // namespace

BakeReport bake(const Scene& scene, const BakeJobOptions& o, const BakeProgress& progress) {
  World world;
  world.update(scene, SceneChanges::all());
  const RenderScene& render = world.scene();
  const LightMapAtlas atlas = makeAtlas(render, o.atlas);
  if (atlas.charts.empty())
    throw InputError(o.name, "has no surface that can have a light map",
                     "give a scene with meshes");
  BakeReport report;
  report.pages = atlas.pages;
  for (const LightMapAtlas::Coarser& c : atlas.coarser)
    report.warnings.push_back(
        fmt::format("\"{}\" has only {:.3g} texels per metre: more do not fit on a page",
                    scene.find(c.node)->name, c.texelsPerMetre));
  // Checks before the long computation that its last step will work.
  if (o.shard == 0) withLightMapUvs(scene, render, atlas);

  const std::vector<BakeTile> tiles = bakeTiles(render, atlas);
  const BakeParts parts(o.output, keyOfBake(scene, render, o));
  report.tiles = static_cast<int>(tiles.size());
  if (!o.mergeOnly) {
    std::vector<const BakeTile*> open;
    for (const BakeTile& tile : tiles) {
      if (o.shard > 0 && tile.number % o.shards != o.shard - 1) continue;
      parts.has(tile) ? void(++report.taken) : open.push_back(&tile);
    }
    const BakedLight light(render, *world.rays(), o.light);
    warnOfSide("bounced light", light.texelSide(), o.light.texels.texel, render.unit, report);
    for (const BakeTile* tile : open) {
      parts.write(*tile, find(*tile, light, o.atlas.pageSize));
      ++report.found;
      if (progress && !progress(report.found, static_cast<int>(open.size())) &&
          report.found < static_cast<int>(open.size())) {
        report.isCancelled = true;
        return report;
      }
    }
  }
  if (o.shard > 0) return report;
  writePages(tiles, parts, o, report);
  if (o.visibility) writeVisibility(scene, render, *world.rays(), o, report);
  writeScene(scene, render, atlas, o, report);
  if (!o.keepParts) parts.remove();
  report.isWhole = true;
  return report;
}

}  // namespace lamplighter
