#include "renderer/scene/units.h"

#include <algorithm>

namespace lamplighter {
namespace {

constexpr float kMostNear = 0.1f;  // [unit]

}  // namespace

View inUnits(const View& metres, float unit) {
  View view = metres;
  view.eye /= unit;
  view.znear /= unit;
  if (unit < 1.0f) view.znear = std::min(view.znear, kMostNear);
  return view;
}

}  // namespace lamplighter
