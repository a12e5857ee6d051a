// The links of a scene before some of its objects moved: what texels saw along segments that do not
// meet these objects is still true, so only the other segments are traced again.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/surface_depths/texel_moves.h"
#include "renderer/surface_depths/texel_tree.h"

namespace lamplighter {

// A node from which a texel receives light. Nodes of many texels are tested at some of them.
struct TexelLink {
  uint32_t node : 28 = 0;
  uint32_t seen : 4 = 0;  // a bit for each tested texel of the node: whether it is seen
  float weight = 0.0f;    // share of the light that the texel receives: irradiance over radiosity
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
  // `error`: with which the links were refined.
  FormerLinks(TexelTree tree, LinkTable table, float error)
      : tree_(std::move(tree)), table_(std::move(table)), error_(error) {}
  bool empty() const { return table_.texels() == 0; }
  size_t bytes() const { return table_.bytes(); }

  // Compares with the present tree. See TexelMoves.
  void compareWith(const TexelTree& tree, TexelMoves moves);

  // The nodes of one texel.
  class OfTexel {
   public:
    // Which tested texels of a node of the present tree were seen. None if that is not known. To be
    // called with ascending nodes.
    std::optional<uint32_t> seen(uint32_t node);

   private:
    friend class FormerLinks;
    struct End {
      uint32_t node = 0, seen = 0;
    };
    const FormerLinks* all_ = nullptr;  // null: nothing is known
    std::vector<End> ends_;             // nodes of the former tree at which links could end
    size_t next_ = 0;
  };
  OfTexel of(uint32_t texel, const SurfaceSpot& spot) const;
  const TexelMoves& moves() const { return moves_; }

 private:
  TexelTree tree_;
  LinkTable table_;
  float error_ = 0.0f;
  std::vector<uint32_t> formerNode_;  // by present node; none where a texel of it changed
  TexelMoves moves_;
};

}  // namespace lamplighter
