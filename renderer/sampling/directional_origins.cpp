#include "renderer/sampling/directional_origins.h"

#include "renderer/base/random.h"

namespace lamplighter {

namespace {

// The fraction of paths that is distributed uniformly over the level, so that every part gets some.
constexpr float kEvenStarts = 0.25f;

}  // namespace

DirectionalOrigins::DirectionalOrigins(const RenderScene& scene, const vec3& centre, float radius)
    : whole_{centre, radius} {
  std::vector<float> weights;
  for (const RenderObject& o : scene.objects) {
    const float r = o.bounds.radius();
    if (!(r > 0.0f)) continue;
    balls_.push_back({o.bounds.centre(), r});
    weights.push_back(static_cast<float>(o.triangleCount()));
  }
  choice_ = AliasTable(weights);
}

DirectionalOrigins::Point DirectionalOrigins::sample(const vec3& towards, vec2 u, float v) const {
  size_t chosen = balls_.size();  // the whole level
  if (v >= kEvenStarts && !choice_.empty()) {
    float rest;
    chosen = choice_.sample((v - kEvenStarts) / (1.0f - kEvenStarts), rest);
  }
  const Ball& ball = chosen == balls_.size() ? whole_ : balls_[chosen];
  const vec2 d = ball.radius * sampleDisk(u);
  vec3 p = ball.centre + Frame(towards).toWorld(vec3(d, 0.0f));
  p -= glm::dot(p - whole_.centre, towards) * towards;
  return {p, pdfAt(p, towards, chosen)};
}

// The density of the mixture: the sum over all discs that contain the point. The chosen disc always
// counts, even if rounding puts the point outside its rim.
float DirectionalOrigins::pdfAt(const vec3& position, const vec3& towards, size_t chosen) const {
  const auto density = [&](const Ball& b, bool isChosen) {
    const vec3 d = position - b.centre;
    const vec3 across = d - glm::dot(d, towards) * towards;
    const bool within = isChosen || glm::dot(across, across) <= b.radius * b.radius;
    return within ? 1.0f / (kPi * b.radius * b.radius) : 0.0f;
  };
  const float even = density(whole_, chosen == balls_.size());
  if (choice_.empty()) return even;
  float sum = 0.0f;
  for (size_t i = 0; i < balls_.size(); ++i) {
    sum += choice_.probability(i) * density(balls_[i], i == chosen);
  }
  return kEvenStarts * even + (1.0f - kEvenStarts) * sum;
}

}  // namespace lamplighter
