#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "renderer/image/average_blocks.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"

namespace lamplighter::cli {

int compare(const CompareOptions& options) {
  if (!options.heatmap.empty()) requireWritable(options.heatmap, {".png"});
  Image a = readImage(options.a), b = readImage(options.b);
  std::optional<Image> mask;
  if (!options.mask.empty()) mask = readImage(options.mask);
  if (options.block > 1) {
    const auto isOfSize = [&](const Image& i) {
      return i.width == a.width && i.height == a.height;
    };
    if (isOfSize(b) && (!mask || isOfSize(*mask))) {  // otherwise, the comparison says so
      a = averageBlocks(a, options.block, mask ? &*mask : nullptr);
      b = averageBlocks(b, options.block, mask ? &*mask : nullptr);
      if (mask) mask = blockMask(*mask, options.block);
    }
  }
  const Metrics m = compareImages(a, b, mask ? &*mask : nullptr);
  if (!options.heatmap.empty()) writePng(heatMap(a, b), options.heatmap);

  if (options.json) {
    // JSON has no NaN; NaN is written as null.
    const nlohmann::ordered_json j{
        {"a", options.a},       {"b", options.b},     {"width", a.width}, {"height", a.height},
        {"relRMSE", m.relRmse}, {"relMSE", m.relMse}, {"bias", m.bias},   {"max", m.max},
        {"ssim", m.ssim},       {"meanA", m.meanA},   {"meanB", m.meanB}};
    std::cout << j.dump(2) << '\n';
  } else {
    std::cout << fmt::format(
        "relRMSE {:.6g}\nrelMSE  {:.6g}\nbias    {:.6g}\nmax     {:.6g}\nSSIM    {:.6g}\n",
        m.relRmse, m.relMse, m.bias, m.max, m.ssim);
  }
  if (options.maxRelRmse < 0.0) return 0;
  const bool good = m.relRmse <= options.maxRelRmse;  // false for NaN
  if (!good)
    std::cerr << fmt::format("check failed: relRMSE {:.6g} is over {:.6g}\n", m.relRmse,
                             options.maxRelRmse);
  return good ? 0 : 1;
}

}  // namespace lamplighter::cli
