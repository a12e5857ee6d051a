#include "tests/safety/random_edits.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

#include "editor/edits/edits.h"

namespace lamplighter::test {

RandomEdits::RandomEdits(Session& session, uint64_t seed, Limits limits)
    : session_(session), state_(seed), limits_(limits) {}

// splitmix64, http://prng.di.unimi.it/splitmix64.c (public domain). Unlike the distributions of the
// standard library, it gives the same numbers on every machine.
uint32_t RandomEdits::below(uint32_t count) {
  uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return static_cast<uint32_t>((z ^ (z >> 31)) >> 32) % std::max(count, 1u);
}

float RandomEdits::between(float least, float most) {
  return least + (most - least) * static_cast<float>(below(65536)) / 65535.0f;
}

std::string RandomEdits::act(const std::string& action) {
  session_.runAction(action);
  return action;
}

std::string RandomEdits::chooseNode() {
  const auto& nodes = session_.document().scene.nodes;
  std::vector<NodeId> ids;
  for (uint32_t i = 0, n = 1 + below(3); i < n && !nodes.empty(); ++i)
    ids.push_back(nodes[below(static_cast<uint32_t>(nodes.size()))].id);
  session_.select(ids);
  return "select";
}

std::string RandomEdits::drag() {
  const NodeId id = session_.document().active();
  if (id == kNoNode) return chooseNode();
  session_.editing().hold("Drag");
  const uint32_t moves = 1 + below(5);
  for (uint32_t i = 0; i < moves; ++i) {
    Transform t = session_.document().scene.find(id)->local;
    t.translation += vec3(between(-0.3f, 0.3f), between(-0.1f, 0.1f), between(-0.3f, 0.3f));
    session_.setNodeTransform(id, t);
  }
  if (below(5) == 0)
    session_.editing().cancel();
  else
    session_.editing().commit();
  return "drag";
}

std::string RandomEdits::panel() {
  const Document& d = session_.document();
  const Node* n = d.scene.find(d.active());
  switch (below(4)) {
    case 0:
      if (!d.scene.materials.empty()) {
        const auto i = static_cast<int>(below(static_cast<uint32_t>(d.scene.materials.size())));
        Material m = d.scene.materials[static_cast<size_t>(i)];
        m.baseColor = vec4(between(0.1f, 0.9f), between(0.1f, 0.9f), between(0.1f, 0.9f), 1.0f);
        m.roughness = between(0.0f, 1.0f);
        session_.setMaterial(i, m);
      }
      return "material";
    case 1:
      if (n != nullptr && n->area) {
        AreaLight light = *n->area;
        light.radiance = vec3(between(0.0f, 40.0f), between(0.0f, 40.0f), between(0.0f, 40.0f));
        session_.setAreaLight(n->id, light);
      }
      return "area light";
    case 2:
      session_.setSky(below(2) == 0 ? Sky(vec3(between(0.0f, 1.0f)))
                                    : Sky::gradient(vec3(between(0.0f, 1.0f)), vec3(0.5f),
                                                    vec3(between(0.0f, 0.3f))));
      return "sky";
    default:
      if (n != nullptr) session_.setMeshKind(n->id, static_cast<MeshKind>(below(3)));
      return "mesh kind";
  }
}

std::string RandomEdits::copy(const std::string& action) {
  session_.editing().hold("Copy");
  act(action);
  const std::vector<NodeId> copies = session_.document().selection;
  for (const NodeId id : copies) {
    Transform t = session_.document().scene.find(id)->local;
    t.translation += vec3(between(0.01f, 0.5f), between(0.01f, 0.2f), between(0.01f, 0.5f));
    session_.setNodeTransform(id, t);
  }
  session_.editing().commit();
  return action + ", moved";
}

std::string RandomEdits::place() {
  if (session_.document().scene.nodes.size() > limits_.mostNodes) {
    chooseNode();
    return act("edit.delete");
  }
  static constexpr const char* kKinds[] = {"rectangle", "disk",  "sphere", "tube",
                                           "spot",      "point", "sun"};
  return act(fmt::format("light.add {}", kKinds[below(7)]));
}

std::string RandomEdits::parameter() {
  if (!limits_.changesMethods)
    return act(fmt::format("render.exposure {}", static_cast<int>(below(9)) - 4));
  switch (below(5)) {
    case 0:
      return act(fmt::format("render.set vpls={}", 8u << below(4)));
    case 1:
      return act(fmt::format("render.set bounces={}", 1 + below(3)));
    case 2:
      return act(fmt::format("render.set seed={}", below(4)));
    case 3:
      return act(fmt::format("render.exposure {}", static_cast<int>(below(9)) - 4));
    default:
      return act(below(6) == 0 ? "render.reference" : "render.method many_lights");
  }
}

std::string RandomEdits::step() {
  const size_t nodes = session_.document().scene.nodes.size();
  switch (below(16)) {
    case 0:
    case 1:
      return chooseNode();
    case 2:
    case 3:
      return place();
    case 4:
      // An almost empty level would make the following steps useless.
      return act(nodes > 3 ? "edit.delete" : "edit.undo");
    case 5:
      return nodes < limits_.mostNodes ? copy("edit.duplicate") : act("edit.delete");
    case 6:
    case 7:
      return act("edit.undo");
    case 8:
      return act("edit.redo");
    case 9:
      return drag();
    case 10:
      return panel();
    case 11:
      return parameter();
    case 12:
      return act(
          fmt::format("object.move {} {} {}", between(-2, 2), between(0, 2), between(-2, 2)));
    case 13:
      return act(fmt::format("edit.rename \"thing {}\"", below(1000)));
    case 14: {
      static constexpr const char* kLights[] = {"lights.brighter",      "lights.darker",
                                                "lights.on false",      "lights.all_on",
                                                "lights.group evening", "lights.solo true"};
      return act(kLights[below(6)]);
    }
    default:
      act("edit.copy");
      return nodes < limits_.mostNodes ? copy("edit.paste") : act("object.hide");
  }
}

}  // namespace lamplighter::test
