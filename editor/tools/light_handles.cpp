#include "editor/tools/light_handles.h"

#include <algorithm>
#include <cmath>

#include "editor/edits/edits.h"
#include "editor/edits/placement.h"
#include "editor/tools/projection.h"

namespace lamplighter {

namespace {

constexpr float kHandleGrab = 8.0f;    // px
constexpr float kHandleReach = 60.0f;  // distance of the aim and cone handles from the light [px]
constexpr float kLeast = 0.001f;       // smallest size [units]
constexpr float kSizeStep = 0.05f;     // units
constexpr float kConeStep = kPi / 36.0f;  // 5°
constexpr float kMostCone = 0.5f * kPi;   // glTF's limit of a spot's cones
constexpr float kLeastCone = 0.01f;       // rad

const vec4 kColour{1.0f, 0.93f, 0.6f, 1.0f};
// An edge around each handle makes it visible on bright walls.
const vec4 kEdgeColour{0.0f, 0.0f, 0.0f, 0.6f};
constexpr float kEdge = 1.5f;  // px

struct Place {
  vec3 origin, aim;  // aim: unit vector in which the light shines
  float reach;       // m
};

std::optional<Place> placeOf(const View& view, const mat4& world) {
  Place p;
  p.origin = vec3(world[3]);
  const vec3 aim = mat3(world) * vec3(0, 0, -1);
  if (!(glm::length(aim) > 0.0f)) return std::nullopt;
  if (glm::dot(p.origin - view.eye, view.forward()) < view.znear) return std::nullopt;
  p.aim = glm::normalize(aim);
  p.reach = kHandleReach * metresPerPixel(view, p.origin);
  return p;
}

// The direction from the axis to a cone's handle. It is perpendicular to the line of sight, so that
// it lies in the picture plane as far as possible.
vec3 sideOf(const View& view, const vec3& aim) {
  const vec3 side = glm::cross(view.forward(), aim);
  return glm::length(side) > 1e-3f ? glm::normalize(side) : view.right();
}

float snappedUp(float value, float step) { return std::max(step, std::round(value / step) * step); }

// A circle or a square.
std::vector<vec2> outlineOf(const vec2& centre, float r, bool isRound) {
  if (!isRound)
    return {centre + vec2(-r, -r), centre + vec2(r, -r), centre + vec2(r, r), centre + vec2(-r, r)};
  std::vector<vec2> points;
  for (int i = 0; i < 16; ++i) {
    const float a = 2.0f * kPi * static_cast<float>(i) / 16.0f;
    points.push_back(centre + r * vec2(std::cos(a), std::sin(a)));
  }
  return points;
}

bool isBall(const AreaLight& light) { return light.shape == AreaShape::sphere; }
bool isTube(const AreaLight& light) { return light.shape == AreaShape::tube; }

// The normal of the plane through a tube's axis (X) that faces the eye as far as possible.
vec3 facingNormal(const View& view, const mat4& world) {
  const vec3 axis = glm::normalize(vec3(world[0]));
  const vec3 normal = view.forward() - glm::dot(view.forward(), axis) * axis;
  return glm::length(normal) > 1e-3f ? glm::normalize(normal) : view.up();
}

}  // namespace

std::vector<LightHandles::Handle> LightHandles::handlesOf(const View& view,
                                                          const Document& document) {
  std::vector<Handle> out;
  const Node* node = document.scene.find(document.active());
  if (node == nullptr || (!node->area && !node->punctual)) return out;
  for (const Node* n = node; n != nullptr; n = document.scene.find(n->parent))
    if (!n->visible || n->locked) return out;
  const mat4 world = worldMatrix(document.scene, node->id);
  const auto place = placeOf(view, world);
  if (!place || !hasVolume(world)) return out;
  const auto at = [&](float x, float y) { return vec3(world * vec4(x, y, 0.0f, 1.0f)); };
  if (node->area) {
    const float x = 0.5f * node->area->size.x, y = 0.5f * node->area->size.y;
    if (node->area->shape == AreaShape::rectangle) {
      out = {{Kind::right, at(x, 0)},
             {Kind::left, at(-x, 0)},
             {Kind::top, at(0, y)},
             {Kind::bottom, at(0, -y)}};
    } else if (isBall(*node->area)) {
      // On the visible outline.
      const mat3 toWorld(world);
      const vec3 right = glm::normalize(glm::inverse(toWorld) * view.right());
      out = {{Kind::rim, vec3(world[3]) + toWorld * (x * right)}};
    } else if (isTube(*node->area)) {
      const vec3 across = glm::cross(facingNormal(view, world), vec3(world[0]));
      const vec3 local = glm::normalize(glm::inverse(mat3(world)) * across);
      out = {{Kind::right, at(x, 0)},
             {Kind::left, at(-x, 0)},
             {Kind::rim, vec3(world * vec4(y * local, 1.0f))}};
    } else {
      out = {{Kind::rim, at(x, 0)},
             {Kind::rim, at(-x, 0)},
             {Kind::rim, at(0, x)},
             {Kind::rim, at(0, -x)}};
    }
  }
  const bool aims = node->area ? !isBall(*node->area) && !isTube(*node->area)
                               : node->punctual->kind != PunctualKind::point;
  if (aims) out.push_back({Kind::aim, place->origin + place->reach * place->aim});
  if (node->punctual && node->punctual->kind == PunctualKind::spot) {
    const vec3 side = sideOf(view, place->aim);
    const auto onCone = [&](float angle, float sign) {
      return place->origin +
             place->reach * (std::cos(angle) * place->aim + sign * std::sin(angle) * side);
    };
    out.push_back({Kind::outerCone, onCone(node->punctual->outerCone, 1.0f)});
    out.push_back({Kind::innerCone, onCone(node->punctual->innerCone, -1.0f)});
  }
  return out;
}

bool LightHandles::update(const View& view, const ViewportInput& in, Editing& editing, bool snap,
                          const AimTarget& target) {
  if (drag_ && !drag_->edit.isOpen()) drag_.reset();  // other code has ended the step
  if (drag_) {
    if (in.keys.contains(Key::escape) || in.pressed[1]) {
      cancel();
      return true;
    }
    if (const auto node = dragged(view, in, snap != in.modifiers.ctrl, target)) {
      const std::string verb = drag_->kind == Kind::aim ? "Aim " : "Resize ";
      setNodes(editing, verb + node->name, {*node});
    }
    if (in.released[0] || !in.down[0]) finish();
    return true;
  }
  hovered_ = Kind::none;
  if (!in.hovered) return false;
  const Document& document = editing.document();
  float nearest = kHandleGrab;
  for (const Handle& handle : handlesOf(view, document)) {
    const auto point = projectPoint(view, handle.place);
    if (!point || glm::length(*point - in.pointer) >= nearest) continue;
    nearest = glm::length(*point - in.pointer);
    hovered_ = handle.kind;
  }
  if (hovered_ == Kind::none || !in.pressed[0]) return false;
  const Node& node = *document.scene.find(document.active());
  const mat4 parent = worldMatrix(document.scene, node.parent);
  editing.commit();
  drag_ = Drag{hovered_, node, parent * toMatrix(node.local), parent, editing.begin("")};
  return true;
}

std::optional<Node> LightHandles::dragged(const View& view, const ViewportInput& in, bool snapping,
                                          const AimTarget& target) const {
  const auto place = placeOf(view, drag_->world);
  if (!place) return std::nullopt;
  if (drag_->kind == Kind::aim) {
    // Aims at the surface under the pointer or, if there is none, at a point at the light's
    // distance.
    std::optional<vec3> at = target ? target() : std::nullopt;
    if (!at) at = onPlane(view, in.pointer, place->origin, view.forward());
    return at ? aimed(*at) : std::nullopt;
  }
  const bool isCone = drag_->kind == Kind::outerCone || drag_->kind == Kind::innerCone;
  vec3 normal = place->aim;
  if (isCone) normal = glm::cross(sideOf(view, place->aim), place->aim);
  if (drag_->node.area && isBall(*drag_->node.area)) normal = view.forward();
  if (drag_->node.area && isTube(*drag_->node.area)) normal = facingNormal(view, drag_->world);
  const auto at = onPlane(view, in.pointer, place->origin, normal);
  if (!at) return std::nullopt;
  return isCone ? widened(*at, snapping) : resized(*at, in.modifiers.shift, snapping);
}

std::optional<Node> LightHandles::resized(const vec3& at, bool bothSides, bool snapping) const {
  Node node = drag_->node;
  vec2& size = node.area->size;
  const vec3 p(glm::inverse(drag_->world) * vec4(at, 1.0f));
  const auto rounded = [&](float value) {
    return std::max(kLeast * unit, snapping ? snappedUp(value, kSizeStep * unit) : value);
  };
  if (drag_->kind == Kind::rim && isTube(*node.area)) {
    size.y = rounded(2.0f * glm::length(vec2(p.y, p.z)));
    return node;
  }
  if (drag_->kind == Kind::rim) {
    size.x = size.y = rounded(2.0f * glm::length(isBall(*node.area) ? p : vec3(p.x, p.y, 0.0f)));
    return node;
  }
  const int axis = drag_->kind == Kind::right || drag_->kind == Kind::left ? 0 : 1;
  const float sign = drag_->kind == Kind::right || drag_->kind == Kind::top ? 1.0f : -1.0f;
  const float before = size[axis];
  const float out = sign * p[axis];  // from the centre to the new position of the edge
  size[axis] = rounded(bothSides ? 2.0f * out : out + 0.5f * before);
  if (!bothSides) {
    vec3 middle(0.0f);
    middle[axis] = sign * 0.5f * (size[axis] - before);
    node.local.translation = vec3(toMatrix(drag_->node.local) * vec4(middle, 1.0f));
  }
  return node;
}

// Rotates the light by the smallest angle so that it aims at the point.
std::optional<Node> LightHandles::aimed(const vec3& at) const {
  Node node = drag_->node;
  const vec3 way = at - vec3(drag_->world[3]);
  if (!(glm::length(way) > 1e-4f)) return std::nullopt;
  const quat now = decompose(drag_->world).rotation;
  const quat parent = decompose(drag_->parent).rotation;
  node.local.rotation = glm::normalize(glm::inverse(parent) *
                                       leastTurn(now * vec3(0, 0, -1), glm::normalize(way)) * now);
  return node;
}

std::optional<Node> LightHandles::widened(const vec3& at, bool snapping) const {
  Node node = drag_->node;
  PunctualLight& light = *node.punctual;
  const vec3 aim = glm::normalize(mat3(drag_->world) * vec3(0, 0, -1));
  const vec3 way = at - vec3(drag_->world[3]);
  const float along = glm::dot(way, aim);
  float angle = std::atan2(glm::length(way - along * aim), along);
  if (snapping) angle = snappedUp(angle, kConeStep);
  if (drag_->kind == Kind::outerCone) {
    light.outerCone = std::clamp(angle, kLeastCone, kMostCone);
    light.innerCone = std::min(light.innerCone, light.outerCone);
  } else {
    light.innerCone = std::clamp(angle, 0.0f, light.outerCone);
  }
  return node;
}

void LightHandles::finish() {
  if (drag_) drag_->edit.commit();
  drag_.reset();
}

void LightHandles::draw(Overlay& overlay, const View& view, const Document& document) const {
  const Kind lit = drag_ ? drag_->kind : hovered_;
  const Node* node = document.scene.find(document.active());
  for (const Handle& handle : handlesOf(view, document)) {
    const auto p = projectPoint(view, handle.place);
    if (!p) continue;
    const vec4 colour = handle.kind == lit ? kHoverColour : kColour;
    const float r = handle.kind == lit ? 5.5f : 4.0f;
    const bool isRound = handle.kind == Kind::aim || handle.kind == Kind::innerCone ||
                         handle.kind == Kind::outerCone;
    if (isRound) {
      const vec3 origin(worldMatrix(document.scene, node->id)[3]);
      addLine(overlay, view, origin, handle.place, kEdgeColour, 3.5f);
      addLine(overlay, view, origin, handle.place, colour);
    }
    overlay.shapes.push_back({outlineOf(*p, r + kEdge, isRound), true, true, kEdgeColour, 1.0f});
    overlay.shapes.push_back(
        {outlineOf(*p, r, isRound), true, handle.kind != Kind::innerCone, colour, 1.5f});
  }
}

}  // namespace lamplighter
