// Estimates the error of a picture from a noisy reference.
#pragma once

#include <string>

#include "editor/error_meter/reference_sampler.h"

namespace lamplighter {

struct ErrorEstimate {
  double error = 0.0;        // relative RMSE as in renderer/image/metrics.h: 0.031 is 3.1%
  double uncertainty = 0.0;  // one standard deviation of `error`, from the reference's noise
  double atMost = 0.0;       // `error` plus two standard deviations
  int samples = 0;           // total number of paths per block
  // True if the squared error is larger than two standard deviations of the noise. Otherwise only
  // the upper bound `atMost` is known.
  bool isKnown = false;

  // "3.1% ± 0.4%", or "below 5.2%" while the noise hides the error.
  std::string text() const;
};

// `picture` must have the size of the halves (averageBlocks). Throws InputError if the sizes
// differ.
ErrorEstimate estimateError(const Image& picture, const ReferenceHalves& reference);

}  // namespace lamplighter
