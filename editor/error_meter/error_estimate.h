// How far a picture is from the truth, as far as a noisy reference can tell.
#pragma once

#include <string>

#include "editor/error_meter/reference_sampler.h"

namespace lamplighter {

struct ErrorEstimate {
  double error = 0.0;        // relative RMSE as in renderer/image/metrics.h: 0.031 is 3.1%
  double uncertainty = 0.0;  // one standard deviation of `error`, from the reference's noise
  double atMost = 0.0;       // error with two standard deviations on top
  int samples = 0;           // paths a block in all
  // The square of the error stands out from the noise by two deviations: before, all that can be
  // said is `atMost`.
  bool isKnown = false;

  // "3.1% ± 0.4%", or "below 5.2%" while the noise hides the error.
  std::string text() const;
};

// `picture`: of the size of the halves (averageBlocks). Throws InputError when the sizes differ.
ErrorEstimate estimateError(const Image& picture, const ReferenceHalves& reference);

}  // namespace lamplighter
