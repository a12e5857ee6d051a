#include "editor/recovery/mesh_bytes.h"

#include <algorithm>
#include <cstring>

#include "renderer/base/error.h"

namespace lamplighter {

namespace {

// Calls f with each of the primitive's arrays.
template <typename P, typename F>
void eachArray(P& p, F f) {
  auto& [positions, normals, tangents, uv0, uv1, colors, indices, material] = p;
  f(positions), f(normals), f(tangents), f(uv0), f(uv1), f(colors), f(indices);
}

class Cursor {
 public:
  explicit Cursor(std::span<const uint8_t> bytes) : rest_(bytes) {}
  void take(void* to, size_t size) {
    if (size > rest_.size()) damaged();
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  uint64_t count(size_t elementSize) {
    uint64_t n = 0;
    take(&n, sizeof n);
    if (n > rest_.size() / elementSize) damaged();
    return n;
  }
  bool atEnd() const { return rest_.empty(); }
  [[noreturn]] static void damaged() {
    throw InputError("journal", "a mesh is damaged", "use the autosave beside it");
  }

 private:
  std::span<const uint8_t> rest_;
};

}  // namespace

std::vector<uint8_t> bytesOf(const std::vector<Primitive>& primitives) {
  std::vector<uint8_t> out;
  const auto add = [&](const void* data, size_t size) {
    const auto* bytes = static_cast<const uint8_t*>(data);
    out.insert(out.end(), bytes, bytes + size);
  };
  for (const Primitive& p : primitives) {
    add(&p.material, sizeof p.material);
    eachArray(p, [&](const auto& array) {
      const uint64_t n = array.size();
      add(&n, sizeof n);
      add(array.data(), n * sizeof array[0]);
    });
  }
  return out;
}

std::vector<Primitive> primitivesOf(std::span<const uint8_t> bytes) {
  std::vector<Primitive> out;
  for (Cursor in(bytes); !in.atEnd();) {
    Primitive& p = out.emplace_back();
    in.take(&p.material, sizeof p.material);
    eachArray(p, [&](auto& array) {
      array.resize(in.count(sizeof array[0]));
      in.take(array.data(), array.size() * sizeof array[0]);
    });
    const bool fits = p.normals.size() == p.positions.size() &&
                      std::all_of(p.indices.begin(), p.indices.end(),
                                  [&](uint32_t i) { return i < p.positions.size(); });
    if (!fits) Cursor::damaged();
  }
  return out;
}

}  // namespace lamplighter
