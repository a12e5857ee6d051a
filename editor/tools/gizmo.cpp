#include "editor/tools/gizmo.h"

#include <algorithm>
#include <cmath>

#include "editor/edits/edits.h"
#include "editor/edits/placement.h"
#include "editor/edits/tree.h"
#include "editor/tools/projection.h"

namespace lamplighter {

namespace {

constexpr float kReach = 92.0f;  // length of an axis in pixels
constexpr float kGrab = 8.0f;    // distance from a line in pixels for grabbing it
constexpr float kPlaneFrom = 0.28f,
                kPlaneTo = 0.5f;     // the range of the plane squares along their axes
constexpr float kScreenRing = 1.2f;  // radius of the ring for rotation in the picture plane
constexpr float kMoveStep = 0.25f;   // units
constexpr float kTurnStep = 15.0f * kPi / 180.0f;
constexpr float kScaleStep = 0.1f;

const vec4 kAxisColours[3] = {
    {0.93f, 0.32f, 0.31f, 1}, {0.48f, 0.8f, 0.32f, 1}, {0.33f, 0.56f, 0.96f, 1}};
const vec4 kScreenColour{0.85f, 0.85f, 0.85f, 1};

struct Line {
  vec3 origin, direction;
};

Line pointerRay(const View& view, const vec2& pointer) {
  return {view.eye, view.rayDirection(pointer.x, pointer.y)};
}

// The parameter of the point on the axis (unit direction) that is nearest to the ray. None if they
// are parallel, or if that point is behind the eye, past the axis' vanishing point.
std::optional<float> nearestOnAxis(const vec3& origin, const vec3& axis, const Line& ray) {
  const float b = glm::dot(axis, ray.direction);
  const float denominator = 1.0f - b * b;
  if (denominator < 1e-5f) return std::nullopt;
  const vec3 d = ray.origin - origin;
  const float t = (glm::dot(d, axis) - glm::dot(d, ray.direction) * b) / denominator;
  if (glm::dot(origin + t * axis - ray.origin, ray.direction) <= 0.0f) return std::nullopt;
  return t;
}

// The rotation in a matrix that rotates, scales uniformly and may mirror; none for other matrices.
// A mirroring matrix is minus a rotation. The minus cancels when a rotation is transformed by it.
std::optional<quat> turnOf(const mat3& a) {
  const float determinant = glm::determinant(a);
  const float scale = std::copysign(std::cbrt(std::abs(determinant)), determinant);
  const mat3 q = a / scale;
  const mat3 square = glm::transpose(q) * q;
  float off = 0.0f;
  for (int i = 0; i < 3; ++i) off += glm::length(square[i] - mat3(1.0f)[i]);
  if (!(off < 1e-4f)) return std::nullopt;
  return glm::normalize(glm::quat_cast(q));
}

float snapped(float value, float step) { return std::round(value / step) * step; }

bool insideQuad(const vec2& p, const std::vector<vec2>& q) {
  bool positive = false, negative = false;
  for (size_t i = 0; i < 4; ++i) {
    const vec2 e = q[(i + 1) % 4] - q[i], d = p - q[i];
    const float cross = e.x * d.y - e.y * d.x;
    (cross > 0.0f ? positive : negative) = true;
  }
  return !(positive && negative);
}

}  // namespace

std::optional<Gizmo::Axes> Gizmo::axesOf(const View& view, const Document& document) const {
  if (mode == ToolMode::select || document.active() == kNoNode ||
      isLocked(document.scene, document.active()))
    return std::nullopt;
  const mat4 world = worldMatrix(document.scene, document.active());
  Axes a;
  a.origin = vec3(world[3]);
  if (glm::dot(a.origin - view.eye, view.forward()) < view.znear) return std::nullopt;
  // Scaling uses the object's own axes, moving and rotating the world axes.
  if (mode == ToolMode::scale) a.axes = glm::mat3_cast(decompose(world).rotation);
  a.size = kReach * metresPerPixel(view, a.origin);
  return a;
}

// The square between two axes that moves in their plane, in pixels; fewer than 4 points if a part
// of it is behind the eye. `normal`: index of the third axis.
std::vector<vec2> Gizmo::planeSquare(const View& view, const Axes& axes, int normal) {
  const vec3 u = axes.size * axes.axes[(normal + 1) % 3],
             v = axes.size * axes.axes[(normal + 2) % 3];
  std::vector<vec2> square;
  for (const vec2& t : {vec2(kPlaneFrom, kPlaneFrom), vec2(kPlaneTo, kPlaneFrom),
                        vec2(kPlaneTo, kPlaneTo), vec2(kPlaneFrom, kPlaneTo)})
    if (const auto p = projectPoint(view, axes.origin + t.x * u + t.y * v)) square.push_back(*p);
  return square;
}

Gizmo::Handle Gizmo::handleAt(const View& view, const Axes& axes, const vec2& pointer) const {
  const auto centre = projectPoint(view, axes.origin);
  if (!centre) return Handle::none;
  Handle best = Handle::none;
  float nearest = kGrab;
  const auto offer = [&](Handle handle, float distance) {
    if (distance < nearest) {
      nearest = distance;
      best = handle;
    }
  };
  if (mode == ToolMode::rotate) {
    for (int i = 0; i < 3; ++i) {
      const auto points =
          circle(axes.origin, axes.axes[(i + 1) % 3], axes.axes[(i + 2) % 3], axes.size);
      for (size_t k = 0; k < points.size(); ++k) {
        // The near half of a ring hides the far half.
        if (glm::dot(points[k] - axes.origin, view.eye - axes.origin) < 0.0f) continue;
        const auto s = projectSegment(view, points[k], points[(k + 1) % points.size()]);
        if (s)
          offer(static_cast<Handle>(static_cast<int>(Handle::x) + i),
                distanceToSegment(pointer, s->a, s->b));
      }
    }
    offer(Handle::screen, std::abs(glm::length(pointer - *centre) - kScreenRing * kReach));
    return best;
  }
  if (glm::length(pointer - *centre) < kGrab) return Handle::screen;
  for (int i = 0; i < 3; ++i) {
    const auto s = projectSegment(view, axes.origin, axes.origin + axes.size * axes.axes[i]);
    if (s)
      offer(static_cast<Handle>(static_cast<int>(Handle::x) + i),
            distanceToSegment(pointer, s->a, s->b));
  }
  if (best != Handle::none || mode == ToolMode::scale) return best;
  for (int i = 0; i < 3; ++i) {
    const std::vector<vec2> quad = planeSquare(view, axes, i);
    if (quad.size() == 4 && insideQuad(pointer, quad))
      return static_cast<Handle>(static_cast<int>(Handle::yz) + i);
  }
  return Handle::none;
}

std::optional<vec3> Gizmo::gripOf(const View& view, const Axes& a, Handle handle,
                                  const vec2& pointer) const {
  const int index = (static_cast<int>(handle) - 1) % 3;
  std::optional<vec3> point;
  if (handle == Handle::screen) {
    point = onPlane(view, pointer, a.origin, view.forward());
  } else if (mode == ToolMode::rotate || handle >= Handle::yz) {
    point = onPlane(view, pointer, a.origin, a.axes[index]);
  } else if (const auto t = nearestOnAxis(a.origin, a.axes[index], pointerRay(view, pointer))) {
    return *t * a.axes[index];
  }
  return point ? std::optional(*point - a.origin) : std::nullopt;
}

// For a ring seen nearly edge-on, the intersection of the ray with its plane is useless. Instead,
// the pointer drags the ring's nearest point along the ring.
std::optional<vec2> Gizmo::pullOf(const View& view, const Axes& a, Handle handle) const {
  if (mode != ToolMode::rotate || handle == Handle::screen) return std::nullopt;
  const vec3& axis = a.axes[(static_cast<int>(handle) - 1) % 3];
  const vec3 toEye = glm::normalize(view.eye - a.origin);
  constexpr float kFlat = 0.1f;  // cosine between axis and view
  if (std::abs(glm::dot(axis, toEye)) > kFlat) return std::nullopt;
  const vec3 nearest = glm::normalize(toEye - glm::dot(toEye, axis) * axis);
  constexpr float kStep = 0.01f;  // rad
  const auto from = projectPoint(view, a.origin + a.size * nearest);
  const auto to = projectPoint(
      view, a.origin + a.size * glm::normalize(nearest + kStep * glm::cross(axis, nearest)));
  if (!from || !to || glm::length(*to - *from) < 0.1f * kStep * kReach) return std::nullopt;
  return (*to - *from) / kStep;
}

void Gizmo::begin(const View& view, const Axes& axes, Handle handle, const vec2& pointer,
                  const Document& document) {
  const auto pull = pullOf(view, axes, handle);
  const auto grip = gripOf(view, axes, handle, pointer);
  if (!grip && !pull) return;
  Drag d{handle, axes, pointer, grip.value_or(vec3(0.0f)), pull, {}, {}, {}};
  for (const NodeId id : topmost(document.scene, document.selection)) {
    const Node& n = *document.scene.find(id);
    if (isLocked(document.scene, id)) continue;
    const mat4 parent = worldMatrix(document.scene, n.parent);
    if (!hasVolume(parent)) continue;
    d.nodes.push_back(n);
    d.parents.push_back(parent);
  }
  if (!d.nodes.empty()) drag_ = std::move(d);
}

std::vector<Node> Gizmo::moved(const vec3& offset) const {
  std::vector<Node> nodes = drag_->nodes;
  for (size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].local.translation += glm::inverse(mat3(drag_->parents[i])) * offset;
  }
  return nodes;
}

std::vector<Node> Gizmo::rotated(const vec3& axis, float angle) const {
  std::vector<Node> nodes = drag_->nodes;
  const quat turn = glm::angleAxis(angle, axis);
  for (size_t i = 0; i < nodes.size(); ++i) {
    Transform& local = nodes[i].local;
    const vec3 place = vec3(drag_->parents[i] * vec4(local.translation, 1.0f));
    const vec3 newPlace = drag_->axes.origin + turn * (place - drag_->axes.origin);
    const mat4 toParent = glm::inverse(drag_->parents[i]);
    if (const auto parentTurn = turnOf(mat3(drag_->parents[i]))) {
      // Keep scale and shear bit for bit.
      local.rotation =
          glm::normalize(glm::inverse(*parentTurn) * turn * *parentTurn * local.rotation);
      local.translation = vec3(toParent * vec4(newPlace, 1.0f));
    } else {
      mat4 world = glm::mat4_cast(turn) * (drag_->parents[i] * toMatrix(local));
      world[3] = vec4(newPlace, 1.0f);
      local = decompose(toParent * world);
    }
  }
  return nodes;
}

std::vector<Node> Gizmo::scaled(const vec3& factors) const {
  std::vector<Node> nodes = drag_->nodes;
  const mat3& axes = drag_->axes.axes;
  for (size_t i = 0; i < nodes.size(); ++i) {
    Transform& local = nodes[i].local;
    const vec3 place = vec3(drag_->parents[i] * vec4(local.translation, 1.0f));
    const vec3 newPlace = drag_->axes.origin +
                          axes * (factors * (glm::transpose(axes) * (place - drag_->axes.origin)));
    local.translation = vec3(glm::inverse(drag_->parents[i]) * vec4(newPlace, 1.0f));
    local.scale *= factors;
  }
  return nodes;
}

std::optional<std::vector<Node>> Gizmo::dragged(const View& view, const vec2& pointer,
                                                bool snapping) const {
  const Drag& d = *drag_;
  if (d.pull) {
    float angle = glm::dot(pointer - d.pointer, *d.pull) / glm::dot(*d.pull, *d.pull);
    if (snapping) angle = snapped(angle, kTurnStep);
    return rotated(d.axes.axes[(static_cast<int>(d.handle) - 1) % 3], angle);
  }
  const auto grip = gripOf(view, d.axes, d.handle, pointer);
  if (!grip) return std::nullopt;
  const int index = (static_cast<int>(d.handle) - 1) % 3;
  switch (mode) {
    case ToolMode::move: {
      vec3 offset = *grip - d.grip;
      if (snapping) {
        for (int i = 0; i < 3; ++i) offset[i] = snapped(offset[i], kMoveStep * unit);
      }
      return moved(offset);
    }
    case ToolMode::rotate: {
      const vec3 axis = d.handle == Handle::screen ? -view.forward() : d.axes.axes[index];
      if (glm::length(*grip) <= 0.0f || glm::length(d.grip) <= 0.0f) return d.nodes;
      const vec3 from = glm::normalize(d.grip), to = glm::normalize(*grip);
      float angle = std::atan2(glm::dot(glm::cross(from, to), axis), glm::dot(from, to));
      if (snapping) angle = snapped(angle, kTurnStep);
      return rotated(axis, angle);
    }
    case ToolMode::scale: {
      vec3 factors(1.0f);
      if (d.handle == Handle::screen) {
        // Moving right or up enlarges. Moving by the length of a handle doubles the size.
        const vec2 way = pointer - d.pointer;
        float f = std::exp2((way.x - way.y) / kReach);
        if (snapping) f = std::max(snapped(f, kScaleStep), kScaleStep);
        factors = vec3(f);
      } else {
        const float before = glm::dot(d.grip, d.axes.axes[index]),
                    now = glm::dot(*grip, d.axes.axes[index]);
        float f = std::abs(before) > 1e-6f ? std::max(now / before, 0.01f) : 1.0f;
        if (snapping) f = std::max(snapped(f, kScaleStep), kScaleStep);
        factors[index] = f;
      }
      return scaled(factors);
    }
    case ToolMode::select:
      break;
  }
  return d.nodes;
}

bool Gizmo::update(const View& view, const ViewportInput& in, Editing& editing,
                   const SurfaceSnap& surface) {
  if (drag_ && !drag_->edit.isOpen()) drag_.reset();  // other code has ended the step
  if (drag_) {
    if (in.keys.contains(Key::escape) || in.pressed[1]) {
      cancel();
      return true;
    }
    static constexpr const char* kLabels[] = {"Select", "Move", "Rotate", "Scale"};
    const std::string name = drag_->nodes.size() == 1
                                 ? drag_->nodes[0].name
                                 : std::to_string(drag_->nodes.size()) + " objects";
    std::optional<std::vector<Node>> nodes;
    const bool snapping = snap != in.modifiers.ctrl;
    const bool follows = in.modifiers.shift || (snapping && snapTo != SnapTo::grid);
    if (mode == ToolMode::move && follows && surface) {
      const SnapTo target = in.modifiers.shift ? SnapTo::surface : snapTo;
      if (const auto place = surface(target)) nodes = moved(*place - drag_->axes.origin);
    } else {
      nodes = dragged(view, in.pointer, snapping);
    }
    // If the pointer has no valid position, for example beyond the horizon, keep the last state.
    if (nodes) {
      setNodes(editing, std::string(kLabels[static_cast<int>(mode)]) + " " + name,
               std::move(*nodes));
    }
    if (in.released[0] || !in.down[0]) finish();
    return true;
  }
  const Document& document = editing.document();
  const auto axes = axesOf(view, document);
  hovered_ = axes && in.hovered ? handleAt(view, *axes, in.pointer) : Handle::none;
  if (hovered_ == Handle::none || !in.pressed[0]) return false;
  begin(view, *axes, hovered_, in.pointer, document);
  if (!drag_) return false;
  editing.commit();
  drag_->edit = editing.begin("");  // named by the first move
  return true;
}

void Gizmo::finish() {
  if (drag_) drag_->edit.commit();
  drag_.reset();
}

void Gizmo::draw(Overlay& overlay, const View& view, const Document& document) const {
  const auto axes = axesOf(view, document);
  if (!axes) return;
  const Handle lit = drag_ ? drag_->handle : hovered_;
  const auto colour = [&](Handle h, const vec4& own) { return h == lit ? kHoverColour : own; };
  const auto centre = projectPoint(view, axes->origin);
  if (!centre) return;

  for (int i = 0; i < 3; ++i) {
    const Handle handle = static_cast<Handle>(static_cast<int>(Handle::x) + i);
    const vec4 c = colour(handle, kAxisColours[i]);
    if (mode == ToolMode::rotate) {
      const auto points =
          circle(axes->origin, axes->axes[(i + 1) % 3], axes->axes[(i + 2) % 3], axes->size);
      for (size_t k = 0; k < points.size(); ++k) {
        const bool far = glm::dot(points[k] - axes->origin, view.eye - axes->origin) < 0.0f;
        addLine(overlay, view, points[k], points[(k + 1) % points.size()],
                far ? c * vec4(1, 1, 1, 0.25f) : c, far ? 1.0f : 2.5f);
      }
      continue;
    }
    const vec3 end = axes->origin + axes->size * axes->axes[i];
    addLine(overlay, view, axes->origin, end, c, 2.5f);
    if (const auto tip = projectPoint(view, end)) {
      const vec2 way = *tip - *centre;
      const float length = std::max(glm::length(way), 1e-3f);
      const vec2 d = way / length, n(-d.y, d.x);
      if (mode == ToolMode::move) {
        overlay.shapes.push_back(
            {{*tip + 6.0f * d, *tip - 8.0f * d + 5.0f * n, *tip - 8.0f * d - 5.0f * n},
             true,
             true,
             c,
             1.0f});
      } else {
        overlay.shapes.push_back({{*tip + 5.0f * (d + n), *tip + 5.0f * (d - n),
                                   *tip - 5.0f * (d + n), *tip - 5.0f * (d - n)},
                                  true,
                                  true,
                                  c,
                                  1.0f});
      }
    }
    if (mode == ToolMode::move) {
      const Handle plane = static_cast<Handle>(static_cast<int>(Handle::yz) + i);
      const std::vector<vec2> quad = planeSquare(view, *axes, i);
      if (quad.size() == 4)
        overlay.shapes.push_back(
            {quad, true, true, colour(plane, kAxisColours[i]) * vec4(1, 1, 1, 0.45f), 1.0f});
    }
  }
  const float radius = mode == ToolMode::rotate ? kScreenRing * kReach : 6.0f;
  std::vector<vec2> ring;
  for (int i = 0; i < 48; ++i) {
    const float a = 2.0f * kPi * static_cast<float>(i) / 48.0f;
    ring.push_back(*centre + radius * vec2(std::cos(a), std::sin(a)));
  }
  overlay.shapes.push_back(
      {ring, true, mode != ToolMode::rotate, colour(Handle::screen, kScreenColour), 1.5f});
}

}  // namespace lamplighter
