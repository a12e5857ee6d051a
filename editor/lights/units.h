// Units of light strength: lumens, candela, nits, watts and lux. The renderer uses radiance and
// intensity. By the luminance of the colour, a nit is one unit of radiance and a candela one unit
// of intensity (renderer/scene/gltf/gltf_lights.cpp).
#pragma once

#include <optional>
#include <string>

namespace lamplighter {

enum class LightUnit { lumens, candela, nits, watts, lux };

// Watts of radiant flux, not of electrical power, at the efficacy that defines the candela: 683
// lm/W (BIPM, The International System of Units, 9th edition, K_cd). Blender's glTF exporter uses
// the same value.
inline constexpr double kLumensPerWatt = 683.0;

enum class LightKind { rectangle, disk, sphere, tube, mesh, point, spot, sun, sky };
const char* kindLabel(LightKind kind);

// Factors from the luminance of a light to its flux or intensity.
struct LightMeasure {
  LightKind kind = LightKind::rectangle;
  double area = 0.0;       // rectangle to mesh: emitting area, both sides if two-sided [m²]
  double projected = 0.0;  // rectangle to tube: largest projected area [m²]
  // The remaining fraction of the luminance: the mean of a picture on a rectangle or disk, or the
  // effect of the tilt of a luminaire with a profile. 1: all of it.
  double left = 1.0;
  double solidAngle = 0.0;  // point, spot: ∫ intensity over the brightest dω [sr]
};

// The factor from the renderer's unit (W/(m² sr), W/sr or W/m²) to `unit`. 0: the light does not
// have this unit.
//   surfaces: nits 1, lm πA, cd the projected area, W lm/683; all multiplied by `left`
//   point and spot: cd 1, lm the solid angle, W lm/683; also multiplied by `left`
//   sun: lux 1; sky: nits 1
double unitsPerRadiance(const LightMeasure& measure, LightUnit unit);
// `wanted` if the light has this unit, otherwise the usual unit of its kind.
LightUnit unitFor(const LightMeasure& measure, LightUnit wanted);

const char* unitSymbol(LightUnit unit);  // "lm", "cd", "nt", "W", "lx"
// Also accepts "nits" and the full names.
std::optional<LightUnit> unitNamed(const std::string& text);

}  // namespace lamplighter
