#include <algorithm>
#include <cmath>

#include "renderer/scene/flat_normals.h"
#include "renderer/scene/gltf/gltf_accessors.h"
#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/unused_vertices.h"

namespace lamplighter {

namespace {

// Numbers of skipped and repaired items, for warnings.
struct Counts {
  size_t notTriangles = 0;   // primitives of points and lines
  size_t mendedNormals = 0;  // vertices
  size_t mendedUvs = 0;      // vertices
  size_t deformed = 0;       // meshes with morph targets in effect
};

bool isFinite(const vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool isFinite(const vec3& v) { return isFinite(vec2(v)) && std::isfinite(v.z); }
bool isFinite(const vec4& v) { return isFinite(vec3(v)) && std::isfinite(v.w); }

// Converts strips and fans to triangle lists (glTF 2.0, 3.7.2.1).
std::vector<uint32_t> asTriangles(const std::vector<uint32_t>& in, size_t mode) {
  if (mode == 4) return {in.begin(), in.end() - static_cast<std::ptrdiff_t>(in.size() % 3)};
  std::vector<uint32_t> out;
  if (in.size() < 3) return out;
  out.reserve(3 * (in.size() - 2));
  for (size_t i = 0; i + 2 < in.size(); ++i) {
    if (mode == 5) {
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

// Normalises the normals and marks those that cannot be normalised.
std::vector<bool> checkNormals(std::vector<vec3>& normals) {
  std::vector<bool> missing(normals.size(), false);
  for (size_t i = 0; i < normals.size(); ++i) {
    const float square = glm::dot(normals[i], normals[i]);
    if (!(square > 1e-12f) || !std::isfinite(square)) {
      missing[i] = true;
    } else if (std::abs(square - 1.0f) > 1e-5f) {  // unit normals stay unchanged
      normals[i] /= std::sqrt(square);
    }
  }
  return missing;
}

// Tangents are used for all vertices or for none: a normal map needs a tangent frame everywhere.
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
  explicit MeshReader(GltfDocument& document)
      : doc_(document), accessors_(listOf(document, "accessors")) {}

  std::shared_ptr<const Mesh> read(const Json& json, At at) {
    auto mesh = std::make_shared<Mesh>();
    mesh->name = textMember(doc_, json, "name", at);
    if (const Json* primitives = arrayMember(doc_, json, "primitives", at)) {
      for (const Json& primitive : *primitives) {
        if (auto read = readPrimitive(primitive, at)) mesh->primitives.push_back(std::move(*read));
      }
    }
    if (const Json* weights = arrayMember(doc_, json, "weights", at)) {
      if (std::any_of(weights->begin(), weights->end(),
                      [](const Json& w) { return w.is_number() && w.get<double>() != 0.0; })) {
        ++counts_.deformed;
      }
    }
    return mesh;
  }

  void report() {
    const auto warn = [&](size_t count, const char* what) {
      if (count > 0) doc_.warn(std::to_string(count) + what);
    };
    warn(counts_.notTriangles, " primitives are points or lines, which are not shown");
    warn(counts_.mendedNormals, " vertices have no usable normal; it was computed from the faces");
    warn(counts_.mendedUvs, " vertices have texture coordinates that are no numbers; 0 was used");
    warn(counts_.deformed, " meshes have morph targets, which are shown without effect");
  }

 private:
  std::optional<Primitive> readPrimitive(const Json& json, At at) {
    const size_t mode = sizeMember(doc_, json, "mode", at).value_or(4);
    const Json& attributes = *member(json, "attributes");
    if (mode < 4) {
      ++counts_.notTriangles;
      return std::nullopt;
    }
    const auto position = sizeMember(doc_, attributes, "POSITION", at);
    if (!position) return std::nullopt;  // allowed, but there is nothing to show
    refuseCompressed(json, at, *position);

    Primitive p;
    p.positions = readVec3(doc_, spend(*position));
    for (const vec3& v : p.positions) {
      if (!isFinite(v) ||
          std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) > kFarthestPlace) {
        doc_.fail(at, "has a vertex at no finite place, or farther than 1e9 m", kExportAgain);
      }
    }
    p.indices = asTriangles(indices(json, at, p.positions.size()), mode);
    if (const auto i = sizeMember(doc_, attributes, "NORMAL", at)) {
      p.normals = readVec3(doc_, spend(*i));
    }
    if (const auto i = sizeMember(doc_, attributes, "TANGENT", at)) {
      p.tangents = readVec4(doc_, spend(*i));
    }
    if (const auto i = sizeMember(doc_, attributes, "TEXCOORD_0", at)) {
      p.uv0 = readVec2(doc_, spend(*i));
    }
    if (const auto i = sizeMember(doc_, attributes, "TEXCOORD_1", at)) {
      p.uv1 = readVec2(doc_, spend(*i));
    }
    if (const auto i = sizeMember(doc_, attributes, "COLOR_0", at)) {
      p.colors = readVec4(doc_, spend(*i));
    }
    if (const auto i = sizeMember(doc_, json, "material", at)) p.material = static_cast<int>(*i);

    dropUnusedVertices(p);
    keep(p);
    mendUvs(p.uv0, counts_);
    mendUvs(p.uv1, counts_);
    for (vec4& c : p.colors) c = isFinite(c) ? glm::max(c, vec4(0.0f)) : vec4(1.0f);
    // Tangents without normals must be ignored (glTF 2.0, 3.7.2.1).
    if (p.normals.empty()) p.tangents.clear();
    checkTangents(p.tangents);
    std::vector<bool> missing =
        p.normals.empty() ? std::vector<bool>(p.positions.size(), true) : checkNormals(p.normals);
    const auto bad = std::count(missing.begin(), missing.end(), true);
    if (!p.normals.empty()) counts_.mendedNormals += static_cast<size_t>(bad);
    if (bad > 0) addFlatNormals(p, missing);
    return p;
  }

  std::vector<uint32_t> indices(const Json& json, At at, size_t vertices) {
    if (const auto accessor = sizeMember(doc_, json, "indices", at)) {
      std::vector<uint32_t> out = readIndices(doc_, spend(*accessor));
      for (const uint32_t i : out) {
        if (i >= vertices) {
          doc_.fail(at,
                    "has the vertex index " + std::to_string(i) + ", but there are " +
                        std::to_string(vertices) + " vertices",
                    kExportAgain);
        }
      }
      return out;
    }
    std::vector<uint32_t> out(vertices);
    for (size_t i = 0; i < vertices; ++i) out[i] = static_cast<uint32_t>(i);
    return out;
  }

  // A primitive may have only Draco data even if the file does not require the extension.
  void refuseCompressed(const Json& json, At at, size_t position) {
    if (extensionOf(json, "KHR_draco_mesh_compression") != nullptr &&
        member(accessors_[position], "bufferView") == nullptr) {
      doc_.fail(at, "is compressed by KHR_draco_mesh_compression, which is not supported",
                "export it without compression");
    }
  }

  // A small file can refer to the same large accessor many times. The decoded data, and even more
  // the data that is kept, must be in proportion to the bytes read.
  size_t spend(size_t accessor) {
    decoded_ += accessorView(doc_, accessor).count * sizeof(vec4);
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
    doc_.fail("describes more vertices than its size accounts for", kExportAgain);
  }

  GltfDocument& doc_;
  const Json& accessors_;
  Counts counts_;
  size_t decoded_ = 0, kept_ = 0;  // bytes
};

}  // namespace

std::vector<std::shared_ptr<const Mesh>> readMeshes(GltfDocument& document) {
  const Json& list = listOf(document, "meshes");
  MeshReader reader(document);
  std::vector<std::shared_ptr<const Mesh>> meshes;
  meshes.reserve(list.size());
  for (size_t i = 0; i < list.size(); ++i) meshes.push_back(reader.read(list[i], {"meshes", i}));
  reader.report();
  return meshes;
}

}  // namespace lamplighter
