#include "renderer/surface_depths/former_links.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "renderer/surface_depths/link_bound.h"

namespace lamplighter {
void FormerLinks::compareWith(const TexelTree& tree, TexelMoves moves) {
  moves_ = std::move(moves);
  std::vector<uint8_t> isKept(tree_.order().size(), 0);  // by former texel
  for (const uint32_t t : moves_.formerTexel)
    if (t != TexelMoves::kNew) isKept[t] = 1;
  // Nodes of kept texels alone have them in the same order, so the first of them and their number
  // tell which node it is. `formerOf`: of a place in the order of the tree; none: changed.
  const auto forEachKept = [](const TexelTree& t, const auto& formerOf, const auto& visit) {
    std::vector<uint32_t> kept{0};
    for (const uint32_t texel : t.order())
      kept.push_back(kept.back() + (formerOf(texel) == TexelMoves::kNew ? 0 : 1));
    for (uint32_t n = 0; n < t.size(); ++n) {
      const TexelTree::Node& node = t[n];
      if (kept[node.firstTexel + node.texels] - kept[node.firstTexel] == node.texels)
        visit(n, static_cast<uint64_t>(formerOf(t.order()[node.firstTexel])) << 32 | node.texels);
    }
  };
  std::unordered_map<uint64_t, uint32_t> former;
  forEachKept(
      tree_, [&](uint32_t t) { return isKept[t] != 0 ? t : TexelMoves::kNew; },
      [&](uint32_t n, uint64_t key) { former.emplace(key, n); });
  formerNode_.assign(tree.size(), TexelMoves::kNew);
  forEachKept(
      tree, [&](uint32_t t) { return moves_.formerTexel[t]; },
      [&](uint32_t n, uint64_t key) {
        const auto found = former.find(key);
        if (found != former.end()) formerNode_[n] = found->second;
      });
}

FormerLinks::OfTexel FormerLinks::of(uint32_t texel, const SurfaceSpot& spot) const {
  OfTexel out;
  const uint32_t before = empty() ? TexelMoves::kNew : moves_.formerTexel[texel];
  if (before == TexelMoves::kNew) return out;
  out.all_ = this;
  const std::span<const TexelLink> links = table_.of(before);
  size_t next = 0;
  forEachEnd(spot, tree_, error_, [&](uint32_t node) {
    while (next < links.size() && links[next].node < node) ++next;
    const bool isLinked = next < links.size() && links[next].node == node;
    out.ends_.push_back({node, isLinked ? links[next].seen : 0u});
  });
  return out;
}

std::optional<uint32_t> FormerLinks::OfTexel::seen(uint32_t node) {
  if (all_ == nullptr) return std::nullopt;
  const uint32_t former = all_->formerNode_[node];
  if (former == TexelMoves::kNew) return std::nullopt;
  while (next_ < ends_.size() && ends_[next_].node < former) ++next_;
  if (next_ == ends_.size() || ends_[next_].node != former) return std::nullopt;
  return ends_[next_].seen;
}

}  // namespace lamplighter
