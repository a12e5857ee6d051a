// The part of the light in a picture, for views that show parts separately.
#pragma once

namespace lamplighter {

enum class LightPart {
  all,
  direct,   // directly from lights, emissive surfaces and the sky
  indirect  // after at least one bounce
};

}  // namespace lamplighter
