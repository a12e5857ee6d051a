// Photometric profiles: the measured angular distribution of luminaires. IESNA LM-63 files of 1986,
// 1991, 1995 and 2002, photometry of types B and C.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/scene/ies/ies_lobes.h"

namespace lamplighter {

struct IesProfile {
  std::string file;   // file name; the file is in the folder of the scene's file
  std::string text;   // the whole file, saved with the scene
  float peak = 0.0f;  // intensity in the brightest direction [cd], including the file's factors
  // ∫ at() dω [sr], by the midpoint rule in cells of 1°; peak × solidAngle is the file's luminous
  // flux [lm].
  float solidAngle = 0.0f;
  // 1 − cos of the largest angle from −Z with any light; 2: all directions.
  float cap = 2.0f;
  std::vector<SpotLobe> lobes;  // approximation of at() for VPLs
  // Relative intensity in [0, 1] at horizontal angle index h and vertical angle index v: values[h ·
  // vertical.size() + v]. Angles in degrees, ascending.
  //   C: vertical from the nadir, horizontal around it.
  //   B: horizontal is the latitude towards +X, vertical the longitude around X, both from the aim.
  bool isTypeB = false;
  std::vector<float> vertical, horizontal;
  std::vector<float> values;
  // TILT=INCLUDE: relative light output of the lamp when the luminaire is tilted from straight
  // down, the orientation for which LM-63 describes the lamp's position. By angle [degrees],
  // ascending. Empty: always 1.
  std::vector<float> tiltAngles, tiltFactors;

  // Factor for a luminaire with this aim, a unit direction in world space (up is +Y). Interpolated
  // linearly; beyond the angles the nearest value.
  float atTilt(const vec3& aim) const;

  // Relative intensity in a unit direction in the space of the light: nadir and aim are −Z, the
  // plane C0 is towards +X, C90 and V = 90° of type B towards +Y. Bilinear in the angles; mirrored
  // if the file has only one side or a quarter; 0 beyond its angles.
  float at(const vec3& direction) const;

  bool operator==(const IesProfile& o) const { return file == o.file && text == o.text; }
};

// Parses the text of a file. Throws InputError that names `file`.
std::shared_ptr<const IesProfile> parseIes(std::string_view text, const std::string& file);
// The same from a file. Throws InputError.
std::shared_ptr<const IesProfile> readIes(const std::string& path);

}  // namespace lamplighter
