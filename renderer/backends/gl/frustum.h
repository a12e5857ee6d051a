// The view frustum under the name that the gl backend uses.
#pragma once

#include "renderer/scene/frustum.h"

namespace lamplighter::gl {

using lamplighter::Frustum;

}  // namespace lamplighter::gl
