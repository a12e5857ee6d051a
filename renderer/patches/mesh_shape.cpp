#include "renderer/patches/mesh_shape.h"

#include <bit>
#include <mutex>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "renderer/base/hash.h"

namespace lamplighter {
namespace {

struct MeshTraits : OpenMesh::DefaultTraits {
  VertexAttributes(0);
  HalfedgeAttributes(0);
  EdgeAttributes(0);
  FaceAttributes(0);
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;

// Whether all three edges of a new triangle are free.
bool canJoin(const TriMesh& mesh, const std::array<OpenMesh::VertexHandle, 3>& v) {
  for (size_t c = 0; c < 3; ++c) {
    if (!mesh.is_boundary(v[c])) return false;
    const auto h = mesh.find_halfedge(v[c], v[(c + 1) % 3]);
    if (h.is_valid() && !mesh.is_boundary(h)) return false;
  }
  return true;
}

uint64_t hashOf(const vec3& p) {
  uint64_t hash = kHashStart;
  // Adding zero turns -0 into +0, which compare as equal.
  for (int c = 0; c < 3; ++c) hash = hashedWith(hash, std::bit_cast<uint32_t>(p[c] + 0.0f));
  return hash ^ hash >> 29;
}

}  // namespace

MeshShape::MeshShape(const RenderScene& s, const RenderObject& o, const vec3& scale)
    : count_(o.triangleCount()) {
  positions_.reserve(o.vertexCount);
  for (uint32_t i = 0; i < o.vertexCount; ++i) {
    positions_.push_back(s.localPositions[o.firstVertex + i] * scale);
    bounds_.add(positions_.back());
  }
  corners_.reserve(size_t{3} * count_);
  for (uint32_t i = 0; i < o.indexCount; ++i)
    corners_.push_back(s.indices[o.firstIndex + i] - o.firstVertex);
}

Bounds MeshShape::boundsOf(uint32_t t) const {
  Bounds box;
  for (size_t c = 0; c < 3; ++c) box.add(at(t, c));
  return box;
}

std::array<MeshShape::Side, 3> MeshShape::sides(uint32_t t) const {
  std::array<Side, 3> out;
  for (size_t i = 0; i < 3; ++i) {
    const size_t next = (i + 1) % 3;
    out[i] = {welded_[vertex(t, i)], welded_[vertex(t, next)], vertex(t, i), vertex(t, next)};
  }
  return out;
}

void MeshShape::measure() {
  normals_.resize(count_, vec3(0.0f));
  areas_.resize(count_, 0.0f);
  for (uint32_t t = 0; t < count_; ++t) {
    const vec3 &a = at(t, 0), &b = at(t, 1), &c = at(t, 2);
    const vec3 cross = glm::cross(b - a, c - a);
    const float doubleArea = glm::length(cross);
    areas_[t] = 0.5f * doubleArea;
    if (doubleArea > 0.0f) normals_[t] = cross / doubleArea;
  }
}

// Numbers the different positions in the order of their first vertices.
void MeshShape::weld() {
  const size_t places = std::bit_ceil(2 * positions_.size() + 1);
  std::vector<int> table(places, kNone);  // open addressing
  welded_.resize(positions_.size());
  for (uint32_t i = 0; i < positions_.size(); ++i) {
    size_t place = hashOf(positions_[i]) & (places - 1);
    while (table[place] != kNone &&
           positions_[firstOf_[static_cast<size_t>(table[place])]] != positions_[i])
      place = (place + 1) & (places - 1);
    if (table[place] == kNone) {
      table[place] = static_cast<int>(firstOf_.size());
      firstOf_.push_back(i);
    }
    welded_[i] = table[place];
  }
}

void MeshShape::connect() {
  // Faces that cannot be connected are expected; suppress OpenMesh's messages on standard error.
  static std::once_flag isQuiet;
  std::call_once(isQuiet, [] { omerr().disable(); });
  measure();
  weld();
  TriMesh mesh;  // face t is triangle t
  mesh.reserve(firstOf_.size(), size_t{3} * count_ / 2 + firstOf_.size(), count_);
  const auto addVertex = [&](const vec3& p) { return mesh.add_vertex({p.x, p.y, p.z}); };
  for (const uint32_t i : firstOf_) addVertex(positions_[i]);
  for (uint32_t t = 0; t < count_; ++t) {
    std::array<OpenMesh::VertexHandle, 3> v;
    for (size_t c = 0; c < 3; ++c)
      v[c] = mesh.vertex_handle(static_cast<uint32_t>(welded_[vertex(t, c)]));
    const bool degenerate = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
    if (!degenerate && canJoin(mesh, v) && mesh.add_face(v[0], v[1], v[2]).is_valid()) continue;
    for (size_t c = 0; c < 3; ++c) v[c] = addVertex(at(t, c));
    mesh.add_face(v[0], v[1], v[2]);
  }
  neighbours_.resize(count_);
  for (uint32_t t = 0; t < count_; ++t) {
    auto h = mesh.halfedge_handle(mesh.face_handle(t));
    for (int& neighbour : neighbours_[t]) {
      neighbour = mesh.opposite_face_handle(h).idx();
      h = mesh.next_halfedge_handle(h);
    }
  }
}

}  // namespace lamplighter
