#include "editor/explain/explainer.h"

#include <algorithm>
#include <cmath>

#include "editor/tools/projection.h"
#include "renderer/base/error.h"
#include "renderer/image/tone_map.h"
#include "renderer/scene/units.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

const vec4 kPoint{1.0f, 1.0f, 1.0f, 1.0f};
const vec4 kSeen{0.55f, 0.9f, 0.55f, 0.8f};
const vec4 kHidden{0.95f, 0.35f, 0.3f, 0.8f};
constexpr size_t kMostLines = 64;  // more lines would be unreadable
const vec4 kOutline{0.0f, 0.0f, 0.0f, 0.6f};
constexpr float kLeastAlpha = 0.35f;
constexpr float kLeastDot = 1.5f, kLargestDot = 4.5f;  // radius [px]

// The hue of light in full brightness, as a display colour.
vec3 encodedColour(const vec3& light) {
  const float most = std::max({light.r, light.g, light.b, 1e-30f});
  return {encodeSrgb(light.r / most), encodeSrgb(light.g / most), encodeSrgb(light.b / most)};
}

// Lines from a point to the places of a sender, and a dot on each place, no larger than it seems.
// World space and view in the unit of the scene.
void drawSender(Overlay& overlay, const View& view, const vec3& from, const LightSender& sender) {
  // The strongest are drawn last, over the others.
  for (size_t i = sender.places.size(); i-- > 0;) {
    const LightSender::Place& place = sender.places[i];
    const float share = std::sqrt(place.irradiance() / sender.places.front().irradiance());
    const vec4 own(encodedColour(place.light), kLeastAlpha + (1.0f - kLeastAlpha) * share);
    addLine(overlay, view, from, place.position, kOutline * vec4(1, 1, 1, own.a), 3.0f);
    addLine(overlay, view, from, place.position, own, 1.6f);
    const auto at = projectPoint(view, place.position);
    if (!at) continue;
    const float seeming = 0.5f * place.size / metresPerPixel(view, place.position);
    const float radius = std::clamp(share * kLargestDot, kLeastDot, std::max(seeming, kLeastDot));
    OverlayShape dot;
    for (const vec3& p : circle(vec3(*at, 0.0f), vec3(1, 0, 0), vec3(0, 1, 0), radius, 12))
      dot.points.emplace_back(p);
    dot.closed = dot.filled = true;
    dot.colour = own;
    overlay.shapes.push_back(dot);
  }
}

}  // namespace

void Explainer::ask(const Scene& scene, const RenderScene& world, const RayCaster& rays,
                    const PickedPoint& point, const LightSamples& samples,
                    const Inspection& inspection) {
  anchor_.emplace(scene, point);
  answer_ = explain(scene, world, rays, point, samples);
  senders_ = lightSenders(scene, world, rays, inspection, answer_->point);
  chosenSender_.reset();
  hasChosenAll_ = false;
  // First choice: the light that would contribute most but is blocked. Otherwise: the light that
  // contributes most.
  const auto worst = std::max_element(
      answer_->lights.begin(), answer_->lights.end(),
      [](const LightShare& a, const LightShare& b) { return a.withheld < b.withheld; });
  chosen_.reset();
  if (worst != answer_->lights.end() && worst->withheld > 0.0f)
    chosen_ = worst->light;
  else if (!answer_->lights.empty())
    chosen_ = answer_->lights.front().light;
}

void Explainer::askAgain(const Scene& scene, const RenderScene& world, const RayCaster& rays,
                         const LightSamples& samples, const Inspection& inspection) {
  if (!anchor_) return;
  const auto point = anchor_->placedIn(scene);
  if (!point) return close();
  answer_ = explain(scene, world, rays, *point, samples);
  senders_ = lightSenders(scene, world, rays, inspection, answer_->point);
}

const LightShare* Explainer::chosen() const {
  if (!answer_ || !chosen_ || chosenSender_ || hasChosenAll_) return nullptr;
  const auto found = std::find_if(answer_->lights.begin(), answer_->lights.end(),
                                  [&](const LightShare& l) { return l.light == *chosen_; });
  return found == answer_->lights.end() ? nullptr : &*found;
}

const LightShare& Explainer::row(int index) const {
  const size_t count = answer_ ? answer_->lights.size() : 0;
  if (index < 0 || static_cast<size_t>(index) >= count)
    throw InputError("light " + std::to_string(index), "does not exist",
                     count == 0 ? "point at a surface first, with explain.at X Y"
                                : "give one from 0 to " + std::to_string(count - 1));
  return answer_->lights[static_cast<size_t>(index)];
}

void Explainer::choose(int index) {
  chosen_ = row(index).light;
  chosenSender_.reset();
  hasChosenAll_ = false;
}

const LightSender* Explainer::chosenSender() const {
  if (!answer_) return nullptr;
  if (hasChosenAll_) return &senders_.all;
  if (!chosenSender_) return nullptr;
  const auto found = std::ranges::find(senders_.rows, *chosenSender_, &LightSender::key);
  return found == senders_.rows.end() ? nullptr : &*found;
}

void Explainer::requireSenders() const {
  const std::string what = "bounced light";
  if (!answer_)
    throw InputError(what, "no point is chosen", "point at a surface first, with explain.at X Y");
  if (!senders_.problem.empty()) throw InputError(what, senders_.problem, senders_.remedy);
  if (senders_.rows.empty()) throw InputError(what, "none arrives", "explain another point");
}

const LightSender& Explainer::senderRow(int index) const {
  requireSenders();
  const size_t count = senders_.rows.size();
  if (index < 0 || static_cast<size_t>(index) >= count)
    throw InputError("surface " + std::to_string(index), "does not exist",
                     "give one from 0 to " + std::to_string(count - 1));
  return senders_.rows[static_cast<size_t>(index)];
}

void Explainer::chooseSender(int index) {
  chosenSender_ = senderRow(index).key;
  hasChosenAll_ = false;
}

void Explainer::chooseAllSenders() {
  requireSenders();
  chosenSender_.reset();
  hasChosenAll_ = true;
}

NodeId Explainer::senderObject(int index) const {
  const LightSender& sender = senderRow(index);
  if (sender.key.node == kNoNode)
    throw InputError("surface " + std::to_string(index), "represents several objects",
                     "give one before it");
  return sender.key.node;
}

NodeId Explainer::blocker(int index, int which) const {
  const LightShare& light = row(index);
  if (which < 0 || static_cast<size_t>(which) >= light.blockers.size())
    throw InputError("blocker " + std::to_string(which) + " of " + light.name, "does not exist",
                     light.blockers.empty()
                         ? "nothing blocks this light"
                         : "give one from 0 to " + std::to_string(light.blockers.size() - 1));
  return light.blockers[static_cast<size_t>(which)].node;
}

void Explainer::draw(Overlay& overlay, const View& metres, const RenderScene& world,
                     const RayCaster& rays, const LightSamples& samples) const {
  if (!answer_) return;
  const View view = inUnits(metres, world.unit);
  const PickedPoint p = inUnits(answer_->point, world.unit);
  if (const LightShare* light = chosen()) {
    std::vector<const LightSamples::Sample*> facing;
    for (const LightSamples::Sample& s : samples.samples)
      if (s.id.light == light->light && s.id.bounce == 0 &&
          shared::vplGeometry(s.vpl, p.position, p.normal, p.geometricNormal, 0.0f) > 0.0f)
        facing.push_back(&s);
    const size_t step = (facing.size() + kMostLines - 1) / kMostLines;
    for (size_t i = 0; i < facing.size(); i += step) {
      const Ray ray = rayTo(p, facing[i]->vpl);
      const Hit hit = rays.intersect(ray);
      // Parallel light comes from outside the level.
      const float end = std::isfinite(ray.tFar) ? ray.tFar : 2.0f * world.bounds.radius();
      const float t = hit ? hit.t : end;
      addLine(overlay, view, ray.origin, ray.origin + t * ray.direction, hit ? kHidden : kSeen,
              1.0f);
    }
  }
  if (const LightSender* sender = chosenSender()) drawSender(overlay, view, p.position, *sender);
  const float size = metresPerPixel(view, p.position);
  const Frame frame(p.geometricNormal);
  addLoop(overlay, view, circle(p.position, frame.tangent, frame.bitangent, 9.0f * size, 24),
          vec4(0, 0, 0, 0.6f), 4.0f);
  addLoop(overlay, view, circle(p.position, frame.tangent, frame.bitangent, 9.0f * size, 24),
          kPoint, 2.0f);
  addLine(overlay, view, p.position, p.position + 22.0f * size * p.geometricNormal, kPoint, 2.0f);
}

}  // namespace lamplighter
