// The links of a scene before some of its objects moved: the visibility of segments that do not
// meet these objects is still valid, so only the other segments are traced again.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/surface_depths/texel_tree.h"
#include "renderer/texels/texel_moves.h"

namespace lamplighter {

// A node from which a texel receives light. The visibility of a node is tested at up to four of its
// texels.
struct TexelLink {
  uint32_t node : 28 = 0;
  uint32_t seen : 4 = 0;  // a bit for each tested texel of the node: whether it is seen
  float weight = 0.0f;    // form factor times the share that is seen
};

// Links of all texels: those of texel t are [starts[t], starts[t + 1]), by ascending nodes.
struct LinkTable {
  std::vector<size_t> starts{0};
  std::vector<TexelLink> links;

  size_t texels() const { return starts.size() - 1; }
  std::span<const TexelLink> of(size_t texel) const {
    return std::span(links).subspan(starts[texel], starts[texel + 1] - starts[texel]);
  }
  size_t bytes() const { return links.size() * sizeof(TexelLink) + starts.size() * sizeof(size_t); }
};

class FormerLinks {
 public:
  FormerLinks() = default;
  // `error`: the error threshold with which the links were refined.
  FormerLinks(TexelTree tree, LinkTable table, float error)
      : tree_(std::move(tree)), table_(std::move(table)), error_(error) {}
  bool empty() const { return table_.texels() == 0; }
  size_t bytes() const { return table_.bytes() + tree_.bytes(); }

  // Finds the nodes that the old tree and the current one have in common. See TexelMoves.
  void compareWith(const TexelTree& tree, TexelMoves moves);

  // Known links of one texel. Query the nodes of the current tree in ascending order.
  class OfTexel {
   public:
    enum class Known : uint8_t {
      nothing,
      ends,  // links end at the same nodes, but moved objects may block them
      links  // nothing moved between the texel and the node: its links are still valid
    };
    Known at(uint32_t node, const TexelTree& tree, const SurfaceSpot& spot);
    // Adds the links of a node and of those below, where these are known.
    void append(uint32_t node, std::vector<TexelLink>& out) const;
    // The bits TexelLink::seen of a node at which a link may end.
    uint32_t seen(uint32_t node) const;

   private:
    friend class FormerLinks;
    std::span<const TexelLink> linksOf(uint32_t former, uint32_t end) const;

    const FormerLinks* all_ = nullptr;  // null: nothing is known
    std::span<const TexelLink> links_;
    std::vector<uint8_t> isDivided_;              // by removed node
    uint32_t knownUntil_ = 0, unknownUntil_ = 0;  // nodes before these are below a queried one
  };
  OfTexel of(uint32_t texel, const SurfaceSpot& spot) const;
  const TexelMoves& moves() const { return moves_; }

 private:
  TexelTree tree_;
  LinkTable table_;
  float error_ = 0.0f;
  std::vector<uint32_t>
      formerNode_;  // by current node: its old number; kNew if one of its texels changed
  // Old nodes that were removed; by old node, the index into `gone_` of a removed node above it, or
  // kNew (a node whose parent was not removed is not queried).
  std::vector<uint32_t> gone_, goneAbove_;
  TexelMoves moves_;
};

}  // namespace lamplighter
