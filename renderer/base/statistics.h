// Statistics as members of a struct, declared like parameters. The status line, the timeline, the
// costs of budgets, `render --stats` and the docs list them by these declarations alone:
//
//   struct ProbeStats : GiStats {  // statistics of every method, see renderer/methods/gi_method.h
//     int probes = 0;
//   };
//   const StatisticTable<ProbeStats>& probeStatistics() {
//     static const StatisticTable<ProbeStats> table{
//         {&ProbeStats::probes, {.name = "probes", .label = "Probes", .unit = "probes",
//                                .meaning = "Probes in the level.", .status = "{} probes"}},
//         commonStatistics()};
//     return table;
//   }
//
// table.specs() goes into MethodInfo, and the method returns published(stats, table).
#pragma once

#include <concepts>
#include <functional>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lamplighter {

// The work limit of a frame on which the time of a stage depends.
enum class StageWork {
  fixed,     // none of the following
  updates,   // GiStats::updates
  surfaces,  // GiStats::surfaceWork
  preview,   // GiStats::previewUpdates
};

// A stage of a frame: work whose time is measured by itself. A method declares its stages as
// constants, lists them in MethodInfo and measures them with a StageTimer
// (renderer/methods/stage_timer.h). Stages are the same if their names are.
struct StageSpec {
  std::string_view name{};     // as in --stats and in exports of the timeline
  std::string_view label{};    // as in the timeline
  std::string_view meaning{};  // one sentence
  StageWork work = StageWork::fixed;
  bool operator==(const StageSpec& other) const { return name == other.name; }
};

struct StageTime {
  StageSpec stage;
  double seconds = 0.0;
};

enum class StatisticKind {
  state,    // of the picture or of the data behind it
  work,     // done in this frame
  pending,  // waits for a later frame; the status line highlights it
};

struct StatisticSpec {
  std::string name{};     // as in --stats
  std::string label{};    // as in the timeline
  std::string unit{};     // what is counted, in the plural; or "bytes", "m", "%", "share" (of 1)
  std::string meaning{};  // one sentence
  StatisticKind kind = StatisticKind::state;
  bool inTimeline = false;  // is a counter of the timeline

  // The text in the status line; "": none. {} is the value; "(s)" and "(es)" become a plural unless
  // the value is 1. A text that starts with a comma or a space continues that of the row before.
  std::string status{};
  double shownFrom = 1.0;  // smaller values are not shown in the status line
  double shownBelow = std::numeric_limits<double>::infinity();  // only smaller values are shown

  std::string budget{};  // the parameter that limits it, if any
  // For work: the stages that do it. Their time is the cost of the budget.
  std::vector<StageSpec> stages{};
  // For a state: its text in the cost of the budget, in the format of `status`. Not shown if the
  // value is 0.
  std::string cost{};
  bool isHeld = true;  // for bytes: they are in memory; false: they would be needed

  bool isWhole = true;  // the table sets it from the type of the member
};

// A statistic of a frame. The specification is one of a table, which lasts as long as the program.
struct Statistic {
  const StatisticSpec* spec = nullptr;
  double value = 0.0;
};

// "1,234", "3.1 MiB", "0.14 m", "42%".
std::string valueText(const StatisticSpec& spec, double value);
// `pattern` with the value, see StatisticSpec::status.
std::string filled(const std::string& pattern, const StatisticSpec& spec, double value);

// A part of the status line.
struct StatusText {
  std::string name, text, meaning;
  bool isPending = false;  // work that waits
  bool isZero = false;
};
std::vector<StatusText> statusTexts(const std::vector<Statistic>& statistics);

// Adds the statistics of a frame to those of earlier frames: sums of work, the last state.
void accumulate(std::vector<Statistic>& total, const std::vector<Statistic>& frame);

// One row, or several tables one after the other, as ParameterTable.
template <typename Stats>
class StatisticTable {
 public:
  template <typename Owner, typename T>
  requires std::derived_from<Stats, Owner> StatisticTable(T Owner::*member, StatisticSpec spec) {
    spec.isWhole = std::integral<T>;
    specs_.push_back(std::move(spec));
    values_.push_back([member](const Stats& stats) { return static_cast<double>(stats.*member); });
  }

  StatisticTable(std::initializer_list<StatisticTable> parts) {
    for (const StatisticTable& part : parts) {
      specs_.insert(specs_.end(), part.specs_.begin(), part.specs_.end());
      values_.insert(values_.end(), part.values_.begin(), part.values_.end());
    }
  }

  template <typename Base>
  requires(std::derived_from<Stats, Base> && !std::same_as<Stats, Base>)
      StatisticTable(const StatisticTable<Base>& table)
      : specs_(table.specs_), values_(table.values_.begin(), table.values_.end()) {}

  const std::vector<StatisticSpec>& specs() const { return specs_; }

  // The values in the order of the table, which must outlive them.
  std::vector<Statistic> of(const Stats& stats) const {
    std::vector<Statistic> all;
    for (size_t i = 0; i < specs_.size(); ++i) all.push_back({&specs_[i], values_[i](stats)});
    return all;
  }

 private:
  template <typename>
  friend class StatisticTable;

  std::vector<StatisticSpec> specs_;
  std::vector<std::function<double(const Stats&)>> values_;
};

}  // namespace lamplighter
