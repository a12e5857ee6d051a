// The light table: one row for each light of the scene, with the user's settings and the costs in
// the method. This is plain data; the panel only draws it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "editor/lights/light_list.h"
#include "renderer/methods/gi_method.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Cost and contribution of a light, as reported by the method.
struct LightFigures {
  int samples = 0;            // its VPLs in the inspection, with bounces
  int patches = 0;            // patches that at least one of its VPLs reaches, fully or partly
  uint64_t work = 0;          // VPLs × patches that they reach
  int mapsPending = 0;        // VPLs that wait for an update
  int age = 0;                // longest wait of these, in frames
  double milliseconds = 0.0;  // its part of the frame's lighting time, in proportion to `work`
  double share = 0.0;         // its part of the flux of all active lights

  bool operator==(const LightFigures&) const = default;
};

struct LightRow {
  LightSource source;
  std::string name;
  vec3 colour{1.0f};            // luminance 1; white for black lights
  std::optional<float> kelvin;  // only if the colour is close to a colour temperature
  double strength = 0.0;        // in `unit`
  LightUnit unit = LightUnit::lumens;
  vec2 size{0.0f};  // [m]; a mesh: √area
  LightState state;
  bool visible = true;
  bool shines = true;  // on, considering all states except hidden
  bool selected = false;
  LightFigures figures;
};

enum class LightColumn {
  name,
  kind,
  colour,
  temperature,
  strength,
  size,
  on,
  solo,
  group,
  samples,
  share,
  patches,
  milliseconds,
  pending,
  age
};

// Rows from the document, in node order, without figures.
std::vector<LightRow> lightRows(const Document& document, LightUnit unit);
// Stable sort by the displayed value of the column. Rows without a value are last in both
// directions.
void sortRows(std::vector<LightRow>& rows, LightColumn column, bool ascending);
// The ids of the rows between two rows, for a click with Shift. The clicked row is last.
std::vector<NodeId> rowsBetween(const std::vector<LightRow>& rows, NodeId from, NodeId to);

// Figures by light; the sky is kNoNode. `lightSeconds`: the lighting time of the method in one
// frame.
std::map<NodeId, LightFigures> lightFigures(const Inspection& inspection, double lightSeconds);
// The part of each light in the total flux of the scene, by luminance.
std::map<NodeId, double> fluxShares(const RenderScene& scene);

}  // namespace lamplighter
