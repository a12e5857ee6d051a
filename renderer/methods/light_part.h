// Which part of the light a picture shows, for views that take it apart.
#pragma once

namespace lamplighter {

enum class LightPart {
  all,
  direct,   // straight from lights, and what shines itself, and the sky
  indirect  // what bounced on its way
};

}  // namespace lamplighter
