// Handles of the active light in the viewport: its edges or rim set its size, its tip aims it, and
// a spot has its two cones. Shown with every tool; the gizmo's handles go first.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "editor/document/document.h"
#include "editor/edits/history.h"
#include "editor/tools/overlay.h"
#include "editor/tools/viewport_input.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// The place under the pointer that a light is aimed at.
using AimTarget = std::function<std::optional<vec3>()>;

class LightHandles {
 public:
  enum class Kind { none, right, left, top, bottom, rim, aim, outerCone, innerCone };

  // Hovers, begins, goes on with and ends a drag, as Gizmo::update() does: true when the pointer is
  // its. Edges leave the opposite edge where it is, with Shift both move; sizes snap to 5 cm and
  // cones to 5° when `snap` is on or Ctrl is held, but not both.
  bool update(const View& view, const ViewportInput& input, Document& document, History& history,
              bool snap, const AimTarget& target);
  bool dragging() const { return drag_.has_value(); }
  void finish(History& history);
  void cancel(History& history);
  void forget() { drag_.reset(); }
  void draw(Overlay& overlay, const View& view, const Document& document) const;

  struct Handle {
    Kind kind = Kind::none;
    vec3 place{0.0f};  // world
  };
  // Of the active node; empty where that is no light.
  static std::vector<Handle> handlesOf(const View& view, const Document& document);

 private:
  struct Drag {
    Kind kind;
    Node node;  // as it was
    mat4 world, parent;
  };
  std::optional<Node> dragged(const View& view, const ViewportInput& input, bool snapping,
                              const AimTarget& target) const;
  std::optional<Node> resized(const vec3& at, bool bothSides, bool snapping) const;
  std::optional<Node> aimed(const vec3& at) const;
  std::optional<Node> widened(const vec3& at, bool snapping) const;

  std::optional<Drag> drag_;
  Kind hovered_ = Kind::none;
};

}  // namespace lamplighter
