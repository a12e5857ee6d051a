// Random edits of a scene. Tests use them to check that incremental updates give the same result as
// a full rebuild. A failing sequence is shortened as far as possible.
#pragma once

#include <functional>
#include <ostream>
#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter::test {

struct Edit {
  bool operator==(const Edit&) const = default;
  enum class Kind {
    move,
    turn,
    scale,
    mirror,
    hideOrShow,
    add,
    remove,  // no area light
    brighten,
    kind,
    addLight,
    removeAny,
    duplicate
  };
  Kind kind = Kind::move;
  uint32_t node = 0;      // index, modulo the number of nodes
  vec3 amount{0.0f};      // in [−1, 1]³
  bool together = false;  // in the same change as the previous edit
};
using EditSequence = std::vector<Edit>;
void PrintTo(const EditSequence& edits, std::ostream* out);

EditSequence randomEdits(int count, uint32_t seed);
// The same, of what adds, removes, hides and shows nodes, and of moves.
EditSequence randomStructureEdits(int count, uint32_t seed);
void apply(Scene& scene, const Edit& edit);

// Runs check(sequence), which returns whether the test passes. Returns an empty sequence if it
// passes. Otherwise removes edits one after the other and returns the shortest failing sequence
// found.
EditSequence shortestFailing(const EditSequence& edits,
                             const std::function<bool(const EditSequence&)>& check);

}  // namespace lamplighter::test
