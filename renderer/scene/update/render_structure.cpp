#include "renderer/scene/update/render_structure.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "renderer/scene/update/render_materials.h"

namespace lamplighter {

namespace {

constexpr uint32_t kNoObject = 0xffffffffu;

// The memory of deleted objects is kept for undo. If they have more than this many triangles, and
// more than all other objects, the scene is rebuilt without them; so it is if there are too many.
constexpr size_t kMostDeletedTriangles = 200000, kMostDeleted = 4096;
// Objects that change their place in the order get new memory, unless they have more than one
// triangle in this many.
constexpr size_t kReorderedShare = 8;

// Whether what the objects share, and what they keep, is as before.
bool isSameButObjects(const RenderScene& render, const Scene& scene, const SceneState& state,
                      const RenderMaterials& materials) {
  if (render.skyLink != state.links.ofSky || render.hasLinks != (state.links.count > 0) ||
      render.materials.empty() ||
      render.materials.size() - static_cast<size_t>(render.firstDark) != scene.materials.size() ||
      render.textures.size() < scene.textures.size())
    return false;
  for (size_t i = 0; i < scene.materials.size(); ++i)
    if (render.materials[i].isClear() != materials.materials[i].isClear()) return false;
  return std::equal(scene.textures.begin(), scene.textures.end(), render.textures.begin());
}

class Plan {
 public:
  Plan(const RenderScene& render, const Scene& scene, const SceneState& state)
      : render_(render),
        scene_(scene),
        state_(state),
        wanted_(wantedObjects(scene)),
        objectOf_(wanted_.size(), kNoObject),
        wantedBy_(render.objects.size(), wanted_.size()) {
    findObjects();
  }

  // Whether it keeps to the limits above, and the properties of kept objects that cannot change.
  bool isPossible() const {
    size_t deleted = 0, deletedTriangles = 0, reordered = 0;
    for (size_t object = 0; object < wantedBy_.size(); ++object) {
      const RenderObject& o = render_.objects[object];
      if (wantedBy_[object] == wanted_.size()) {
        ++deleted;
        deletedTriangles += render_.slots[object].indexCount / 3;
        if (isWantedElsewhere(object)) reordered += o.triangleCount();
        continue;
      }
      const size_t node = wanted_[wantedBy_[object]].node;
      if (o.isEmpty() || !state_.visible[node]) continue;
      if (o.link != state_.links.ofLight[node] || o.leftOutBy != state_.links.leftOutBy[node] ||
          (!o.isAreaLight && o.kind != scene_.nodes[node].meshKind))
        return false;
    }
    const size_t triangles = render_.indices.size() / 3;
    return deleted <= std::max(kMostDeleted, wanted_.size()) &&
           deletedTriangles <= std::max(kMostDeletedTriangles, triangles / 2) &&
           reordered <= triangles / kReorderedShare;
  }

  void apply(RenderScene& render, RenderMaterials now, RenderSceneChanges& out) const {
    RenderMaterials before;
    before.materials = std::exchange(render.materials, std::move(now.materials));
    before.nominalEmission = std::exchange(render.nominalEmission, std::move(now.nominalEmission));
    before.firstDark = std::exchange(render.firstDark, now.firstDark);
    render.textures = std::move(now.textures);
    out.objects |= before.firstDark != render.firstDark;
    noteSharedMaterials(render, before, out);
    for (uint32_t object = 0; object < wantedBy_.size(); ++object)
      update(render, before, now.ofAreaLight, object, out);
    for (size_t w = 0; w < wanted_.size(); ++w) {
      if (objectOf_[w] != kNoObject) continue;
      const uint32_t object = appendObject(render, scene_, wanted_[w]);
      if (state_.visible[wanted_[w].node]) show(render, now.ofAreaLight, w, object, out);
    }
    std::ranges::sort(out.emissions);
    const auto repeated = std::ranges::unique(out.emissions);
    out.emissions.erase(repeated.begin(), repeated.end());
  }

 private:
  bool isFor(const ObjectSlot& slot, const WantedObject& wanted) const {
    const Node& node = scene_.nodes[wanted.node];
    return slot.node == node.id && slot.mesh == wanted.mesh && slot.primitive == wanted.primitive &&
           (wanted.mesh || slot.shape == node.area->shape);
  }

  // Finds for each wanted object the first reserved one after that of the previous wanted object.
  // All objects after a new one are new, too.
  void findObjects() {
    std::unordered_map<NodeId, std::vector<uint32_t>> ofNode;
    for (uint32_t i = 0; i < render_.slots.size(); ++i) ofNode[render_.slots[i].node].push_back(i);
    uint32_t next = 0;
    for (size_t w = 0; w < wanted_.size() && next != kNoObject; ++w) {
      const auto found = ofNode.find(scene_.nodes[wanted_[w].node].id);
      uint32_t object = kNoObject;
      if (found != ofNode.end()) {
        for (const uint32_t i : found->second)
          if (object == kNoObject && i >= next && isFor(render_.slots[i], wanted_[w])) object = i;
      }
      objectOf_[w] = object;
      if (object != kNoObject) wantedBy_[object] = w;
      next = object == kNoObject ? object : object + 1;
    }
  }

  bool isWantedElsewhere(size_t object) const {
    return scene_.find(render_.slots[object].node) != nullptr;
  }

  int materialFor(const WantedObject& wanted, const std::vector<int>& ofAreaLight,
                  int firstDark) const {
    if (!wanted.mesh) return ofAreaLight[wanted.node];
    return materialOf(scene_, wanted.mesh->primitives[wanted.primitive],
                      state_.shining[wanted.node], firstDark);
  }

  // Adds the changes of the scene's materials, lit and dark.
  void noteSharedMaterials(const RenderScene& render, const RenderMaterials& before,
                           RenderSceneChanges& out) const {
    const auto note = [&](size_t was, size_t is) {
      noteMaterial({before.materials[was], before.nominalEmission[was]},
                   {render.materials[is], render.nominalEmission[is]}, static_cast<int>(is), false,
                   out);
    };
    for (size_t i = 0; i < scene_.materials.size(); ++i) {
      note(i, i);
      note(static_cast<size_t>(before.firstDark) + i, static_cast<size_t>(render.firstDark) + i);
    }
  }

  void show(RenderScene& render, const std::vector<int>& ofAreaLight, size_t wanted,
            uint32_t object, RenderSceneChanges& out) const {
    fillObject(render, scene_, state_, wanted_[wanted], object);
    render.objects[object].material = materialFor(wanted_[wanted], ofAreaLight, render.firstDark);
    out.movedObjects.push_back(object);
    out.movedBounds.emplace_back();
    out.objects = true;
  }

  void update(RenderScene& render, const RenderMaterials& before,
              const std::vector<int>& ofAreaLight, uint32_t object, RenderSceneChanges& out) const {
    RenderObject& o = render.objects[object];
    const size_t w = wantedBy_[object];
    const bool isShown = w != wanted_.size() && state_.visible[wanted_[w].node];
    if (!isShown) {
      if (!o.isEmpty()) {
        out.movedObjects.push_back(object);
        out.movedBounds.push_back(o.bounds);
        out.objects = true;
      }
      emptyObject(render, object);
      return;
    }
    if (o.isEmpty()) {
      show(render, ofAreaLight, w, object, out);
      return;
    }
    const WantedObject& wanted = wanted_[w];
    const Node& node = scene_.nodes[wanted.node];
    const int was = std::exchange(o.material, materialFor(wanted, ofAreaLight, render.firstDark));
    if (o.isAreaLight) {
      const auto from = static_cast<size_t>(was), to = static_cast<size_t>(o.material);
      noteMaterial({before.materials[from], before.nominalEmission[from]},
                   {render.materials[to], render.nominalEmission[to]}, o.material, true, out);
    } else if ((was >= before.firstDark) != (o.material >= render.firstDark)) {
      out.switchedObjects.push_back(object);
    }
    const bool isResized = o.isAreaLight && render.slots[object].size != node.area->size;
    if (o.world == state_.world[wanted.node] && !isResized) return;
    out.movedObjects.push_back(object);
    out.movedBounds.push_back(o.bounds);
    placeObject(render, node, state_.world[wanted.node], object);
  }

  const RenderScene& render_;
  const Scene& scene_;
  const SceneState& state_;
  std::vector<WantedObject> wanted_;
  std::vector<uint32_t> objectOf_;  // by wanted object
  std::vector<size_t> wantedBy_;    // by object: the wanted one, or their number
};

}  // namespace

bool takeStructure(RenderScene& render, const Scene& scene, const SceneState& state,
                   RenderSceneChanges& out) {
  RenderMaterials materials(scene, state.shining);
  if (!isSameButObjects(render, scene, state, materials)) return false;
  const Plan plan(render, scene, state);
  if (!plan.isPossible()) return false;
  plan.apply(render, std::move(materials), out);
  return true;
}

}  // namespace lamplighter
