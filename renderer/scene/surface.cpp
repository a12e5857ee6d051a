#include "renderer/scene/surface.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/brdf.h"

namespace lamplighter {

namespace {

float srgbToLinear(float s) {
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

// A table of 256 values avoids pow() per texel.
struct SrgbTable {
  float linear[256];
  SrgbTable() {
    for (int i = 0; i < 256; ++i) linear[i] = srgbToLinear(static_cast<float>(i) / 255.0f);
  }
};

const SrgbTable& srgbTable() {
  static const SrgbTable table;
  return table;
}

int wrapTexel(int i, int size, Wrap wrap) {
  if (i >= 0 && i < size) return i;  // the usual case, without a division
  switch (wrap) {
    case Wrap::clamp:
      return std::clamp(i, 0, size - 1);
    case Wrap::repeat:
      i %= size;
      return i < 0 ? i + size : i;
    case Wrap::mirror: {
      i %= 2 * size;
      if (i < 0) i += 2 * size;
      return i < size ? i : 2 * size - 1 - i;
    }
  }
  return 0;
}

vec4 texel(const Texture& t, int x, int y, bool srgb) {
  const uint8_t* p =
      t.image->at(wrapTexel(x, t.image->width, t.wrapS), wrapTexel(y, t.image->height, t.wrapT));
  const float alpha = static_cast<float>(p[3]) / 255.0f;
  if (!srgb)
    return vec4(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]),
                0.0f) /
               255.0f +
           vec4(0, 0, 0, alpha);
  const float* table = srgbTable().linear;
  return {table[p[0]], table[p[1]], table[p[2]], alpha};
}

// The three vertices of a triangle and their weights.
struct Corners {
  uint32_t i[3];
  float w[3];
};

Corners corners(const RenderScene& s, uint32_t object, uint32_t triangle, float u, float v) {
  const uint32_t* index = &s.indices[s.objects[object].firstIndex + 3 * triangle];
  return {{index[0], index[1], index[2]}, {1.0f - u - v, u, v}};
}

template <typename T>
T interpolate(const std::vector<T>& values, const Corners& c) {
  return values[c.i[0]] * c.w[0] + values[c.i[1]] * c.w[1] + values[c.i[2]] * c.w[2];
}

vec2 transformed(const TextureRef& ref, const vec2& uv) {
  // KHR_texture_transform: scale, then rotate counter-clockwise about the origin, then offset.
  const vec2 s = uv * ref.scale;
  if (ref.rotation == 0.0f) return s + ref.offset;
  const float c = std::cos(ref.rotation), n = std::sin(ref.rotation);
  return vec2(c * s.x + n * s.y, -n * s.x + c * s.y) + ref.offset;
}

vec4 look(const RenderScene& s, const TextureRef& ref, const Corners& c, bool srgb) {
  return sampleTexture(s.textures[ref.texture],
                       transformed(ref, interpolate(ref.texCoord == 1 ? s.uv1 : s.uv0, c)), srgb);
}

// Tangents if the file has none: in the direction of increasing u in the triangle's plane,
// orthogonal to n.
vec4 tangentOf(const RenderScene& s, const Corners& c, int texCoord, const vec3& n) {
  const vec4 given = interpolate(s.tangents, c);
  const float length = glm::length(vec3(given));
  if (length > 1e-6f) return {vec3(given) / length, given.w < 0.0f ? -1.0f : 1.0f};
  const auto& uv = texCoord == 1 ? s.uv1 : s.uv0;
  const vec3 e1 = s.positions[c.i[1]] - s.positions[c.i[0]],
             e2 = s.positions[c.i[2]] - s.positions[c.i[0]];
  const vec2 d1 = uv[c.i[1]] - uv[c.i[0]], d2 = uv[c.i[2]] - uv[c.i[0]];
  const float det = d1.x * d2.y - d1.y * d2.x;
  if (det == 0.0f) return vec4(0.0f);
  vec3 t = (e1 * d2.y - e2 * d1.y) * (det < 0.0f ? -1.0f : 1.0f);
  t -= n * glm::dot(n, t);
  const float tl = glm::length(t);
  if (tl <= 0.0f) return vec4(0.0f);
  return {t / tl, det < 0.0f ? 1.0f : -1.0f};  // v of glTF points down
}

vec3 mappedNormal(const RenderScene& s, const Material& m, const Corners& c, const vec3& n) {
  if (m.normalTexture.texture == kNone) return n;
  const vec4 tangent = tangentOf(s, c, m.normalTexture.texCoord, n);
  if (tangent.w == 0.0f) return n;
  vec3 t = vec3(tangent) - n * glm::dot(n, vec3(tangent));
  const float tl = glm::length(t);
  if (tl <= 0.0f) return n;
  t /= tl;
  const vec3 b = glm::cross(n, t) * tangent.w;
  vec3 q = vec3(look(s, m.normalTexture, c, false)) * 2.0f - 1.0f;
  q.x *= m.normalScale;
  q.y *= m.normalScale;
  const vec3 mapped = q.x * t + q.y * b + q.z * n;
  const float length = glm::length(mapped);
  return length > 0.0f ? mapped / length : n;
}

}  // namespace

vec4 sampleTexture(const Texture& t, vec2 uv, bool srgb) {
  const float x = uv.x * static_cast<float>(t.image->width),
              y = uv.y * static_cast<float>(t.image->height);
  if (!(std::abs(x) < 1e9f && std::abs(y) < 1e9f)) return texel(t, 0, 0, srgb);  // NaN, overflow
  if (t.nearest)
    return texel(t, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)), srgb);
  const float fx = std::floor(x - 0.5f), fy = std::floor(y - 0.5f);
  const float wx = x - 0.5f - fx, wy = y - 0.5f - fy;
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const vec4 top = texel(t, ix, iy, srgb) * (1.0f - wx) + texel(t, ix + 1, iy, srgb) * wx;
  const vec4 bottom =
      texel(t, ix, iy + 1, srgb) * (1.0f - wx) + texel(t, ix + 1, iy + 1, srgb) * wx;
  return top * (1.0f - wy) + bottom * wy;
}

float alphaAt(const RenderScene& s, uint32_t object, uint32_t triangle, float u, float v) {
  const Material& m = s.materials[s.objects[object].material];
  const Corners c = corners(s, object, triangle, u, v);
  float alpha = m.baseColor.a * interpolate(s.colors, c).a;
  if (m.baseColorTexture.texture != kNone) alpha *= look(s, m.baseColorTexture, c, true).a;
  return alpha;
}

vec3 emissionShareAt(const RenderScene& s, uint32_t object, uint32_t triangle, float u, float v) {
  const Material& m = s.materials[s.objects[object].material];
  if (m.alphaMode == AlphaMode::mask && alphaAt(s, object, triangle, u, v) < m.alphaCutoff)
    return vec3(0.0f);
  if (m.emissiveTexture.texture == kNone) return vec3(1.0f);
  return vec3(look(s, m.emissiveTexture, corners(s, object, triangle, u, v), true));
}

bool mayBeGlossy(const Material& m) {
  return shared::isGlossy(m.metallic, m.roughness) || m.metallicRoughnessTexture.texture != kNone;
}

Gloss glossAt(const RenderScene& s, uint32_t object, uint32_t triangle, float u, float v) {
  const Material& m = s.materials[s.objects[object].material];
  Gloss gloss{m.metallic, m.roughness};
  if (m.metallicRoughnessTexture.texture == kNone) return gloss;
  const vec4 texel = look(s, m.metallicRoughnessTexture, corners(s, object, triangle, u, v), false);
  return {gloss.metallic * texel.b, gloss.roughness * texel.g};
}

constexpr float kSameNormal = 2e-6f;

Surface surfaceAt(const RenderScene& s, uint32_t object, uint32_t triangle, float u, float v) {
  const Material& m = s.materials[s.objects[object].material];
  const Corners c = corners(s, object, triangle, u, v);
  Surface out;
  out.position = interpolate(s.positions, c);
  const vec3 cross = glm::cross(s.positions[c.i[1]] - s.positions[c.i[0]],
                                s.positions[c.i[2]] - s.positions[c.i[0]]);
  const float doubleArea = glm::length(cross);
  if (doubleArea > 0.0f) out.geometricNormal = cross / doubleArea;
  vec3 n = interpolate(s.normals, c);
  const float length = glm::length(n);
  n = length > 0.0f ? n / length : out.geometricNormal;
  // The winding defines the front; normals on the other side are flipped.
  if (glm::dot(n, out.geometricNormal) < 0.0f) n = -n;
  // On a flat face both normals are equal except for rounding errors. Exactly equal normals halve
  // the cost of shading.
  if (glm::distance(n, out.geometricNormal) < kSameNormal) n = out.geometricNormal;
  out.normal = mappedNormal(s, m, c, n);
  vec4 colour = m.baseColor * interpolate(s.colors, c);
  if (m.baseColorTexture.texture != kNone) colour *= look(s, m.baseColorTexture, c, true);
  out.albedo = glm::clamp(vec3(colour), 0.0f, 1.0f);
  if (m.emits()) {
    out.emission = m.emissive;
    if (m.emissiveTexture.texture != kNone)
      out.emission *= vec3(look(s, m.emissiveTexture, c, true));
    out.emitsBothSides = m.doubleSided;
  }
  return out;
}

double areaOf(const RenderScene& scene, const RenderObject& object) {
  double area = 0.0;
  for (uint32_t i = object.firstIndex; i < object.firstIndex + object.indexCount; i += 3) {
    const vec3& a = scene.positions[scene.indices[i]];
    area += 0.5 *
            static_cast<double>(glm::length(glm::cross(scene.positions[scene.indices[i + 1]] - a,
                                                       scene.positions[scene.indices[i + 2]] - a)));
  }
  return area;
}

}  // namespace lamplighter
