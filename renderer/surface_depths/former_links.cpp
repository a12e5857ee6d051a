#include "renderer/surface_depths/former_links.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "renderer/surface_depths/link_walk.h"

namespace lamplighter {

void FormerLinks::compareWith(const TexelTree& tree, TexelMoves moves) {
  moves_ = std::move(moves);
  std::vector<uint8_t> isKept(tree_.order().size(), 0);  // by former texel
  for (const uint32_t t : moves_.formerTexel)
    if (t != TexelMoves::kNew) isKept[t] = 1;
  // Nodes with only kept texels have them in the same order, so the first texel and their number
  // identify a node. `formerOf`: old texel at an index of the order of the tree; none: changed.
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
  std::vector<uint8_t> isGone(tree_.size(), 1);
  forEachKept(
      tree, [&](uint32_t t) { return moves_.formerTexel[t]; },
      [&](uint32_t n, uint64_t key) {
        const auto found = former.find(key);
        if (found == former.end()) return;
        formerNode_[n] = found->second;
        isGone[found->second] = 0;
      });
  // Nodes above a removed node are removed as well.
  goneAbove_.assign(tree_.size(), TexelMoves::kNew);
  gone_.clear();
  for (uint32_t n = 0; n < tree_.size(); ++n) {
    if (isGone[n] == 0) continue;
    const auto place = static_cast<uint32_t>(gone_.size());
    gone_.push_back(n);
    if (tree_[n].isLeaf()) continue;
    goneAbove_[n + 1] = goneAbove_[tree_[n + 1].skip] = place;
  }
}

FormerLinks::OfTexel FormerLinks::of(uint32_t texel, const SurfaceSpot& spot) const {
  OfTexel out;
  const uint32_t before = empty() ? TexelMoves::kNew : moves_.formerTexel[texel];
  if (before == TexelMoves::kNew) return out;
  out.all_ = this;
  out.links_ = table_.of(before);
  for (const uint32_t n : gone_) {
    const bool isReached = goneAbove_[n] == TexelMoves::kNew || out.isDivided_[goneAbove_[n]] != 0;
    out.isDivided_.push_back(
        isReached && !tree_[n].isLeaf() && largestFormFactor(spot, tree_[n]) > error_ ? 1 : 0);
  }
  return out;
}

FormerLinks::OfTexel::Known FormerLinks::OfTexel::at(uint32_t n, const TexelTree& tree,
                                                     const SurfaceSpot& spot) {
  if (all_ == nullptr || all_->formerNode_[n] == TexelMoves::kNew || n < unknownUntil_)
    return Known::nothing;
  const TexelTree::Node& node = tree[n];
  if (n >= knownUntil_) {
    const uint32_t above = all_->goneAbove_[all_->formerNode_[n]];
    const bool isReached = above == TexelMoves::kNew || isDivided_[above] != 0;
    (isReached ? knownUntil_ : unknownUntil_) = node.skip;
    if (!isReached) return Known::nothing;
  }
  // All segments to the node lie within its radius around the segment to its centre.
  const vec3 from = spot.rayOrigin();
  const Ray ray{from, 0.0f, node.centre - from, 1.0f};
  const bool mayBeBlocked = std::ranges::any_of(all_->moves_.boxes, [&](const Bounds& b) {
    return mayTouch(ray, {b.min - node.radius, b.max + node.radius});
  });
  return mayBeBlocked ? Known::ends : Known::links;
}

// The links of old nodes from `former` to before `end`.
std::span<const TexelLink> FormerLinks::OfTexel::linksOf(uint32_t former, uint32_t end) const {
  const auto isBefore = [](const TexelLink& link, uint32_t n) { return link.node < n; };
  const auto first = std::lower_bound(links_.begin(), links_.end(), former, isBefore);
  return {first, std::lower_bound(first, links_.end(), end, isBefore)};
}

void FormerLinks::OfTexel::append(uint32_t n, std::vector<TexelLink>& out) const {
  const uint32_t former = all_->formerNode_[n];
  for (TexelLink link : linksOf(former, all_->tree_[former].skip)) {
    link.node = link.node - former + n;  // the nodes below have the same order
    out.push_back(link);
  }
}

uint32_t FormerLinks::OfTexel::seen(uint32_t n) const {
  const uint32_t former = all_->formerNode_[n];
  const std::span<const TexelLink> links = linksOf(former, former + 1);
  return links.empty() ? 0u : links.front().seen;
}

}  // namespace lamplighter
