#include "renderer/bake/visibility_file.h"

#include <map>
#include <string>

#include "renderer/base/byte_stream.h"
#include "renderer/base/hash.h"

namespace lamplighter {
namespace {

constexpr char kVisibilityMagic[8] = {'L', 'A', 'M', 'P', 'V', 'I', 'S', '\0'};
// Increase it whenever the format changes.
constexpr uint32_t kVisibilityVersion = 1;
// Flags of a texel.
constexpr uint32_t kOnBack = 1, kInside = 2;
constexpr uint64_t kRaysOfDepths = uint64_t{1} << 24;

template <typename T>
void put(std::vector<uint8_t>& bytes, const T& value) {
  append(bytes, &value, 1);
}

void putName(std::vector<uint8_t>& bytes, const std::string& name) {
  put(bytes, static_cast<uint32_t>(name.size()));
  append(bytes, name.data(), name.size());
}

void putRun(std::vector<uint8_t>& bytes, const SurfaceDepths::Run& run) {
  put(bytes, run.first);
  put(bytes, run.count);
  // A pixel has 1 to 256 segments.
  for (size_t q = 0; q + 1 < run.starts.size(); ++q)
    put(bytes, static_cast<uint8_t>(run.starts[q + 1] - run.starts[q] - 1));
  append(bytes, run.segments.values.data(), run.segments.values.size());
  append(bytes, run.segments.last.data(), run.segments.last.size());
}

}  // namespace

SurfaceVisibility findVisibility(const RenderScene& scene, const RayCaster& rays,
                                 const TexelRadiosityOptions& options) {
  SurfaceVisibility out;
  out.side = texelSideOf(scene, options);
  ObjectCharts charts{std::filesystem::path()};
  out.texels = TexelSet(scene, charts.find(scene, 1.0f / out.side), options.order);
  out.texels.findBuried(scene, rays);
  out.depths.restart(scene, out.texels, options.map);
  while (!out.depths.isDone()) out.depths.goOn(scene, rays, out.texels, kRaysOfDepths);
  return out;
}

std::vector<uint8_t> visibilityFile(const Scene& scene, const RenderScene& render,
                                    const SurfaceVisibility& visibility) {
  const TexelSet& texels = visibility.texels;
  const SurfaceDepths& depths = visibility.depths;
  std::map<NodeId, uint32_t> numbers;
  std::vector<uint8_t> nodes, places;
  for (uint32_t object = 0; object < render.objects.size(); ++object) {
    for (uint32_t back = 0; back < 2; ++back) {
      const TexelSet::Part& part = texels.parts()[2 * object + back];
      if (part.count == 0) continue;
      const NodeId id = render.objects[object].node;
      const auto [node, isNew] = numbers.emplace(id, static_cast<uint32_t>(numbers.size()));
      if (isNew) putName(nodes, scene.find(id)->name);
      for (size_t t = part.first; t < part.first + part.count; ++t) {
        put(places, render.unit * texels[t].spot.rayOrigin());
        put(places, texels[t].spot.geometricNormal);
        put(places, render.unit * render.unit * texels[t].area);
        put(places, node->second);
        put(places, (back == 1 ? kOnBack : 0u) | (texels.isBuried(t) ? kInside : 0u));
      }
    }
  }
  std::vector<uint8_t> content;
  put(content, kVisibilityVersion);
  put(content, depths.layout().kind == DepthMapKind::cube ? 6u : 1u);
  put(content, static_cast<uint32_t>(depths.layout().resolution));
  put(content, static_cast<uint32_t>(numbers.size()));
  put(content, static_cast<uint32_t>(texels.size()));
  put(content, static_cast<uint32_t>(depths.runs().size()));
  put(content, 0u);
  put(content, depths.steps() / render.unit);
  content.insert(content.end(), nodes.begin(), nodes.end());
  content.insert(content.end(), places.begin(), places.end());
  for (const SurfaceDepths::Run& run : depths.runs()) putRun(content, run);
  std::vector<uint8_t> bytes;
  append(bytes, kVisibilityMagic, sizeof kVisibilityMagic);
  put(bytes, hashOfBytes(content));
  bytes.insert(bytes.end(), content.begin(), content.end());
  return bytes;
}

}  // namespace lamplighter
