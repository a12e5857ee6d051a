// An exposure for a picture that nobody has chosen one for.
#pragma once

#include "renderer/image/image.h"

namespace lamplighter {

// The EV at which the picture's middle lies at middle grey (0.18): the log-average of luminance
// (Reinhard et al. 2002, eq. 1), with the brightest 2% (lamps in view) and black pixels left out;
// but never so high that more than 15% of the rest are over 1, as in a dark room with white trim.
// Rounded to a quarter stop, in [-16, 16]; 0 for a black picture.
float autoExposureEv(const Image& radiance);

}  // namespace lamplighter
