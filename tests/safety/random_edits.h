// Seeded random edits of a level by the actions and edits of a user, for the kill test and the soak
// test. The same seed, level and steps give the same document everywhere.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "editor/session/session.h"

namespace lamplighter::test {

class RandomEdits {
 public:
  struct Limits {
    size_t mostNodes = 200;       // above it, objects are deleted instead of added
    bool changesMethods = false;  // whether steps may change the method; for the soak test
  };
  RandomEdits(Session& session, uint64_t seed, Limits limits);

  // Makes one step and returns its description. Actions that are not possible do nothing.
  std::string step();

  uint32_t below(uint32_t count);  // [0, count)
  float between(float least, float most);

 private:
  std::string act(const std::string& action);
  std::string chooseNode();
  std::string drag();   // many small changes in one transaction
  std::string panel();  // edits that panels make without an action
  // Adds copies and moves them away from the originals, as one step. For coincident surfaces, the
  // hit would depend on the structure of the ray caster's tree.
  std::string copy(const std::string& action);
  std::string place();
  std::string parameter();

  Session& session_;
  uint64_t state_;
  Limits limits_;
};

}  // namespace lamplighter::test
