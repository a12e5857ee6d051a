// Automatic exposure.
#pragma once

#include "renderer/image/image.h"

namespace lamplighter {

// Returns the EV that maps the log-average luminance of the picture (Reinhard et al. 2002, eq. 1)
// to middle grey (0.18). The brightest 2% of the pixels (visible lamps) and black pixels do not
// count. The EV is limited so that at most 15% of the counted pixels exceed 1, as could happen in a
// dark room with white trim. Rounded to a quarter stop, in [-16, 16]; 0 for a black picture.
float autoExposureEv(const Image& radiance);

}  // namespace lamplighter
