#include "tests/tools/equality/comparison.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include <spdlog/fmt/fmt.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/methods/many_lights/parameters.h"
#include "tests/support/traced_shadows.h"

namespace lamplighter::equality {
namespace {

constexpr int kWidth = 320, kHeight = 200;
constexpr int kMapMemory = 2048;  // [MiB], enough for a map of each VPL

struct NamedView {
  std::string name;
  View view;
};

std::vector<NamedView> viewsOf(const Scene& scene) {
  std::vector<NamedView> views;
  for (const Node& node : scene.nodes) {
    if (node.camera == kNone) continue;
    const std::string name = node.name.empty() ? scene.cameras[node.camera].name : node.name;
    views.push_back({name.empty() ? "camera" : name, viewOfCamera(scene, node, kWidth, kHeight)});
  }
  RenderScene render;
  update(render, scene, SceneChanges::all());
  views.push_back({"all of it", viewOfBounds(render.bounds, kWidth, kHeight)});
  return views;
}

struct Picture {
  Image image;
  std::vector<shared::Vpl> lights;
};

// Renders a scene on one backend.
class Renderer {
 public:
  Renderer(const std::string& backend, const Scene& scene)
      : scene_(scene), frames_(backend == "cpu" ? makeCpuBackend() : makeGlBackend()) {}

  Picture settled(const View& view, const Settings& settings) {
    GiOutput out;
    do {
      out = frames_.render({scene_, changes_, view, "many_lights", settings});
      changes_ = SceneChanges();
    } while (!out.settled);
    if (out.stats.of("maps_without_room") > 0 || out.stats.of("visibility_bytes_needed") > 0)
      throw std::runtime_error("too little memory for the technique that is asked for");
    return {out.radiance->pixels(), test::shownLights(frames_.inspect())};
  }
  // The last picture with ray-traced shadows and the same VPLs. `known`: traces rays only where the
  // visibility database has no answer.
  Image withRays(const View& view, const Settings& settings, bool known) const {
    const Inspection last = frames_.inspect();
    return test::withTracedShadows(frames_.scene(), *frames_.rays(), test::shownLights(last), view,
                                   settings, known ? last.patches.get() : nullptr);
  }

 private:
  const Scene& scene_;
  SceneChanges changes_ = SceneChanges::all();
  FrameRenderer frames_;
};

bool sameLights(const std::vector<shared::Vpl>& a, const std::vector<shared::Vpl>& b) {
  return std::ranges::equal(a, b, [](const shared::Vpl& x, const shared::Vpl& y) {
    return x.position == y.position && x.normal == y.normal && x.tangent == y.tangent &&
           x.intensity == y.intensity;
  });
}

}  // namespace

Settings naiveSettings(int resolution, int vpls) {
  Settings s;
  s.set("technique", std::string("naive"));
  const int coarse = ManyLightsParameters().mapResolution;
  const bool isMultiple = resolution % coarse == 0;
  s.set("map_resolution", isMultiple ? coarse : resolution);
  s.set("settled_map_scale", isMultiple ? resolution / coarse : 1);
  s.set("map_memory", kMapMemory);
  s.set("vpls", vpls);
  s.set("updates", 65536);
  s.set("antialias", 1);
  s.set("indirect", std::string("samples"));
  s.set("share_memory", 0);  // shares are summed without light maps, whatever the technique
  // Both would compute it with rays. It would only increase the mean and so decrease the relative
  // errors.
  s.set("bias_compensation", false);
  return s;
}

Compared compare(const std::string& name, const Scene& scene, int vpls,
                 const std::vector<Column>& columns, double limit,
                 const std::filesystem::path& folder) {
  const std::vector<NamedView> views = viewsOf(scene);
  Compared result;
  for (const NamedView& v : views) result.rows.push_back({v.name, {}});
  std::map<std::string, Renderer> renderers;
  std::map<std::pair<std::string, int>, std::vector<Picture>> naive;  // then by view
  std::vector<std::optional<Image>> rays(views.size());
  for (const Column& column : columns) {
    Renderer& renderer = renderers.try_emplace(column.backend, column.backend, scene).first->second;
    std::vector<Picture>& expected = naive[{column.backend, column.resolution}];
    for (size_t v = expected.size(); v < views.size(); ++v)
      expected.push_back(renderer.settled(views[v].view, naiveSettings(column.resolution, vpls)));
    for (size_t v = 0; v < views.size(); ++v) {
      const View& view = views[v].view;
      const Picture& truth = expected[v];
      const Picture picture = renderer.settled(view, column.settings);
      if (!sameLights(picture.lights, truth.lights))
        throw std::runtime_error(name + ": " + column.name + " has other VPLs than naive");
      const double error = compareImages(picture.image, truth.image).relRmse;
      result.rows[v].errors.push_back(error);
      if (error < limit) continue;
      if (!rays[v]) rays[v] = renderer.withRays(view, column.settings, false);
      const Image known = renderer.withRays(view, column.settings, true);
      result.over.push_back(
          {name, views[v].name, column, error, compareImages(truth.image, *rays[v]).relRmse,
           compareImages(picture.image, *rays[v]).relRmse, compareImages(known, *rays[v]).relRmse});
      if (folder.empty()) continue;
      const std::string stem =
          fmt::format("{}.{}.{}.{}.", name, views[v].name, column.backend, column.resolution);
      writeExr(picture.image, folder / (stem + column.name + ".exr"));
      writeExr(truth.image, folder / (stem + "naive.exr"));
      writeExr(*rays[v], folder / (stem + "rays.exr"));
    }
  }
  return result;
}

}  // namespace lamplighter::equality
