// Random but seeded editing of any level, by the actions and edits that hands use: the kill test
// and the soak work with it. The same seed, level and steps give the same document everywhere.
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
    size_t mostNodes = 200;       // beyond, things are deleted rather than added
    bool changesMethods = false;  // renders: the soak's
  };
  RandomEdits(Session& session, uint64_t seed, Limits limits);

  // One step; what it was, for messages. Actions that do not fit the moment do nothing.
  std::string step();

  uint32_t below(uint32_t count);  // [0, count)
  float between(float least, float most);

 private:
  std::string act(const std::string& action);
  std::string chooseNode();
  std::string drag();   // a transaction of many small changes, one step
  std::string panel();  // what panels do without an action
  // Adds copies and moves them off what they are copies of, as one step: of surfaces at the very
  // same place which one a ray meets is left to the ray caster's tree, edited or fresh.
  std::string copy(const std::string& action);
  std::string place();
  std::string parameter();

  Session& session_;
  uint64_t state_;
  Limits limits_;
};

}  // namespace lamplighter::test
