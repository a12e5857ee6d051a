// Bounced light by light samples that are chosen for the view, with shadow maps of points: paper 2.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

MethodInfo imperfectShadowMapsInfo();

}  // namespace lamplighter
