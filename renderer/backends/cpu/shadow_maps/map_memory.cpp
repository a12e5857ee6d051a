#include "renderer/backends/cpu/shadow_maps/map_memory.h"

#include <algorithm>
#include <new>
#include <stdexcept>

#include <sys/mman.h>

namespace lamplighter::cpu {
namespace {

constexpr size_t kHugePage = size_t{2} << 20;
// Approximate size of one allocation.
constexpr size_t kPieceBytes = 8 * kHugePage;

}  // namespace

void MapMemory::grow() {
  const size_t bytes = texels_ * sizeof(float);
  const size_t maps = std::min(std::max<size_t>(kPieceBytes / bytes, 1), most_ - made_);
  void* p = nullptr;
  if (posix_memalign(&p, kHugePage, maps * bytes) != 0) throw std::bad_alloc();
  pieces_.emplace_back(static_cast<float*>(p));
  // Only an optimisation: an error (no huge pages) is ignored.
  madvise(p, maps * bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
  for (size_t i = maps; i > 0; --i) free_.push_back(pieces_.back().get() + (i - 1) * texels_);
  made_ += maps;
}

float* MapMemory::take() {
  if (free_.empty() && made_ >= most_) throw std::length_error("more maps than reserved");
  if (free_.empty()) grow();
  float* map = free_.back();
  free_.pop_back();
  return map;
}

}  // namespace lamplighter::cpu
