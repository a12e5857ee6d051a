#include "renderer/light_field/field_partners.h"

#include <gtest/gtest.h>

#include "renderer/base/random.h"
#include "tests/renderer/light_field/field_room.h"

namespace lamplighter {
namespace {

using test::FieldRoom;

// In a closed room all light comes from texels, and even light stays even: each bounce adds ρᵏ.
TEST(FieldPartners, AFurnaceGivesTheGeometricSeries) {
  for (const FieldSight sight : {FieldSight::lines, FieldSight::rays}) {
    const FieldRoom room;
    const std::vector<uint32_t> partners = room.partners(sight);
    const auto texels = static_cast<uint32_t>(room.receivers.size());
    for (size_t d = 0; d < room.directions.size(); ++d)
      for (uint32_t t = 0; t < texels; ++t)
        if (!room.receivers[t].isBuried) {
          ASSERT_LT(partners[d * texels + t], texels) << "of direction " << d;
        }
    constexpr float kLight = 3.0f, kAlbedo = 0.6f;
    PartnerRadiance radiance(room.numbers().dark() + 1, vec4(0.0f));
    std::fill_n(radiance.begin(), texels, vec4(kLight, kLight, kLight, 0.0f));
    float expected = kPi * kLight, factor = 1.0f;
    std::vector<vec3> irradiance;
    std::vector<float> total(texels, 0.0f);
    for (int bounce = 0; bounce < 5; ++bounce) {
      irradiance = room.gathered(partners, radiance);
      for (uint32_t t = 0; t < texels; ++t) {
        if (room.receivers[t].isBuried) continue;
        EXPECT_NEAR(irradiance[t].g, factor * expected, 1e-4f * expected);
        total[t] += irradiance[t].g;
        radiance[t] = vec4(kAlbedo * irradiance[t] / kPi, 0.0f);
      }
      factor *= kAlbedo;
    }
    const float series = (1.0f - std::pow(kAlbedo, 5.0f)) / (1.0f - kAlbedo);
    for (uint32_t t = 0; t < texels; ++t)
      if (!room.receivers[t].isBuried) {
        EXPECT_NEAR(total[t], expected * series, 1e-4f * expected * series);
      }
  }
}

// What all texels send, all texels receive.
TEST(FieldPartners, SentLightIsReceived) {
  const FieldRoom room(16, 0.2f);
  const std::vector<uint32_t> partners = room.partners(FieldSight::lines);
  PartnerRadiance radiance(room.numbers().dark() + 1, vec4(0.0f));
  double sent = 0.0, received = 0.0;
  for (size_t t = 0; t < room.receivers.size(); ++t) {
    if (room.receivers[t].isBuried) continue;
    // Walls of different brightness.
    const vec3& n = room.receivers[t].geometricNormal;
    radiance[t] = vec4(vec3(1.0f + n.x + 0.5f * n.y), 0.0f);
    sent += static_cast<double>(room.texels[t].area * kPi * radiance[t].x);
  }
  const std::vector<vec3> irradiance = room.gathered(partners, radiance);
  for (size_t t = 0; t < room.receivers.size(); ++t)
    if (!room.receivers[t].isBuried)
      received += static_cast<double>(room.texels[t].area * irradiance[t].x);
  RecordProperty("receivedToSent", std::to_string(received / sent));
  EXPECT_NEAR(received / sent, 1.0, 0.001);
}

TEST(FieldPartners, LinesSeeWhatRaysSee) {
  const FieldRoom room(16, 0.2f);
  PartnerCounts byLines;
  const std::vector<uint32_t> lines = room.partners(FieldSight::lines, &byLines);
  const std::vector<uint32_t> rays = room.partners(FieldSight::rays);
  // Fewer than one in ten needs a ray.
  EXPECT_LT(byLines.rays, byLines.samples / 10);
  PartnerRadiance radiance(room.numbers().dark() + 1, vec4(0.0f));
  for (size_t t = 0; t < room.receivers.size(); ++t)
    radiance[t] = vec4(vec3(toUnitFloat(hash4(room.receivers[t].object,
                                              static_cast<uint32_t>(room.texels[t].chart), 0, 1))),
                       0.0f);
  const std::vector<vec3> a = room.gathered(lines, radiance), b = room.gathered(rays, radiance);
  double error = 0.0, sum = 0.0;
  for (size_t t = 0; t < a.size(); ++t) {
    if (room.receivers[t].isBuried) continue;
    error += static_cast<double>(std::abs(a[t].x - b[t].x));
    sum += static_cast<double>(b[t].x);
  }
  RecordProperty("meanError", std::to_string(error / sum));
  EXPECT_LT(error / sum, 0.01);
}

// A square texel far below a square of the ceiling that alone sends light: the closed form of the
// form factor of a point to a rectangle, for more and more directions.
TEST(FieldPartners, APolygonLightIsNearItsClosedForm) {
  const auto errorOf = [](int divisions) {
    const FieldRoom room(divisions, 0.2f);
    const std::vector<uint32_t> partners = room.partners(FieldSight::rays);
    PartnerRadiance radiance(room.numbers().dark() + 1, vec4(0.0f));
    const auto isLit = [&](const vec3& p) {
      return p.y > 1.49f && std::abs(p.x) < 1.0f && std::abs(p.z) < 1.0f;
    };
    for (size_t t = 0; t < room.receivers.size(); ++t)
      if (isLit(room.receivers[t].position)) radiance[t] = vec4(1.0f);
    const std::vector<vec3> irradiance = room.gathered(partners, radiance);
    double error = 0.0;
    int count = 0;
    for (size_t t = 0; t < room.receivers.size(); ++t) {
      const FieldReceiver& r = room.receivers[t];
      // Of the floor, beside the box.
      if (r.position.y > -1.49f || r.position.x > -1.0f || r.position.z > -1.0f) continue;
      // A corner of the rectangle below the point: Nusselt's analog for a parallel rectangle.
      const auto corner = [](float a, float b, float h) {
        const float x = a / h, y = b / h, rx = std::sqrt(1.0f + x * x),
                    ry = std::sqrt(1.0f + y * y);
        return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2.0f * kPi);
      };
      const float h = 3.0f;
      const float x0 = -1.0f - r.position.x, x1 = 1.0f - r.position.x;
      const float z0 = -1.0f - r.position.z, z1 = 1.0f - r.position.z;
      const float factor =
          corner(x1, z1, h) - corner(x0, z1, h) - corner(x1, z0, h) + corner(x0, z0, h);
      error += static_cast<double>(std::pow(irradiance[t].x / (kPi * factor) - 1.0f, 2.0f));
      ++count;
    }
    return std::sqrt(error / count);
  };
  const double few = errorOf(8), many = errorOf(32);
  RecordProperty("errorOf129", std::to_string(few));
  RecordProperty("errorOf2049", std::to_string(many));
  EXPECT_LT(few, 0.2);
  EXPECT_LT(many, 0.05);
  EXPECT_LT(many, few / 2.0);
}

}  // namespace
}  // namespace lamplighter
