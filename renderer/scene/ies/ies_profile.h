// How a luminaire spreads its light, as manufacturers measure it: IESNA LM-63 files of 1986, 1991,
// 1995 and 2002, photometry of types B and C.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/scene/ies/ies_lobes.h"

namespace lamplighter {

struct IesProfile {
  std::string file;   // its name, beside the scene's file
  std::string text;   // all of it, to be saved with the scene
  float peak = 0.0f;  // intensity in the brightest direction [cd], the file's factors included
  // ∫ at() dω [sr], by the midpoint rule in cells of 1°; peak times this are the file's lumens.
  float solidAngle = 0.0f;
  // 1 − cos of the widest angle from −Z at which there is any light; 2: all round.
  float cap = 2.0f;
  std::vector<SpotLobe> lobes;  // what virtual point lights make of at()
  // Intensity over the peak's, [0, 1], at horizontal angle h and vertical angle v at h·vertical +
  // v, angles in degrees, growing.
  //   C: v from the nadir, h about it.
  //   B: h is the latitude towards +X, v the longitude about X, both from the aim.
  bool isTypeB = false;
  std::vector<float> vertical, horizontal;
  std::vector<float> values;
  // TILT=INCLUDE: how much of its light a lamp gives when the luminaire is turned away from
  // straight down, the attitude in which LM-63 tells how the lamp lies in it: by angle in degrees,
  // growing. Empty: all of it.
  std::vector<float> tiltAngles, tiltFactors;

  // The factor for a luminaire that aims there, a unit direction in the world whose up is +Y.
  // Linear between the angles; beyond them, that of the nearest.
  float atTilt(const vec3& aim) const;

  // Of a unit direction in the light's space: nadir and aim are −Z, the plane C0 is towards +X, C90
  // and B's V = 90° towards +Y. Linear in both angles, mirrored where the file has one side or a
  // quarter alone; 0 beyond its angles.
  float at(const vec3& direction) const;

  bool operator==(const IesProfile& o) const { return file == o.file && text == o.text; }
};

// Reads the text of a file. Throws InputError: what is wrong with `file`.
std::shared_ptr<const IesProfile> parseIes(std::string_view text, const std::string& file);
// The same from a file. Throws InputError.
std::shared_ptr<const IesProfile> readIes(const std::string& path);

}  // namespace lamplighter
