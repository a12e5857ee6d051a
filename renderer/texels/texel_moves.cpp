#include "renderer/texels/texel_moves.h"

namespace lamplighter {
namespace {

Bounds boundsOf(const RenderObject& object) { return object.isEmpty() ? Bounds{} : object.bounds; }

}  // namespace

PlacedTexels::PlacedTexels(const RenderScene& scene, const TexelSet& texels) {
  for (const TexelSet::Part& part : texels.parts()) parts_.push_back({part.first, part.count});
  for (size_t t = 0; t < texels.size(); ++t) isBuried_.push_back(texels.isBuried(t) ? 1 : 0);
  for (const RenderObject& o : scene.objects) bounds_.push_back(boundsOf(o));
}

TexelMoves PlacedTexels::movesTo(const RenderScene& scene, const TexelSet& texels,
                                 const std::set<uint32_t>& moved) const {
  TexelMoves out;
  out.sameTexel.assign(texels.size(), TexelMoves::kNew);
  for (size_t side = 0; side < std::min(parts_.size(), texels.parts().size()); ++side) {
    const TexelSet::Part& part = texels.parts()[side];
    if (part.count != parts_[side].count) continue;
    for (uint32_t k = 0; k < part.count; ++k)
      out.sameTexel[part.first + k] = parts_[side].first + k;
  }
  out.formerTexel = out.sameTexel;
  for (uint32_t t = 0; t < texels.size(); ++t) {
    uint32_t& before = out.formerTexel[t];
    if (before == TexelMoves::kNew) continue;
    if (moved.contains(texels[t].object) || texels.isBuried(t) != (isBuried_[before] != 0))
      before = TexelMoves::kNew;
  }
  for (const uint32_t o : moved) {
    if (o < bounds_.size() && !bounds_[o].empty()) out.boxes.push_back(bounds_[o]);
    if (o >= scene.objects.size()) continue;
    const Bounds now = boundsOf(scene.objects[o]);
    if (!now.empty()) out.boxes.push_back(now);
  }
  return out;
}

}  // namespace lamplighter
