// Reads what `lamplighter bake --visibility` writes: visibility.md. C++17, with no other file.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

class VisibilityReader {
 public:
  struct Texel {
    float position[3], normal[3], area;  // metres, world space
    uint32_t node, flags;                // in nodes; 1: on the back, 2: inside of an object
  };
  std::vector<std::string> nodes;  // names
  std::vector<Texel> texels;
  // Throws std::runtime_error if the file is missing or damaged.
  explicit VisibilityReader(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    require(in.is_open(), "cannot be read");
    bytes_.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    head_ = take<Header>(1)[0];
    require(std::equal(head_.magic, head_.magic + 8, "LAMPVIS"), "is another kind of file");
    require(head_.version == 1, "is of another version");
    uint64_t sum = 0xcbf29ce484222325u;
    for (size_t i = 16; i < bytes_.size(); ++i)
      sum = (sum ^ static_cast<uint8_t>(bytes_[i])) * 0x100000001b3u;
    require(sum == head_.checksum, "is damaged");
    for (uint32_t n = 0; n < head_.nodes; ++n) {
      const std::vector<char> name = take<char>(take<uint32_t>(1)[0]);
      nodes.emplace_back(name.begin(), name.end());
    }
    texels = take<Texel>(head_.texels);
    for (uint32_t r = 0; r < head_.runs; ++r) {
      Run& run = runs_.emplace_back();
      run.texels = take<uint32_t>(2);
      runOf_.resize(run.texels[0] + run.texels[1], r);
      for (const uint8_t more : take<uint8_t>(head_.faces * head_.side * head_.side))
        run.starts.push_back(run.starts.back() + more + 1);
      run.depths = take<uint16_t>(run.starts.back());
      run.last = take<uint8_t>(run.starts.back());
    }
  }
  // Whether nothing is between a texel and a point on a surface [m].
  bool sees(size_t texel, const float (&point)[3]) const {
    const auto& [from, n, area, node, flags] = texels[texel];
    const float d[3] = {point[0] - from[0], point[1] - from[1], point[2] - from[2]};
    if (d[0] * n[0] + d[1] * n[1] + d[2] * n[2] <= 0.0f) return false;
    const Run& run = runs_[runOf_[texel]];
    size_t segment = run.starts[pixelOf(d)];
    while (run.texels[0] + run.last[segment] < texel) ++segment;  // or a binary search
    const float distance = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    return run.depths[segment] == 65535 || distance * head_.steps <= run.depths[segment] + 0.5f;
  }

 private:
  struct Header {
    char magic[8];
    uint64_t checksum;
    uint32_t version, faces, side, nodes, texels, runs, zero;
    float steps;  // of a depth, per metre
  };
  struct Run {
    std::vector<uint32_t> texels;     // the first, and their number
    std::vector<uint32_t> starts{0};  // by pixel: its first segment
    std::vector<uint16_t> depths;     // by segment, in steps
    std::vector<uint8_t> last;        // by segment: its last texel, counted from the first
  };
  uint32_t pixelOf(const float (&d)[3]) const {
    const float a[3] = {std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}, sum = a[0] + a[1] + a[2];
    const uint32_t k = a[0] >= a[1] && a[0] >= a[2] ? 0 : a[1] >= a[2] ? 1 : 2;
    float x = d[(k + 1) % 3] / a[k], y = d[(k + 2) % 3] / a[k];
    if (head_.faces == 1) x = d[0] / sum, y = d[1] / sum;
    if (head_.faces == 1 && d[2] < 0.0f)
      x = std::copysign(1.0f - a[1] / sum, d[0]), y = std::copysign(1.0f - a[0] / sum, d[1]);
    const uint32_t face = head_.faces == 1 ? 0 : 2 * k + (d[k] < 0.0f ? 1 : 0);
    return (face * head_.side + cell(y)) * head_.side + cell(x);
  }
  uint32_t cell(float at) const {  // of [-1, 1]
    return std::min(static_cast<uint32_t>((0.5f * at + 0.5f) * head_.side), head_.side - 1);
  }
  static void require(bool isTrue, const char* problem) {
    if (!isTrue) throw std::runtime_error(std::string("the visibility file ") + problem);
  }
  template <typename T>
  std::vector<T> take(size_t count) {
    require(count <= (bytes_.size() - at_) / sizeof(T), "ends too early");
    std::vector<T> values(count);
    std::copy_n(bytes_.data() + at_, count * sizeof(T), reinterpret_cast<char*>(values.data()));
    at_ += count * sizeof(T);
    return values;
  }
  Header head_;
  std::vector<Run> runs_;
  std::vector<size_t> runOf_;  // by texel
  std::vector<char> bytes_;
  size_t at_ = 0;  // of the next value in bytes_
};
