// The handles that move, rotate and scale the selection.
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

enum class ToolMode { select, move, rotate, scale };

// What a move snaps to: grid steps, or the surface or vertex under the pointer.
enum class SnapTo { grid, surface, vertex };

// The new position of the active node's origin when it snaps to what is under the pointer.
using SurfaceSnap = std::function<std::optional<vec3>(SnapTo)>;

class Gizmo {
 public:
  ToolMode mode = ToolMode::select;
  bool snap = false;  // always, not only while Ctrl is held
  SnapTo snapTo = SnapTo::grid;
  float unit = 1.0f;  // of grid steps: the length that suits the level [m]

  // Handles hover, start, update and end of a drag. Returns true if the gizmo uses the pointer. A
  // drag is one transaction; Esc or the right button cancels it. With Shift a move
  // follows the surface. With snapping it follows `snapTo`.
  bool update(const View& view, const ViewportInput& input, Editing& editing,
              const SurfaceSnap& surface = {});
  bool dragging() const { return drag_.has_value(); }
  // Call when something interrupts the drag: commits it as it is, or cancels it.
  void finish();
  void cancel() { drag_.reset(); }
  void draw(Overlay& overlay, const View& view, const Document& document) const;

 private:
  // x, y, z: an axis, or the ring around it; xy, …: a plane; screen: the plane of the picture, or,
  // for scale, all axes uniformly.
  enum class Handle { none, x, y, z, yz, zx, xy, screen };
  struct Axes {
    vec3 origin{0.0f};
    mat3 axes{1.0f};    // unit columns
    float size = 1.0f;  // length of the handles [m]
  };
  struct Drag {
    Handle handle;
    Axes axes;  // at the start of the drag
    vec2 pointer{0.0f};
    vec3 grip{0.0f};            // where the pointer's ray hit the handle, relative to the origin
    std::optional<vec2> pull;   // a ring seen edge-on: pixels per radian, along the ring
    std::vector<Node> nodes;    // topmost selected nodes, before the drag
    std::vector<mat4> parents;  // their parents' world matrices
    Transaction edit;
  };

  std::optional<Axes> axesOf(const View& view, const Document& document) const;
  static std::vector<vec2> planeSquare(const View& view, const Axes& axes, int normal);
  Handle handleAt(const View& view, const Axes& axes, const vec2& pointer) const;
  std::optional<vec3> gripOf(const View& view, const Axes& axes, Handle handle,
                             const vec2& pointer) const;
  void begin(const View& view, const Axes& axes, Handle handle, const vec2& pointer,
             const Document& document);
  std::optional<vec2> pullOf(const View& view, const Axes& axes, Handle handle) const;
  std::optional<std::vector<Node>> dragged(const View& view, const vec2& pointer,
                                           bool snapping) const;
  std::vector<Node> moved(const vec3& offset) const;
  std::vector<Node> rotated(const vec3& axis, float angle) const;
  std::vector<Node> scaled(const vec3& factors) const;

  std::optional<Drag> drag_;
  Handle hovered_ = Handle::none;
};

}  // namespace lamplighter
