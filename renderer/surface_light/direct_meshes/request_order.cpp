#include "renderer/surface_light/direct_meshes/request_order.h"

#include <algorithm>
#include <unordered_map>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

constexpr uint32_t kOrderSet = 0x0d3;

// Merges requests for the same vertex: at its first position, with the sum of its priorities.
void unite(std::vector<MeshRequest>& requests) {
  std::unordered_map<uint64_t, size_t> places;
  size_t kept = 0;
  for (const MeshRequest& r : requests) {
    const auto [it, isNew] = places.emplace(uint64_t{r.mesh} << 32 | r.vertex, kept);
    if (isNew)
      requests[kept++] = r;
    else
      requests[it->second].priority += r.priority;
  }
  requests.resize(kept);
}

void takeAsPaper(std::vector<MeshRequest>& requests, size_t most, uint32_t seed) {
  const size_t count = requests.size();
  std::vector<uint8_t> isTaken(count, 0);
  std::vector<MeshRequest> taken;
  auto at = static_cast<size_t>(std::ranges::max_element(requests, {}, &MeshRequest::priority) -
                                requests.begin());
  for (uint32_t i = 0; taken.size() < most; ++i) {
    const size_t drawn = hash4(i, static_cast<uint32_t>(count), seed, kOrderSet) % count;
    if (isTaken[drawn] == 0 && requests[drawn].priority > requests[at].priority) at = drawn;
    while (isTaken[at] != 0) at = (at + 1) % count;
    isTaken[at] = 1;
    taken.push_back(requests[at]);
  }
  requests = std::move(taken);
}

}  // namespace

void takeFirst(std::vector<MeshRequest>& requests, size_t most, MeshPriority priority,
               uint32_t seed) {
  unite(requests);
  if (requests.size() <= most) return;
  if (priority == MeshPriority::paper) return takeAsPaper(requests, most, seed);
  if (priority == MeshPriority::random)
    for (MeshRequest& r : requests)
      r.priority = static_cast<float>(hash4(r.mesh, r.vertex, seed, kOrderSet));
  const auto isBefore = [](const MeshRequest& a, const MeshRequest& b) {
    return std::pair(-a.priority, uint64_t{a.mesh} << 32 | a.vertex) <
           std::pair(-b.priority, uint64_t{b.mesh} << 32 | b.vertex);
  };
  std::nth_element(requests.begin(), requests.begin() + static_cast<std::ptrdiff_t>(most),
                   requests.end(), isBefore);
  requests.resize(most);
}

}  // namespace lamplighter
