// Viewport handles of the active light: edges or rim set the size, the tip sets the direction, and
// a spot light has its two cones. They are shown with every tool. The gizmo's handles have
// priority.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "editor/document/document.h"
#include "editor/edits/editing.h"
#include "editor/tools/overlay.h"
#include "editor/tools/viewport_input.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// The point under the pointer that the light aims at.
using AimTarget = std::function<std::optional<vec3>()>;

class LightHandles {
 public:
  float unit = 1.0f;  // of lengths that suit the level [m]

  enum class Kind { none, right, left, top, bottom, rim, aim, outerCone, innerCone };

  // Handles hover, start, update and end of a drag, as Gizmo::update() does. Returns true if a
  // handle uses the pointer. An edge keeps the opposite edge in place; with Shift both move. Sizes
  // snap to 0.05 units and cones to 5° if either `snap` or Ctrl is on, but not both.
  bool update(const View& view, const ViewportInput& input, Editing& editing, bool snap,
              const AimTarget& target);
  bool dragging() const { return drag_.has_value(); }
  void finish();
  void cancel() { drag_.reset(); }
  void draw(Overlay& overlay, const View& view, const Document& document) const;

  struct Handle {
    Kind kind = Kind::none;
    vec3 place{0.0f};  // world space
  };
  // The handles of the active node. Empty if it is not a light.
  static std::vector<Handle> handlesOf(const View& view, const Document& document);

 private:
  struct Drag {
    Kind kind;
    Node node;  // before the drag
    mat4 world, parent;
    Transaction edit;
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
