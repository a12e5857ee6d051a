#include <algorithm>
#include <iostream>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "editor/cli/parameter_range.h"
#include "editor/cli/subcommands.h"
#include "renderer/registry/registry.h"

namespace lamplighter::cli {

namespace {

std::string kindOf(const ParameterSpec& p) {
  static constexpr const char* kNames[] = {"bool", "int", "float", "choice"};
  return kNames[p.defaultValue.index()];
}

std::string join(const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : ", ") + part;
  return out;
}

std::vector<std::string> needsOf(const MethodInfo& m) {
  std::vector<std::string> out;
  for (const Service service : m.needs.services) out.emplace_back(nameOf(service));
  for (const KernelNeed& kernels : m.needs.kernels) out.push_back("kernels " + kernels.name);
  if (m.needs.openGl) out.emplace_back("OpenGL");
  return out;
}

std::vector<std::string> shownBy(const MethodInfo& m) {
  std::vector<std::string> out;
  for (const ShownCapability& shown : m.shows)
    out.push_back(nameOf(shown.capability) + (shown.when.empty() ? "" : " " + shown.when));
  return out;
}

const char* kindOf(const StatisticSpec& s) {
  static constexpr const char* kNames[] = {"state", "work", "pending"};
  return kNames[static_cast<size_t>(s.kind)];
}

void printMethodsJson() {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const MethodInfo& m : lamplighter::methods()) {
    nlohmann::ordered_json j{{"name", m.name}, {"label", m.label}, {"citation", m.citation}};
    j["needs"] = needsOf(m);
    j["shows"] = shownBy(m);
    j["views"] = nlohmann::ordered_json::array();
    for (const MethodView& v : m.views)
      j["views"].push_back({{"name", v.name}, {"label", v.label}, {"help", v.help}});
    j["parameters"] = nlohmann::ordered_json::array();
    for (const ParameterSpec& p : m.parameters) {
      nlohmann::ordered_json q{{"name", p.name}, {"label", p.label}, {"type", kindOf(p)},
                               {"unit", p.unit}, {"help", p.help},   {"group", labelOf(p.group)}};
      std::visit([&](const auto& v) { q["default"] = v; }, p.defaultValue);
      if (!p.choices.empty()) {
        q["choices"] = p.choices;
      } else if (!std::holds_alternative<bool>(p.defaultValue)) {
        q["minimum"] = p.minimum;
        q["maximum"] = p.maximum;
      }
      j["parameters"].push_back(q);
    }
    j["statistics"] = nlohmann::ordered_json::array();
    for (const StatisticSpec& s : m.statistics)
      j["statistics"].push_back({{"name", s.name},
                                 {"label", s.label},
                                 {"unit", s.unit},
                                 {"kind", kindOf(s)},
                                 {"meaning", s.meaning}});
    j["stages"] = nlohmann::ordered_json::array();
    for (const StageSpec& s : m.stages)
      j["stages"].push_back({{"name", s.name}, {"label", s.label}, {"meaning", s.meaning}});
    all.push_back(j);
  }
  std::cout << all.dump(2) << '\n';
}

// A row of a Markdown table: the name, and the other cells.
struct MethodRow {
  std::string name, cells;
  bool operator==(const MethodRow&) const = default;
};

std::vector<MethodRow> parameterRows(const MethodInfo& m) {
  std::vector<MethodRow> rows;
  for (const ParameterSpec& p : m.parameters)
    rows.push_back(
        {p.name, fmt::format("{} | {} | {} | {} | {} | {}", labelOf(p.group), kindOf(p), p.unit,
                             Settings::format(p.defaultValue), rangeOf(p), p.help)});
  return rows;
}

std::vector<MethodRow> statisticRows(const MethodInfo& m) {
  std::vector<MethodRow> rows;
  for (const StatisticSpec& s : m.statistics)
    rows.push_back({s.name, fmt::format("{} | {} | {}", kindOf(s), s.unit, s.meaning)});
  return rows;
}

std::vector<MethodRow> stageRows(const MethodInfo& m) {
  std::vector<MethodRow> rows;
  for (const StageSpec& s : m.stages) rows.push_back({std::string(s.name), std::string(s.meaning)});
  return rows;
}

// A kind of tables. Rows that several methods have are in one table of their own.
struct MethodTables {
  std::string what, head;
  std::vector<MethodRow> (*rowsOf)(const MethodInfo&);

  bool isShared(const MethodRow& row) const {
    return std::ranges::count_if(lamplighter::methods(), [&](const MethodInfo& m) {
             const std::vector<MethodRow> rows = rowsOf(m);
             return std::ranges::find(rows, row) != rows.end();
           }) > 1;
  }
  void print(const std::vector<MethodRow>& rows) const {
    if (rows.empty()) return;
    std::cout << head;
    for (const MethodRow& row : rows)
      std::cout << fmt::format("| `{}` | {} |\n", row.name, row.cells);
  }
  void printShared() const {
    std::vector<MethodRow> shared;
    for (const MethodInfo& m : lamplighter::methods())
      for (const MethodRow& row : rowsOf(m))
        if (isShared(row) && std::ranges::find(shared, row) == shared.end()) shared.push_back(row);
    print(shared);
  }
  void printOf(const MethodInfo& m) const {
    std::vector<MethodRow> own;
    std::string shared;
    for (const MethodRow& row : rowsOf(m)) {
      if (isShared(row))
        shared += (shared.empty() ? "`" : ", `") + row.name + '`';
      else
        own.push_back(row);
    }
    if (!shared.empty()) std::cout << fmt::format("\nCommon {}: {}.\n", what, shared);
    print(own);
  }
};

const MethodTables kTables[] = {
    {"parameters",
     "\n| parameter | group | type | unit | default | range | |\n| --- | --- | --- | --- | --- | "
     "--- "
     "| --- |\n",
     parameterRows},
    {"statistics", "\n| statistic | kind | unit | |\n| --- | --- | --- | --- |\n", statisticRows},
    {"stages", "\n| stage | |\n| --- | --- |\n", stageRows}};

void printMethodsMarkdown() {
  std::cout
      << "# Parameters, statistics and stages\n\nWritten by `lamplighter methods --markdown`. "
         "Parameters are set with `--set name=value`. Statistics are in the JSON of `render "
         "--stats`: those of the last frame, and the work of all frames. Stages of a frame are in "
         "`stages` of the same JSON and in the timeline, with their times.\n\n## Common to several "
         "methods\n";
  for (const MethodTables& tables : kTables) tables.printShared();
  for (const MethodInfo& m : lamplighter::methods()) {
    std::cout << fmt::format("\n## {}: {}\n\n{}\n\n- Needs: {}.\n", m.name, m.label, m.citation,
                             join(needsOf(m)));
    if (!m.shows.empty()) std::cout << fmt::format("- Shows: {}.\n", join(shownBy(m)));
    for (const MethodView& v : m.views)
      std::cout << fmt::format("- View `{}`: {}\n", v.name, v.help);
    for (const MethodTables& tables : kTables) tables.printOf(m);
  }
}

void printMethodsText() {
  for (const MethodInfo& m : lamplighter::methods()) {
    std::cout << fmt::format("{}: {}\n  {}\n  needs {}\n", m.name, m.label, m.citation,
                             join(needsOf(m)));
    if (!m.shows.empty()) std::cout << fmt::format("  shows {}\n", join(shownBy(m)));
    for (const MethodView& v : m.views)
      std::cout << fmt::format("  --view {}  {}\n", v.name, v.help);
    for (const ParameterSpec& p : m.parameters) {
      std::cout << fmt::format("  --set {}={}  ({}{}{}) {}\n", p.name,
                               Settings::format(p.defaultValue), rangeOf(p),
                               p.unit.empty() ? "" : " ", p.unit, p.help);
    }
    std::cout << '\n';
  }
}

}  // namespace

int methods(const MethodsOptions& options) {
  if (options.json) {
    printMethodsJson();
  } else if (options.markdown) {
    printMethodsMarkdown();
  } else {
    printMethodsText();
  }
  return 0;
}

}  // namespace lamplighter::cli
