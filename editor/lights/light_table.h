// The light table: a row for each light of the scene, with what the user set and what the method
// makes of it. Plain data; the panel only draws it.
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

// What a light costs and brings, by the method's own account.
struct LightFigures {
  int samples = 0;            // its VPLs that are shown, bounced ones included
  int patches = 0;            // patches that at least one of them reaches, wholly or in part
  uint64_t work = 0;          // VPLs × patches that they reach
  int mapsPending = 0;        // VPLs that wait to be brought up to date
  int age = 0;                // frames that the oldest of these has waited
  double milliseconds = 0.0;  // its part, by work, of the time that a frame takes for light
  double share = 0.0;         // its part of the flux of all that shine

  bool operator==(const LightFigures&) const = default;
};

struct LightRow {
  LightSource source;
  std::string name;
  vec3 colour{1.0f};            // of luminance 1; white for black ones
  std::optional<float> kelvin;  // where the colour is near a temperature's
  double strength = 0.0;        // in `unit`
  LightUnit unit = LightUnit::lumens;
  vec2 size{0.0f};  // [m]; a mesh: √area
  LightState state;
  bool visible = true;
  bool shines = true;  // by all states together, hidden ones aside
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

// Rows as the document has them, in the order of its nodes, without figures.
std::vector<LightRow> lightRows(const Document& document, LightUnit unit);
// Stable, by what the column shows; rows that show nothing there come last both ways.
void sortRows(std::vector<LightRow>& rows, LightColumn column, bool ascending);
// The ids of rows from one to another, as a click with Shift selects; the clicked one last.
std::vector<NodeId> rowsBetween(const std::vector<LightRow>& rows, NodeId from, NodeId to);

// By light; the sky under kNoNode. `lightSeconds`: what the method took for light in one frame.
std::map<NodeId, LightFigures> lightFigures(const Inspection& inspection, double lightSeconds);
// Each light's part of all flux in the scene, by luminance.
std::map<NodeId, double> fluxShares(const RenderScene& scene);

}  // namespace lamplighter
