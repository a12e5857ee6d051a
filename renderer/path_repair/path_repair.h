// Repairs a picture by paths of the reference: it shows the picture plus what the paths find
// missing, as far as their noise allows to tell. It converges to the reference.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "renderer/methods/gi_method.h"
#include "renderer/methods/path_tracer/path_tracer.h"
#include "renderer/path_repair/coarse_preview.h"
#include "renderer/path_repair/repair_guides.h"
#include "renderer/path_repair/residual_filter.h"

namespace lamplighter {

class PathRepair {
 public:
  struct Options {
    int paths = 0;  // for each pixel, an even number
    PathTracerOptions path;
    // The picture has not settled. It may be another in each call. Few paths are traced.
    bool isPreview = false;
  };

  void restart() { *this = PathRepair(); }
  // Does work that takes as long as at most `most` rows of paths, and returns it. `live`: the
  // picture. `surfaces`: light on surfaces at which paths may end, of the same scene; null: none.
  // Starts anew if the scene, the view or the kind of paths is another than in the last call, or if
  // there are more paths than wanted; then draws the G-buffer of the view, without a shift. If only
  // the picture is another, its light on surfaces counts as another, too: other paths are kept.
  int goOn(const FrameInputs& in, const Options& options,
           const std::shared_ptr<RadianceImage>& live, const MirroredLight* surfaces, int most);

  // After goOn() with these options: whether image() has all paths.
  bool isDone(const Options& options) const;
  bool hasBegun() const { return live_ != nullptr; }
  // Whether a preview that ends at this number of paths needs more: its error is large and it has
  // few paths, or some are not shown yet.
  bool isUrgent(int wanted) const {
    const bool isNew = filter_ && mostShown_ < whole_.paths;
    return isWrong_ && (whole_.paths < std::min(wanted, kQuickPaths) || isNew);
  }
  int paths() const { return whole_.paths + ended_.paths; }  // of each pixel
  uint64_t takeRays() { return std::exchange(rays_, 0); }
  // Null until there is one. If it is not of a preview, its bits depend on the number of paths
  // alone.
  const std::shared_ptr<RadianceImage>& image() const { return repaired_; }

 private:
  static constexpr int kQuickPaths = 16;

  void begin(const FrameInputs& in, const Options& options);
  void takePicture(const std::shared_ptr<RadianceImage>& live, bool isPreview, bool endsAtSurfaces);
  bool hasSeenLight(int x, int y, size_t half, uint32_t sample) const;
  // What all paths of a frame go through.
  struct Tracing {
    const RenderScene& scene;
    const RayCaster& caster;
  };
  struct Start;
  Start startAt(const Tracing& in, int x, int y, size_t half, uint32_t sample, uint64_t& rays);
  vec3 wholePath(const Tracing& in, int x, int y, size_t half, uint32_t sample, uint64_t& rays);
  int traceCells(const FrameInputs& in, const Options& options, int most);
  int tracePaths(const FrameInputs& in, const Options& options, const MirroredLight* surfaces,
                 int most);
  void beginFilter();
  void dropFilter();
  int filter(int most);
  int filterBlocks(int most);
  void show(const Image& residual);
  bool hasNoPixels() const { return whole_.first.empty(); }

  std::shared_ptr<RadianceImage> live_;  // null: not begun
  bool isPreview_ = false, endsAtSurfaces_ = false;
  bool isWrong_ = true;  // the picture, as far as the last filter of whole_ can tell
  View view_;
  PathTracerOptions path_;
  RepairGuides guides_;
  LightSet lights_;
  // Of each half, by pixel: the first rays at the sky or a lamp met nothing else.
  std::vector<uint8_t> hasLightAlone_[2];
  // What paths see that end nowhere, and that end at known light, and what that light lacks: by
  // fewer paths, because it is the same for many pixels.
  PathSums whole_, ended_, missing_;
  int row_ = 0;  // from which on the next paths are missing
  // While the first path of each half is traced: block by block, of one pixel of each. Then null.
  std::unique_ptr<CoarsePreview> coarse_;
  int cell_ = 0;                            // which of the pixels of a block
  std::unique_ptr<ResidualFilter> filter_;  // of missing_, then of all_; or of whole_
  std::optional<Image> lacking_;            // what known light lacks, while all_ is filtered
  PathSums all_;                            // of whole_, without lacking_, and of ended_
  int shown_ = 0, mostShown_ = 0;           // paths of repaired_, of this picture and of any
  uint64_t rays_ = 0;
  std::shared_ptr<RadianceImage> repaired_;
};

}  // namespace lamplighter
