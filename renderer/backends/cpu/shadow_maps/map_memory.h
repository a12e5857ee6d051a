// Memory for shadow maps of one resolution. Look-ups go all over hundreds of megabytes: with pages
// of 4 KiB the processor finds the pages for longer than the texels.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <vector>

namespace lamplighter::cpu {

class MapMemory {
 public:
  MapMemory() = default;
  // For at most so many maps.
  MapMemory(size_t texelsOfMap, size_t most) : texels_(texelsOfMap), most_(most) {}

  // A map's texels, of whatever values. Throws std::bad_alloc, or std::length_error where there are
  // as many as there may be.
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
  size_t made_ = 0;  // maps that there is memory for
  std::vector<std::unique_ptr<float, Free>> pieces_;
  std::vector<float*> free_;  // maps, the next last
};

}  // namespace lamplighter::cpu
