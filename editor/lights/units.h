// What the strength of a light is called: lumens, candela, nits, watts or lux. The renderer knows
// radiance and intensity; a nit is one unit of radiance and a candela one of intensity
// (renderer/scene/gltf/gltf_lights.cpp), by the luminance of the colour.
#pragma once

#include <optional>
#include <string>

namespace lamplighter {

enum class LightUnit { lumens, candela, nits, watts, lux };

// Watts of light, not of electricity, at the efficacy that defines the candela: 683 lm/W (BIPM, The
// International System of Units, 9th edition, K_cd). Blender's glTF exporter takes the same.
inline constexpr double kLumensPerWatt = 683.0;

enum class LightKind { rectangle, disk, sphere, tube, mesh, point, spot, sun, sky };
const char* kindLabel(LightKind kind);

// What a light's luminance is multiplied by to be a flux or an intensity.
struct LightMeasure {
  LightKind kind = LightKind::rectangle;
  double area = 0.0;       // rectangle to mesh: that emits, both sides where it does [m²]
  double projected = 0.0;  // rectangle to tube: seen from where most of it is [m²]
  // Of the luminance, what a picture on a rectangle or disk leaves, by its mean, or the tilt of a
  // luminaire with a profile; 1: all of it.
  double left = 1.0;
  double solidAngle = 0.0;  // point, spot: ∫ intensity over the brightest dω [sr]
};

// How much one unit of the renderer's (W/(m² sr), W/sr or W/m²) is; 0: the light has no such unit.
//   surfaces: nits 1, lm πA, cd the projected area, W lm/683; all times what is left
//   point and spot: cd 1, lm the solid angle, W lm/683; likewise
//   sun: lux 1; sky: nits 1
double unitsPerRadiance(const LightMeasure& measure, LightUnit unit);
// The unit if the light has it, else the one it is best known by.
LightUnit unitFor(const LightMeasure& measure, LightUnit wanted);

const char* unitSymbol(LightUnit unit);  // "lm", "cd", "nt", "W", "lx"
// Also "nits" and the full names.
std::optional<LightUnit> unitNamed(const std::string& text);

}  // namespace lamplighter
