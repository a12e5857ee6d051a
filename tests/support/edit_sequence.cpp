#include "tests/support/edit_sequence.h"

#include <algorithm>
#include <random>

#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {

void PrintTo(const EditSequence& edits, std::ostream* out) {
  static const char* const kNames[] = {
      "move",       "turn",     "scale",    "mirror",  "hide or show",
      "add",        "remove",   "brighten", "kind of", "add a light after",
      "remove any", "duplicate"};
  for (const Edit& e : edits)
    *out << (e.together ? " + " : "\n  ") << kNames[static_cast<int>(e.kind)] << " node " << e.node
         << " by (" << e.amount.x << ", " << e.amount.y << ", " << e.amount.z << ")";
}

EditSequence randomEdits(int count, uint32_t seed) {
  std::mt19937 random(seed);
  // Uses the bits of the generator, because distributions differ between standard libraries.
  const auto unit = [&] { return static_cast<float>(random() >> 8) / 8388608.0f - 1.0f; };
  EditSequence edits;
  for (int i = 0; i < count; ++i) {
    Edit& e = edits.emplace_back();
    const uint32_t kind = random() % 13;
    e.kind = kind < 4 ? Edit::Kind::move : static_cast<Edit::Kind>(1 + (kind - 4) % 8);
    e.node = random();
    e.amount.x = unit();
    e.amount.y = unit();
    e.amount.z = unit();
    e.together = random() % 3 == 0;
  }
  return edits;
}

EditSequence randomStructureEdits(int count, uint32_t seed) {
  constexpr Edit::Kind kKinds[] = {
      Edit::Kind::hideOrShow, Edit::Kind::hideOrShow, Edit::Kind::add, Edit::Kind::addLight,
      Edit::Kind::removeAny,  Edit::Kind::duplicate,  Edit::Kind::move};
  EditSequence edits = randomEdits(count, seed);
  for (size_t i = 0; i < edits.size(); ++i)
    edits[i].kind = kKinds[(edits[i].node / 64 + i) % std::size(kKinds)];
  return edits;
}

void apply(Scene& scene, const Edit& edit) {
  if (edit.kind == Edit::Kind::add || scene.nodes.empty()) {
    addMesh(scene, boxMesh(0.6f + 0.4f * edit.amount), 3.0f * edit.amount);
    return;
  }
  const size_t index = edit.node % scene.nodes.size();
  Node& node = scene.nodes[index];
  switch (edit.kind) {
    case Edit::Kind::move:
      node.local.translation += edit.amount * vec3(1.0f, 0.5f, 1.0f);
      break;
    case Edit::Kind::turn:
      node.local.rotation =
          glm::angleAxis(edit.amount.x, glm::normalize(vec3(edit.amount.y, 1.1f, edit.amount.z))) *
          node.local.rotation;
      break;
    case Edit::Kind::scale:
      node.local.scale *= 1.0f + 0.4f * edit.amount;
      break;
    case Edit::Kind::mirror:
      node.local.scale.x *= -1.0f;
      break;
    case Edit::Kind::hideOrShow:
      node.visible = !node.visible;
      break;
    case Edit::Kind::remove:
      if (!node.area) scene.nodes.erase(scene.nodes.begin() + static_cast<ptrdiff_t>(index));
      break;
    case Edit::Kind::brighten:
      for (Node& n : scene.nodes)
        if (n.area) n.area->radiance *= 1.0f + 0.5f * edit.amount;
      break;
    case Edit::Kind::kind:
      node.meshKind = static_cast<MeshKind>((static_cast<int>(node.meshKind) + 1) % 3);
      break;
    case Edit::Kind::addLight:
      addRectangleLight(scene, vec3(1.5f, 0.5f, 1.5f) * edit.amount + vec3(0.0f, 2.5f, 0.0f),
                        vec2(0.5f, 0.4f), vec3(4.0f) + edit.amount);
      break;
    case Edit::Kind::removeAny:
      if (scene.nodes.size() > 2)
        scene.nodes.erase(scene.nodes.begin() + static_cast<ptrdiff_t>(index));
      break;
    case Edit::Kind::duplicate: {
      Node copy = node;
      copy.id = scene.nextId++;
      copy.local.translation += 0.5f * edit.amount;
      scene.nodes.push_back(std::move(copy));
      break;
    }
    case Edit::Kind::add:
      break;
  }
}

EditSequence shortestFailing(const EditSequence& edits,
                             const std::function<bool(const EditSequence&)>& check) {
  if (check(edits)) return {};
  EditSequence failing = edits;
  for (size_t i = failing.size(); i-- > 0 && failing.size() > 1;) {
    EditSequence shorter = failing;
    shorter.erase(shorter.begin() + static_cast<ptrdiff_t>(i));
    if (!check(shorter)) failing = std::move(shorter);
  }
  return failing;
}

}  // namespace lamplighter::test
