// Random edits of a scene, for tests that ask whether what is kept from edit to edit is what would
// be made from nothing. A sequence that fails is made as short as it still fails.
#pragma once

#include <functional>
#include <ostream>
#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter::test {

struct Edit {
  bool operator==(const Edit&) const = default;
  enum class Kind { move, turn, scale, mirror, hideOrShow, add, remove, brighten, kind };
  Kind kind = Kind::move;
  uint32_t node = 0;      // of those there are, modulo their number
  vec3 amount{0.0f};      // in [−1, 1]³
  bool together = false;  // with the edit before, as one change
};
using EditSequence = std::vector<Edit>;
void PrintTo(const EditSequence& edits, std::ostream* out);

EditSequence randomEdits(int count, uint32_t seed);
void apply(Scene& scene, const Edit& edit);

// Runs check(sequence), which says whether all is well. Returns an empty sequence when it is; else
// the shortest part of the sequence that was found to fail too, edits left out one after the other.
EditSequence shortestFailing(const EditSequence& edits,
                             const std::function<bool(const EditSequence&)>& check);

}  // namespace lamplighter::test
