#include "editor/bake/bake_layout.h"

#include <cstring>
#include <fstream>

#include <spdlog/fmt/fmt.h>

#include "editor/document/write_file.h"
#include "renderer/base/error.h"

namespace lamplighter {
namespace {

constexpr char kMagic[8] = {'L', 'A', 'M', 'P', 'B', 'K', '0', '1'};
// File format: x, y and three floats, little-endian like all supported machines.
constexpr size_t kTexelBytes = 2 * sizeof(uint16_t) + 3 * sizeof(float);

// The number of texels that contain the tile's points.
size_t texelCount(const BakeTile& tile) {
  size_t count = 0;
  for (size_t i = 0; i < tile.points.size(); ++i)
    count += i == 0 || tile.points[i].x != tile.points[i - 1].x ||
             tile.points[i].y != tile.points[i - 1].y;
  return count;
}

}  // namespace

std::vector<BakeTile> bakeTiles(const RenderScene& scene, const LightMapAtlas& atlas) {
  std::vector<BakeTile> tiles;
  const int across = (atlas.pageSize + kTileSide - 1) / kTileSide;
  for (int page = 0; page < atlas.pages; ++page) {
    std::vector<BakeTile> ofPage(static_cast<size_t>(across * across));
    for (const BakePoint& p : bakePoints(scene, atlas, page))
      ofPage[static_cast<size_t>(p.y / kTileSide * across + p.x / kTileSide)].points.push_back(p);
    for (BakeTile& tile : ofPage) {
      if (tile.points.empty()) continue;
      tile.number = static_cast<int>(tiles.size());
      tile.page = page;
      tiles.push_back(std::move(tile));
    }
  }
  return tiles;
}

BakeParts::BakeParts(const std::filesystem::path& output, uint64_t key)
    : folder_(output / "parts" / fmt::format("{:016x}", key)) {}

std::filesystem::path BakeParts::pathOf(const BakeTile& tile) const {
  return folder_ / fmt::format("tile-{:05}.bin", tile.number);
}

bool BakeParts::has(const BakeTile& tile) const { return read(tile).has_value(); }

void BakeParts::write(const BakeTile& tile, std::span<const BakedTexel> texels) const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw InputError(folder_.string(), "cannot be created (" + error.message() + ")",
                     "check the permissions of its parent folder");
  std::string bytes(kMagic, sizeof(kMagic));
  for (const BakedTexel& t : texels) {
    char texel[kTexelBytes];
    std::memcpy(texel, &t.x, 2);
    std::memcpy(texel + 2, &t.y, 2);
    std::memcpy(texel + 4, &t.irradiance[0], 3 * sizeof(float));
    bytes.append(texel, kTexelBytes);
  }
  writeFile(pathOf(tile), bytes);
}

std::optional<std::vector<BakedTexel>> BakeParts::read(const BakeTile& tile) const {
  std::ifstream in(pathOf(tile), std::ios::binary);
  if (!in) return std::nullopt;
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (bytes.size() != sizeof(kMagic) + texelCount(tile) * kTexelBytes ||
      std::memcmp(bytes.data(), kMagic, sizeof(kMagic)) != 0)
    return std::nullopt;
  std::vector<BakedTexel> texels;
  for (size_t at = sizeof(kMagic); at < bytes.size(); at += kTexelBytes) {
    BakedTexel& t = texels.emplace_back();
    std::memcpy(&t.x, &bytes[at], 2);
    std::memcpy(&t.y, &bytes[at + 2], 2);
    std::memcpy(&t.irradiance[0], &bytes[at + 4], 3 * sizeof(float));
  }
  return texels;
}

void BakeParts::remove() const {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
  std::filesystem::remove(folder_.parent_path(), ignored);  // fails if another bake has tiles there
}

}  // namespace lamplighter
