#include "editor/lights/light_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "editor/lights/colour_temperature.h"
#include "editor/lights/work_light.h"
#include "renderer/sampling/emitters/lights.h"

namespace lamplighter {

namespace {

vec2 sizeOf(const Scene& scene, const LightSource& light) {
  if (light.node == kNoNode) return vec2(0.0f);
  const Node& node = scene.nodes[light.index];
  if (!node.area) return vec2(static_cast<float>(std::sqrt(light.measure.area)));
  const bool isRound = node.area->shape == AreaShape::disk || node.area->shape == AreaShape::sphere;
  return isRound ? vec2(node.area->size.x) : node.area->size;
}

// The sort key of a row: a text or a number; neither if the cell is empty.
struct SortKey {
  std::string text;
  std::optional<double> number;
  bool isEmpty() const { return text.empty() && !number; }
  auto operator<=>(const SortKey& o) const {
    if (const auto c = text.compare(o.text); c != 0) return c <=> 0;
    const double a = number.value_or(0.0), b = o.number.value_or(0.0);
    return a < b   ? std::strong_ordering::less
           : a > b ? std::strong_ordering::greater
                   : std::strong_ordering::equal;
  }
};

SortKey keyOf(const LightRow& r, LightColumn column) {
  switch (column) {
    case LightColumn::name:
      return {r.name, {}};
    case LightColumn::kind:
      return {kindLabel(r.source.measure.kind), {}};
    case LightColumn::colour: {  // by saturation: white lights are together
      const float most = std::max({r.colour.r, r.colour.g, r.colour.b});
      const float least = std::min({r.colour.r, r.colour.g, r.colour.b});
      return {"", most > 0.0f ? 1.0 - static_cast<double>(least / most) : 0.0};
    }
    case LightColumn::temperature:
      return {"", r.kelvin ? std::optional<double>(*r.kelvin) : std::nullopt};
    case LightColumn::strength:
      return {unitSymbol(r.unit), r.strength};  // lights with the same unit are together
    case LightColumn::size:
      return {"", r.size.x > 0.0f ? std::optional<double>(static_cast<double>(r.size.x * r.size.y))
                                  : std::nullopt};
    case LightColumn::on:
      return {"", r.state.on ? 1.0 : 0.0};
    case LightColumn::solo:
      return {"", r.state.solo ? 1.0 : 0.0};
    case LightColumn::group:
      return {r.state.group, {}};
    case LightColumn::samples:
      return {"", r.figures.samples};
    case LightColumn::share:
      return {"", r.figures.share};
    case LightColumn::patches:
      return {"", r.figures.patches};
    case LightColumn::milliseconds:
      return {"", r.figures.milliseconds};
    case LightColumn::pending:
      return {"", r.figures.mapsPending};
    case LightColumn::age:
      return {"", r.figures.age};
  }
  return {};
}

}  // namespace

std::vector<LightRow> lightRows(const Document& document, LightUnit unit) {
  const Scene& scene = document.scene;
  const ShiningLights shining = shiningLights(scene);
  const std::vector<bool> visible = visibleNodes(scene);
  const std::unordered_set<NodeId> selected = document.selected();
  std::vector<LightRow> rows;
  for (const LightSource& light : lightsOf(scene)) {
    LightRow r;
    r.source = light;
    const bool isSky = light.node == kNoNode;
    r.name = isSky ? "Sky" : scene.nodes[light.index].name;
    const vec3 emission = emissionOf(scene, light);
    const float strength = luminance(emission);
    if (strength > 0.0f) r.colour = emission / strength;
    if (!isSky || scene.sky.kind != SkyKind::image) r.kelvin = temperatureOf(emission);
    r.unit = unitFor(light.measure, unit);
    r.strength = unitsPerRadiance(light.measure, r.unit) * static_cast<double>(strength);
    r.size = sizeOf(scene, light);
    r.state = stateOf(scene, light);
    r.visible = isSky || visible[light.index];
    r.shines = isSky ? shining.sky : shining.nodes[light.index];
    r.selected = !isSky && selected.contains(light.node);
    rows.push_back(std::move(r));
  }
  return rows;
}

void sortRows(std::vector<LightRow>& rows, LightColumn column, bool ascending) {
  std::vector<SortKey> keys;
  for (const LightRow& r : rows) keys.push_back(keyOf(r, column));
  std::vector<size_t> order(rows.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    if (keys[a].isEmpty() != keys[b].isEmpty()) return keys[b].isEmpty();
    return ascending ? keys[a] < keys[b] : keys[b] < keys[a];
  });
  std::vector<LightRow> sorted;
  for (const size_t i : order) sorted.push_back(std::move(rows[i]));
  rows = std::move(sorted);
}

std::vector<NodeId> rowsBetween(const std::vector<LightRow>& rows, NodeId from, NodeId to) {
  const auto at = [&](NodeId id) {
    return std::find_if(rows.begin(), rows.end(),
                        [&](const LightRow& r) { return r.source.node == id; });
  };
  auto first = at(from), last = at(to);
  if (last == rows.end()) return {};
  if (first == rows.end()) first = last;
  if (last < first) std::swap(first, last);
  std::vector<NodeId> ids;
  for (auto r = first; r <= last; ++r) {
    if (r->source.node != kNoNode && r->source.node != to) ids.push_back(r->source.node);
  }
  if (to != kNoNode) ids.push_back(to);
  return ids;
}

std::map<NodeId, LightFigures> lightFigures(const Inspection& in, double lightSeconds) {
  std::map<NodeId, LightFigures> out;
  std::vector<LightFigures*> bySlot;
  for (const LightSample& light : in.lights) {
    LightFigures& f = out[light.id.light];
    if (light.isStale) {
      ++f.mapsPending;
      f.age = std::max(f.age, light.framesWaiting);
    }
    if (!light.isLive) continue;
    ++f.samples;
    ++f.work;  // the sample itself, even without information on patches
    if (light.vpl.slot < 0) continue;
    const auto slot = static_cast<size_t>(light.vpl.slot);
    if (bySlot.size() <= slot) bySlot.resize(slot + 1, nullptr);
    bySlot[slot] = &f;
  }
  if (in.patches) {
    std::vector<LightFigures*> reached;
    in.patches->forEachPatch([&](std::span<const uint8_t> row) {
      reached.clear();
      LightFigures* last = nullptr;
      for (size_t slot = 0; slot < std::min(row.size(), bySlot.size()); ++slot) {
        LightFigures* f = bySlot[slot];
        if (f == nullptr || static_cast<Occlusion>(row[slot]) == Occlusion::full) continue;
        ++f->work;
        if (f == last) continue;  // samples of a light are mostly adjacent
        last = f;
        if (std::find(reached.begin(), reached.end(), f) == reached.end()) reached.push_back(f);
      }
      for (LightFigures* f : reached) ++f->patches;
    });
  }
  double work = 0.0;
  for (const auto& [id, f] : out) work += static_cast<double>(f.work);
  for (auto& [id, f] : out) {
    if (work > 0.0) f.milliseconds = 1e3 * lightSeconds * static_cast<double>(f.work) / work;
  }
  return out;
}

std::map<NodeId, double> fluxShares(const RenderScene& scene) {
  const LightSet lights(scene);
  std::map<NodeId, double> out;
  double all = 0.0;
  for (const Emitter& e : lights.emitters()) {
    const double flux = luminance(e.flux);
    if (e.node == kWorkLight || !(flux > 0.0)) continue;
    out[e.node] += flux;
    all += flux;
  }
  for (auto& [id, flux] : out) flux = all > 0.0 ? flux / all : 0.0;
  return out;
}

}  // namespace lamplighter
