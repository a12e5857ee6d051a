#include "editor/lights/units.h"

#include <array>
#include <numbers>

namespace lamplighter {

namespace {

struct UnitName {
  LightUnit unit;
  const char* symbol;
  const char* name;
};
constexpr std::array kUnits = {
    UnitName{LightUnit::lumens, "lm", "lumens"}, UnitName{LightUnit::candela, "cd", "candela"},
    UnitName{LightUnit::nits, "nt", "nits"}, UnitName{LightUnit::watts, "W", "watts"},
    UnitName{LightUnit::lux, "lx", "lux"}};

double lumensPerRadiance(const LightMeasure& m) {
  switch (m.kind) {
    case LightKind::point:
    case LightKind::spot:
      return m.solidAngle * m.left;
    case LightKind::sun:
    case LightKind::sky:
      return 0.0;
    default:
      return std::numbers::pi * m.area * m.left;
  }
}

}  // namespace

const char* kindLabel(LightKind kind) {
  static constexpr std::array kLabels = {"Rectangle", "Disk", "Sphere", "Tube", "Mesh",
                                         "Point",     "Spot", "Sun",    "Sky"};
  return kLabels[static_cast<size_t>(kind)];
}

double unitsPerRadiance(const LightMeasure& m, LightUnit unit) {
  const bool isPoint = m.kind == LightKind::point || m.kind == LightKind::spot;
  switch (unit) {
    case LightUnit::lumens:
      return lumensPerRadiance(m);
    case LightUnit::watts:
      return lumensPerRadiance(m) / kLumensPerWatt;
    case LightUnit::candela:
      return isPoint ? m.left : m.projected * m.left;
    case LightUnit::nits:
      return isPoint || m.kind == LightKind::sun ? 0.0 : m.left;
    case LightUnit::lux:
      return m.kind == LightKind::sun ? 1.0 : 0.0;
  }
  return 0.0;
}

LightUnit unitFor(const LightMeasure& m, LightUnit wanted) {
  if (unitsPerRadiance(m, wanted) > 0.0) return wanted;
  if (m.kind == LightKind::sun) return LightUnit::lux;
  return m.kind == LightKind::point || m.kind == LightKind::spot ? LightUnit::candela
                                                                 : LightUnit::nits;
}

const char* unitSymbol(LightUnit unit) { return kUnits[static_cast<size_t>(unit)].symbol; }

std::optional<LightUnit> unitNamed(const std::string& text) {
  for (const UnitName& u : kUnits) {
    if (text == u.symbol || text == u.name) return u.unit;
  }
  return std::nullopt;
}

}  // namespace lamplighter
