#include <new>

#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/gltf/gltf_source.h"

namespace lamplighter {

namespace {

// Limit of the number of triangles. RenderScene copies vertices for every instance, so a small file
// could claim any number.
constexpr size_t kMostTriangles = 100'000'000;

void checkSize(const GltfDocument& document, const Scene& scene) {
  std::vector<size_t> triangles;
  for (const auto& mesh : scene.meshes) {
    size_t count = 0;
    for (const Primitive& p : mesh->primitives) count += p.indices.size() / 3;
    triangles.push_back(count);
  }
  size_t total = 0;
  for (const Node& node : scene.nodes) {
    if (node.mesh != kNone) total += triangles[static_cast<size_t>(node.mesh)];
    if (total > kMostTriangles) {
      document.fail("shows more than 100 million triangles, including instances",
                    "split the level, or reduce its meshes");
    }
  }
}

LoadedScene loadScene(const std::filesystem::path& path, const LoadProgress& progress) {
  const auto report = [&](float done, const char* what) {
    if (progress && !progress(done, what)) throw InputError("cancelled");
  };
  report(0.0f, "reading");
  auto source = std::make_shared<SceneSource>();
  source->document = readGltfJson(path);
  GltfDocument& document = source->document;
  checkVersionAndExtensions(document);
  checkStructure(document);
  stripSphereMeshes(document);
  decodeModel(document);

  LoadedScene loaded;
  Scene& scene = loaded.scene;
  report(0.2f, "meshes");
  scene.meshes = readMeshes(document);
  scene.materials = readMaterials(document);
  scene.cameras = readCameras(document);
  warnOfUnknownLights(document);
  scene.nodes = readNodes(document);
  readLightNotes(document, scene.nodes);
  readSceneLightNotes(document, scene);
  scene.bookmarks = readBookmarks(document);
  scene.nextId = static_cast<NodeId>(scene.nodes.size() + 1);
  checkSize(document, scene);
  scene.name = sceneName(document);
  report(0.4f, "textures");
  scene.textures = readTextures(document, scene.materials, progress);

  const std::optional<Sky> sky = readSky(document);
  if (sky) {
    scene.sky = *sky;
  } else if (!hasLight(scene)) {
    scene.sky = kDefaultSky;
    scene.skyIsDefault = true;
    document.warn("has no light; it is shown under a uniform sky, which is not saved");
  }
  source->meshes = scene.meshes;
  source->textures = scene.textures;
  source->nodes = scene.nodes;
  source->sky = scene.sky;
  source->skyIsDefault = scene.skyIsDefault;
  source->skyLight = scene.skyLight;
  source->lightGroups = scene.lightGroups;
  source->bookmarks = scene.bookmarks;
  for (const Json& name : listOf(document, "extensionsUsed")) {
    if (name.is_string()) loaded.extensions.push_back(printable(name.get<std::string>()));
  }
  loaded.warnings = std::move(document.warnings);
  document.warnings.clear();
  scene.source = std::move(source);
  report(1.0f, "done");
  return loaded;
}

}  // namespace

LoadedScene loadGltf(const std::filesystem::path& path, const LoadProgress& progress) {
  try {
    return loadScene(path, progress);
  } catch (const Json::exception& e) {
    // Errors that the checks missed: a member of an unexpected type.
    throw InputError(path.string(), "is not valid glTF (" + printable(e.what()) + ")",
                     kExportAgain);
  } catch (const std::bad_alloc&) {
    throw InputError(path.string(), "needs more memory than is available", "split the level");
  } catch (const std::length_error&) {
    throw InputError(path.string(), "needs more memory than is available", "split the level");
  }
}

}  // namespace lamplighter
