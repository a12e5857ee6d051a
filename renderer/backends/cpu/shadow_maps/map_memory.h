// Memory for shadow maps of one resolution. Look-ups are spread over hundreds of megabytes; with
// pages of 4 KiB, page table walks would take longer than reading texels.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <vector>

namespace lamplighter::cpu {

class MapMemory {
 public:
  MapMemory() = default;
  // For at most `most` maps.
  MapMemory(size_t texelsOfMap, size_t most) : texels_(texelsOfMap), most_(most) {}

  // Returns the texels of a map, uninitialised. Throws std::bad_alloc, or std::length_error if
  // `most` maps are in use.
  float* take();
  void giveBack(float* map) { free_.push_back(map); }
  size_t taken() const { return made_ - free_.size(); }
  size_t texelsOfMap() const { return texels_; }

 private:
  struct Free {
    void operator()(float* p) const { std::free(p); }
  };
  void grow();

  size_t texels_ = 0, most_ = 0;
  size_t made_ = 0;  // number of maps with allocated memory
  std::vector<std::unique_ptr<float, Free>> pieces_;
  std::vector<float*> free_;  // free maps; the last one is the next to use
};

}  // namespace lamplighter::cpu
