#include "editor/error_meter/error_meter.h"

#include <utility>

#include "renderer/image/average_blocks.h"
#include "renderer/methods/path_tracer/parameters.h"

namespace lamplighter {
namespace {

// While the picture changes in every frame, it is compared only every few frames, because the gl
// backend must read it back.
constexpr int kFramesBetween = 6;

}  // namespace

void ErrorMeter::frame(const Document& document, const View& view, bool lightOnly,
                       const SceneChanges& changes, const GiOutput& output) {
  const std::shared_ptr<RadianceImage>& picture = output.radiance;
  measured_ = false;
  if (changes.everything) ++levels_;
  stale_ = stale_ || !changes.none();
  const PathTracerOptions paths =
      pathTracerParameters().read(document.render.values).options(lightOnly);
  if (stale_ || !subject_ || !(subject_->view == view) || !(subject_->paths == paths) ||
      subject_->block != block_) {
    halves_.reset();
    estimate_.reset();
    stale_ = true;
  }
  if (!on_ && toMeasure_ == 0) return;
  if (std::exchange(stale_, false))
    subject_ = std::make_shared<const MeterSubject>(MeterSubject{
        ++numbers_, levels_, std::make_shared<const Scene>(document.scene), view, paths, block_});
  if (toMeasure_ > 0) {
    ReferenceSampler sampler;
    sampler.begin(*subject_);
    for (int i = 0; i < toMeasure_; ++i) sampler.step();
    take(std::make_shared<const ReferenceHalves>(sampler.halves()));
    toMeasure_ = 0;
    measured_ = true;
    isNews_ = true;
  }
  ++framesSince_;
  // The first settled picture is compared at once: the picture before it may be very different.
  const bool hasWaited = framesSince_ >= kFramesBetween || (output.settled && !comparedSettled_);
  const bool isDue = isNews_ || (picture != compared_ && hasWaited);
  if (halves_ && isDue && picture->width() == view.width && picture->height() == view.height) {
    compare(*picture);
    compared_ = picture;
    comparedSettled_ = output.settled;
  }
}

void ErrorMeter::take(std::shared_ptr<const ReferenceHalves> halves) {
  if (!halves || !subject_ || halves->subject != subject_->number || halves->samples == 0) return;
  halves_ = std::move(halves);
  isNews_ = true;
}

void ErrorMeter::compare(RadianceImage& picture) {
  estimate_ = estimateError(averageBlocks(picture.pixels(), halves_->block), *halves_);
  framesSince_ = 0;
  isNews_ = false;
}

std::string ErrorMeter::text() const {
  if (estimate_) return "error " + estimate_->text();
  return on_ ? "error \u2026" : "";
}

void ErrorMeter::pause() {
  stale_ = true;
  measured_ = false;
  subject_.reset();
  halves_.reset();
  compared_.reset();
  estimate_.reset();
}

}  // namespace lamplighter
