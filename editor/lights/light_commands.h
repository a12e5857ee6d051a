// The light groups of a document, and the states of the groups and of the sky.
#pragma once

#include <utility>
#include <vector>

#include "editor/edits/command.h"

namespace lamplighter {

class EditLightStates final : public Command {
 public:
  EditLightStates(const Document& document, LightState sky, std::vector<LightGroup> groups)
      : before_{document.scene.skyLight, document.scene.lightGroups},
        after_{std::move(sky), std::move(groups)} {}
  std::string label() const override { return "Change groups of lights"; }
  void apply(Document& document) override { put(document, after_); }
  void revert(Document& document) override { put(document, before_); }
  bool absorb(const Command& later) override {
    const auto* other = dynamic_cast<const EditLightStates*>(&later);
    if (other == nullptr) return false;
    after_ = other->after_;
    return true;
  }
  bool changesNothing() const override { return before_ == after_; }
  size_t bytes() const override {
    return sizeof *this + sizeof(LightGroup) * (before_.groups.size() + after_.groups.size());
  }

 private:
  struct States {
    LightState sky;
    std::vector<LightGroup> groups;
    bool operator==(const States&) const = default;
  };
  static void put(Document& document, const States& states) {
    document.scene.skyLight = states.sky;
    document.scene.lightGroups = states.groups;
  }
  States before_, after_;
};

}  // namespace lamplighter
