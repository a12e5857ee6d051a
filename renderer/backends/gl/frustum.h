// What a view can see, as the backend names it.
#pragma once

#include "renderer/scene/frustum.h"

namespace lamplighter::gl {

using lamplighter::Frustum;

}  // namespace lamplighter::gl
