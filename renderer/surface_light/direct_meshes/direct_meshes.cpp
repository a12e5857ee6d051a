#include "renderer/surface_light/direct_meshes/direct_meshes.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/sampling/path_tracing.h"
#include "renderer/surface_light/between.h"

namespace lamplighter {
namespace {

// Maximum number of descents per frame: each needs the light that the last one requested.
constexpr size_t kDescents = 8;

}  // namespace

void DirectMeshes::update(const RenderScene& scene, const RenderSceneChanges& changes,
                          const RayCaster& rays, const LightSet& lights,
                          const DirectMeshOptions& options) {
  const bool isOther = scene_ != &scene || rays_ != &rays || changes.rebuilt || changes.materials ||
                       options.seed != options_.seed || options.isSeparate != options_.isSeparate;
  changed_ = isOther || (!changes.none() && !changes.onlyBrightness());
  scene_ = &scene;
  rays_ = &rays;
  lights_ = &lights;
  if (isOther) {
    tree_ = {};
    meshes_.clear();
  }
  if (!blockers_) blockers_ = std::make_unique<Blockers>();
  if (isOther || !changes.movedObjects.empty())
    blockers_->update(scene, isOther, changes.movedObjects);
  options_ = options;
  makeMeshes(changes, options);
  if (!isOther) forgetTouched(changes);
}

// Creates the meshes of the current lights, and keeps the known light of those that did not move.
void DirectMeshes::makeMeshes(const RenderSceneChanges& changes, const DirectMeshOptions& options) {
  const std::vector<VplId> ids = emitterIds(*lights_);
  std::vector<Mesh> before = std::move(meshes_);
  meshes_.clear();
  factors_.clear();
  for (size_t e = 0; e < ids.size(); ++e) {
    const Emitter& light = lights_->emitters()[e];
    if (light.kind != EmitterKind::surface) continue;
    factors_.push_back(std::make_unique<LightFactor>(*scene_, *rays_, *blockers_, *lights_, e,
                                                     ids[e], options.seed));
    if (options.isSeparate || meshes_.empty()) meshes_.emplace_back();
    meshes_.back().lights.push_back(ids[e]);
    meshes_.back().of.push_back(
        {factors_.back().get(), options.isSeparate ? vec3(1.0f) : light.brightness()});
  }
  const std::vector<vec3> light = brightness();
  for (size_t m = 0; m < meshes_.size(); ++m) {
    Mesh& mesh = meshes_[m];
    mesh.isOff = light[m] == vec3(0.0f);
    const auto known = std::ranges::find(before, mesh.lights, &Mesh::lights);
    if (known == before.end()) {
      changed_ = true;
      continue;
    }
    changed_ = changed_ || (known->isOff && !mesh.isOff);
    const bool isSame = std::ranges::equal(
        mesh.of, known->of, [&](const LitPixels::Light& now, const LitPixels::Light& old) {
          return now.weight == old.weight &&
                 std::ranges::find(changes.movedObjects,
                                   lights_->emitters()[now.factor->emitter()].object) ==
                     changes.movedObjects.end();
        });
    if (isSame)
      mesh.values = std::move(known->values);
    else
      changed_ = true;
  }
}

// Discards the light of vertices that moved objects may have shadowed before or may shadow now.
void DirectMeshes::forgetTouched(const RenderSceneChanges& changes) {
  if (changes.movedObjects.empty()) return;
  std::vector<Ball> boxes;
  for (size_t i = 0; i < changes.movedObjects.size(); ++i) {
    if (!changes.movedBounds[i].empty()) boxes.emplace_back(changes.movedBounds[i]);
    const Bounds& now = scene_->objects[changes.movedObjects[i]].bounds;
    if (!now.empty()) boxes.emplace_back(now);
  }
  // Roots of moved objects have new vertices.
  tree_.forgetRoots(changes.movedObjects);
  for (Mesh& mesh : meshes_) {
    std::vector<Ball> lights;
    for (const LitPixels::Light& l : mesh.of)
      lights.emplace_back(scene_->objects[lights_->emitters()[l.factor->emitter()].object].bounds);
    tbb::parallel_for(size_t{0}, mesh.values.isKnown.size(), [&](size_t v) {
      if (mesh.values.isKnown[v] == 0) return;
      const Ball here(tree_.vertex(static_cast<uint32_t>(v)).position);
      for (const Ball& light : lights)
        for (const Ball& box : boxes)
          if (mayBeBetween(here, light, box)) mesh.values.isKnown[v] = 0;
    });
    mesh.isShown = false;
  }
}

void DirectMeshes::show(const View& view, const GBufferView& gbuffer,
                        const SurfacePictureOptions& options) {
  if (bytes() > options_.memory) {
    tree_ = {};
    for (Mesh& mesh : meshes_) mesh.values = {};
  }
  view_ = view;
  visible_ = VisibleTriangles(*scene_, gbuffer);
  pixels_.emplace(*scene_, gbuffer, view.eye, options);
  roots_.clear();
  for (const VisibleTriangles::Triangle& t : visible_.triangles())
    roots_.push_back(tree_.root(*scene_, t));
  for (Mesh& mesh : meshes_) {
    mesh.isComplete = mesh.isOff;
    mesh.isShown = false;
  }
}

// One descent: computes the missing light of a mesh, as far as it is known which light is missing.
void DirectMeshes::findLight(Mesh& mesh, uint32_t number, size_t most) {
  mesh.values.resize(tree_.vertices());
  const MeshCut cut(tree_, mesh.values, visible_, roots_, view_, options_.cut);
  const MeshCut::Missing missing = cut.find(nullptr);
  mesh.isComplete = missing.none();
  for (const uint32_t node : missing.nodes) tree_.split(node);
  std::vector<MeshRequest> requests;
  for (const VertexRequest& r : missing.vertices)
    requests.push_back({number, r.vertex, r.priority});
  if (requests.empty()) return;
  takeFirst(requests, most, options_.priority, batch_++);
  std::vector<LightFactor::Work> work(requests.size());
  tbb::parallel_for(size_t{0}, requests.size(), [&](size_t i) {
    vec3 light(0.0f);
    for (const LitPixels::Light& l : mesh.of)
      light += l.weight * l.factor->at(tree_.vertex(requests[i].vertex), work[i]);
    mesh.values.light[requests[i].vertex] = light;
    mesh.values.isKnown[requests[i].vertex] = 1;
  });
  mesh.isShown = false;
  for (const LightFactor::Work& w : work) counts_.work += w;
  counts_.samples += requests.size();
}

bool DirectMeshes::goOn(size_t most) {
  // One mesh after the other, because a descent costs time even if it finds little. The next frame
  // begins with another one.
  const size_t count = meshes_.size();
  size_t descents = 0;
  for (size_t i = 0; i < count && counts_.samples < most && descents < kDescents; ++i) {
    const size_t m = (next_ + i) % count;
    Mesh& mesh = meshes_[m];
    for (; !mesh.isComplete && counts_.samples < most && descents < kDescents; ++descents)
      findLight(mesh, static_cast<uint32_t>(m), most - counts_.samples);
  }
  if (count > 0) next_ = (next_ + 1) % count;
  counts_.meshes = count;
  counts_.vertices = tree_.vertices();
  counts_.bytes = bytes();
  return std::ranges::all_of(meshes_, &Mesh::isComplete);
}

void DirectMeshes::picture(std::vector<std::vector<vec3>>& byMesh) {
  const auto pixels = static_cast<size_t>(view_.width) * static_cast<size_t>(view_.height);
  byMesh.resize(meshes_.size());
  counts_.triangles = 0;
  std::vector<vec3> irradiance;
  for (size_t m = 0; m < meshes_.size(); ++m) {
    Mesh& mesh = meshes_[m];
    if (!mesh.isShown) {
      irradiance.assign(pixels, vec3(0.0f));
      mesh.values.resize(tree_.vertices());
      const MeshCut cut(tree_, mesh.values, visible_, roots_, view_, options_.cut);
      mesh.triangles = cut.find(&irradiance).triangles;
      pixels_->reflect(mesh.of, irradiance, byMesh[m]);
      mesh.isShown = true;
    }
    counts_.triangles += mesh.triangles;
  }
}

std::vector<vec3> DirectMeshes::brightness() const {
  std::vector<vec3> out;
  for (const Mesh& mesh : meshes_)
    out.push_back(options_.isSeparate
                      ? lights_->emitters()[mesh.of.front().factor->emitter()].brightness()
                      : vec3(1.0f));
  return out;
}

size_t DirectMeshes::bytes() const {
  size_t bytes = tree_.bytes();
  for (const Mesh& mesh : meshes_)
    bytes += mesh.values.light.size() * (sizeof(vec3) + sizeof(uint8_t));
  return bytes;
}

}  // namespace lamplighter
