#include <algorithm>
#include <cmath>

#include <tiny_gltf.h>

#include "renderer/scene/gltf/flat_normals.h"
#include "renderer/scene/gltf/gltf_accessors.h"
#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/gltf/unused_vertices.h"

namespace lamplighter {

namespace {

// Beyond this a float has no millimetre left, and squared distances begin to overflow further on.

struct Counts {
  size_t notTriangles = 0;   // primitives of points and lines
  size_t mendedNormals = 0;  // vertices
  size_t mendedUvs = 0;      // vertices
  size_t deformed = 0;       // meshes with morph targets in effect
};

bool isFinite(const vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool isFinite(const vec3& v) { return isFinite(vec2(v)) && std::isfinite(v.z); }
bool isFinite(const vec4& v) { return isFinite(vec3(v)) && std::isfinite(v.w); }

// Triangle lists from strips and fans (glTF 2.0, 3.7.2.1).
std::vector<uint32_t> asTriangles(const std::vector<uint32_t>& in, int mode) {
  if (mode == TINYGLTF_MODE_TRIANGLES)
    return {in.begin(), in.end() - static_cast<std::ptrdiff_t>(in.size() % 3)};
  std::vector<uint32_t> out;
  if (in.size() < 3) return out;
  out.reserve(3 * (in.size() - 2));
  for (size_t i = 0; i + 2 < in.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      const size_t odd = i % 2;
      out.insert(out.end(), {in[i], in[i + 1 + odd], in[i + 2 - odd]});
    } else {
      out.insert(out.end(), {in[i + 1], in[i + 2], in[0]});
    }
  }
  return out;
}

void mendUvs(std::vector<vec2>& uvs, Counts& counts) {
  for (vec2& uv : uvs) {
    if (isFinite(uv)) continue;
    uv = vec2(0.0f);
    ++counts.mendedUvs;
  }
}

// Unit normals; those that are none are marked.
std::vector<bool> checkNormals(std::vector<vec3>& normals) {
  std::vector<bool> missing(normals.size(), false);
  for (size_t i = 0; i < normals.size(); ++i) {
    const float square = glm::dot(normals[i], normals[i]);
    if (!(square > 1e-12f) || !std::isfinite(square)) {
      missing[i] = true;
    } else if (std::abs(square - 1.0f) > 1e-5f) {  // unit normals do not change
      normals[i] /= std::sqrt(square);
    }
  }
  return missing;
}

// Tangents are used as a whole or not at all: a normal map needs a frame everywhere.
void checkTangents(std::vector<vec4>& tangents) {
  for (vec4& t : tangents) {
    const float square = glm::dot(vec3(t), vec3(t));
    if (!isFinite(t) || !(square > 1e-12f) || !std::isfinite(square)) {
      tangents.clear();
      return;
    }
    const float scale = std::abs(square - 1.0f) > 1e-5f ? 1.0f / std::sqrt(square) : 1.0f;
    t = vec4(vec3(t) * scale, t.w < 0.0f ? -1.0f : 1.0f);
  }
}

class MeshReader {
 public:
  explicit MeshReader(GltfDocument& document) : doc_(document) {}

  std::shared_ptr<const Mesh> read(const tinygltf::Mesh& source, At at) {
    auto mesh = std::make_shared<Mesh>();
    mesh->name = source.name;
    for (const tinygltf::Primitive& primitive : source.primitives) {
      if (auto read = readPrimitive(primitive, at)) mesh->primitives.push_back(std::move(*read));
    }
    if (std::any_of(source.weights.begin(), source.weights.end(),
                    [](double w) { return w != 0.0; })) {
      ++counts_.deformed;
    }
    return mesh;
  }

  void report() {
    const auto warn = [&](size_t count, const char* what) {
      if (count > 0) doc_.warn(std::to_string(count) + what);
    };
    warn(counts_.notTriangles, " primitives are points or lines, which are not shown");
    warn(counts_.mendedNormals, " vertices have no usable normal; it was computed from the faces");
    warn(counts_.mendedUvs, " vertices have texture coordinates that are not numbers; 0 was used");
    warn(counts_.deformed, " meshes have morph targets, which are shown without effect");
  }

 private:
  std::optional<Primitive> readPrimitive(const tinygltf::Primitive& source, At at) {
    if (source.mode < TINYGLTF_MODE_TRIANGLES) {
      ++counts_.notTriangles;
      return std::nullopt;
    }
    const auto attribute = [&](const char* name, auto decode) {
      const auto it = source.attributes.find(name);
      return it == source.attributes.end() ? decltype(decode(doc_, size_t{}))()
                                           : decode(doc_, spend(it->second));
    };
    if (!source.attributes.contains("POSITION")) return std::nullopt;  // allowed; nothing to show

    Primitive p;
    p.positions = attribute("POSITION", readVec3);
    for (const vec3& v : p.positions) {
      if (!isFinite(v) ||
          std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) > kFarthestPlace) {
        doc_.fail(at, "has a vertex position that is not finite, or farther than 1e9 m");
      }
    }
    p.indices = asTriangles(indices(source.indices, at, p.positions.size()), source.mode);
    p.normals = attribute("NORMAL", readVec3);
    p.tangents = attribute("TANGENT", readVec4);
    p.uv0 = attribute("TEXCOORD_0", readVec2);
    p.uv1 = attribute("TEXCOORD_1", readVec2);
    p.colors = attribute("COLOR_0", readVec4);
    p.material = source.material;

    dropUnusedVertices(p);
    keep(p);
    mendUvs(p.uv0, counts_);
    mendUvs(p.uv1, counts_);
    for (vec4& c : p.colors) c = isFinite(c) ? glm::max(c, vec4(0.0f)) : vec4(1.0f);
    // Tangents without normals are to be ignored (glTF 2.0, 3.7.2.1).
    if (p.normals.empty()) p.tangents.clear();
    checkTangents(p.tangents);
    std::vector<bool> missing =
        p.normals.empty() ? std::vector<bool>(p.positions.size(), true) : checkNormals(p.normals);
    const auto bad = std::count(missing.begin(), missing.end(), true);
    if (!p.normals.empty()) counts_.mendedNormals += static_cast<size_t>(bad);
    if (bad > 0) addFlatNormals(p, missing);
    return p;
  }

  std::vector<uint32_t> indices(int accessor, At at, size_t vertices) {
    if (accessor >= 0) {
      std::vector<uint32_t> out = readIndices(doc_, spend(accessor));
      for (const uint32_t i : out) {
        if (i >= vertices) {
          doc_.fail(at, "has the vertex index " + std::to_string(i) + ", but there are " +
                            std::to_string(vertices) + " vertices");
        }
      }
      return out;
    }
    std::vector<uint32_t> out(vertices);
    for (size_t i = 0; i < vertices; ++i) out[i] = static_cast<uint32_t>(i);
    return out;
  }

  // A small file can name the same large accessor again and again: what is decoded, and more so
  // what is kept of it, has to be in proportion to what was read.
  size_t spend(int index) {
    const auto accessor = static_cast<size_t>(index);
    decoded_ += elementCount(doc_, accessor) * sizeof(vec4);
    constexpr size_t kAlwaysGood = size_t{4} << 30, kProportion = 256;
    if (decoded_ > kAlwaysGood + kProportion * doc_.bytesRead) refuseAmount();
    return accessor;
  }
  void keep(const Primitive& p) {
    kept_ += p.positions.size() * sizeof(vec4) * 4 + p.indices.size() * sizeof(uint32_t);
    constexpr size_t kAlwaysGood = size_t{256} << 20, kProportion = 64;
    if (kept_ > kAlwaysGood + kProportion * doc_.bytesRead) refuseAmount();
  }
  [[noreturn]] void refuseAmount() const {
    doc_.fail("describes more vertices than its size accounts for");
  }

  GltfDocument& doc_;
  Counts counts_;
  size_t decoded_ = 0, kept_ = 0;  // bytes
};

}  // namespace

std::vector<std::shared_ptr<const Mesh>> readMeshes(GltfDocument& document) {
  const std::vector<tinygltf::Mesh>& list = document.model->meshes;
  MeshReader reader(document);
  std::vector<std::shared_ptr<const Mesh>> meshes;
  meshes.reserve(list.size());
  for (size_t i = 0; i < list.size(); ++i) meshes.push_back(reader.read(list[i], {"meshes", i}));
  reader.report();
  return meshes;
}

}  // namespace lamplighter
