#include "editor/split/tile_errors.h"

#include "renderer/image/metrics.h"

namespace lamplighter {
namespace {

constexpr int kBlock = 4;

bool canCompare(const TileErrors::Picture& picture, const TileErrors::Picture& base, bool waits) {
  return picture && base && picture->width() == base->width() &&
         picture->height() == base->height() &&
         (waits || (picture->isInMainMemory() && base->isInMainMemory()));
}

}  // namespace

double tileError(const Image& picture, const Image& base) {
  return relRmse(averageBlocks(picture, kBlock), averageBlocks(base, kBlock));
}

void TileErrors::update(std::span<const Picture> pictures, size_t base, bool waits) {
  compared_.resize(pictures.size());
  errors_.resize(pictures.size());
  const Picture& truth = pictures[base];
  for (size_t i = 0; i < pictures.size(); ++i) {
    if (compared_[i] == pictures[i] && base_ == truth && (errors_[i] || i == base)) continue;
    compared_[i] = pictures[i];
    errors_[i].reset();
    if (i == base || !canCompare(pictures[i], truth, waits)) continue;
    errors_[i] = tileError(pictures[i]->pixels(), truth->pixels());
  }
  base_ = truth;
}

std::optional<double> TileErrors::of(size_t tile) const {
  return tile < errors_.size() ? errors_[tile] : std::nullopt;
}

}  // namespace lamplighter
