// Repairs a picture with paths of the reference: adds the missing light that the paths find, except
// where it cannot be told from noise. Converges to the reference.
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
    int paths = 0;  // per pixel; an even number
    PathTracerOptions path;
    // The picture has not settled and may differ in each call. Few paths are traced.
    bool isPreview = false;
  };

  void restart() { *this = PathRepair(); }
  // Continues the work by an amount that takes as long as at most `most` rows of paths; returns the
  // amount. `live`: the picture. `surfaces`: light on surfaces of the same scene, at which paths
  // may end; null: none. Starts again if the scene, the view or the kind of paths changed since the
  // last call, or if there are more paths than wanted; then draws the G-buffer of the view without
  // a subpixel shift. If only the picture changed, its light on surfaces counts as changed, too,
  // and only paths that did not end at it are kept.
  int goOn(const FrameInputs& in, const Options& options,
           const std::shared_ptr<RadianceImage>& live, const MirroredLight* surfaces, int most);

  // After goOn() with these options: whether image() has all paths.
  bool isDone(const Options& options) const;
  bool hasBegun() const { return live_ != nullptr; }
  // Whether a preview that ends at this number of paths is urgent: the error of the picture is
  // large, and there are few paths, or paths that are not shown yet.
  bool isUrgent(int wanted) const {
    if (hasBegun() && hasNoPixels()) return false;
    const bool isNew = filter_ && mostShown_ < whole_.paths;
    return isWrong_ && (whole_.paths < std::min(wanted, kQuickPaths) || isNew);
  }
  int paths() const { return whole_.paths + ended_.paths; }  // per pixel
  uint64_t takeRays() { return std::exchange(rays_, 0); }
  // The repaired picture; null if there is none yet. If it is not a preview, its bits depend only
  // on the number of paths.
  const std::shared_ptr<RadianceImage>& image() const { return repaired_; }

 private:
  static constexpr int kQuickPaths = 8;

  void begin(const FrameInputs& in, const Options& options);
  void takePicture(const std::shared_ptr<RadianceImage>& live, bool isPreview, bool endsAtSurfaces);
  bool hasSeenLight(int x, int y, size_t half, uint32_t sample) const;
  // The scene of the current frame.
  struct Tracing {
    const RenderScene& scene;
    const RayCaster& caster;
  };
  struct Start;
  Start startAt(const Tracing& in, int x, int y, size_t half, uint32_t sample, uint64_t& rays);
  vec3 wholePath(const Tracing& in, int x, int y, size_t half, uint32_t sample, uint64_t& rays);
  // The next part of the work; returns what goOn() does.
  int advance(const FrameInputs& in, const Options& options, const MirroredLight* surfaces,
              int most);
  int traceBlocks(const FrameInputs& in, const Options& options, int most);
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
  bool isWrong_ = true;  // whether the last filter of whole_ found a large error of the picture
  View view_;
  PathTracerOptions path_;
  RepairGuides guides_;
  LightSet lights_;
  // By half and pixel: the first rays of a pixel that shows the sky or a lamp hit nothing else.
  std::vector<uint8_t> hasLightAlone_[2];
  // Sums of complete paths, of paths that end at known light, and of the error of known light; the
  // last with fewer paths, because it is similar for many pixels.
  PathSums whole_, ended_, missing_;
  int row_ = 0;  // first row without the next paths
  // Not null while the first path of each half of a large preview is traced: of one pixel of each
  // block after the other.
  std::unique_ptr<CoarsePreview> coarse_;
  std::unique_ptr<ResidualFilter> filter_;  // of missing_, then of all_; or of whole_
  std::optional<Image> lacking_;   // the filtered error of known light, while all_ is filtered
  PathSums all_;                   // sum of whole_, minus lacking_, and of ended_
  int shown_ = 0, mostShown_ = 0;  // number of paths in repaired_; the maximum since the start
  uint64_t rays_ = 0;
  std::shared_ptr<RadianceImage> repaired_;
};

}  // namespace lamplighter
