#include "renderer/path_repair/repaired_method.h"

#include <algorithm>
#include <utility>

#include "renderer/methods/common_parameters.h"
#include "renderer/path_repair/edge_resolve.h"
#include "renderer/path_repair/path_repair.h"

namespace lamplighter {
namespace {

constexpr StageSpec kRepairStage{"repair", "Repair",
                                 "Tracing paths of the reference to repair a picture at rest, and "
                                 "rays for antialiased edges before.",
                                 StageWork::preview};

struct RepairStats {
  int paths = 0, wanted = 0;
  uint64_t rays = 0;
};

const StatisticTable<RepairStats>& repairStatistics() {
  using S = RepairStats;
  static const StatisticTable<S> table{
      {&S::paths,
       {.name = "paths_repaired",
        .label = "Repaired with",
        .unit = "paths",
        .meaning = "Paths per pixel so far; 0 while the first repair in blocks is shown.",
        .status = "repaired with {}"}},
      {&S::wanted,
       {.name = "paths_to_repair",
        .label = "To repair with",
        .unit = "paths",
        .meaning = "Paths per pixel at which repair ends.",
        .status = " of {} paths"}},
      {&S::rays,
       {.name = "repair_rays",
        .label = "Rays of repair",
        .unit = "rays",
        .meaning = "Rays traced to repair the picture, and to antialias edges before it settles.",
        .kind = StatisticKind::work,
        .inTimeline = true}}};
  return table;
}

struct PathTracerSettings : PathParameters, SurfaceParameters {};

PathTracerOptions pathsOf(const FrameInputs& in) {
  static const ParameterTable<PathTracerSettings> table{pathParameters(), surfaceParameters()};
  const PathTracerSettings read = table.read(in.settings);
  return {read.bounces, static_cast<uint32_t>(read.seed), in.lightOnly, read.speculars,
          read.leastRoughness};
}

// A picture that will settle in fewer frames than this is not repaired before it has settled.
constexpr int kManyFrames = 20;
// Rows of paths per frame if paths are not urgent.
constexpr int kSlowRows = 16;

class RepairedMethod final : public GiMethod {
 public:
  explicit RepairedMethod(std::unique_ptr<GiMethod> method) : method_(std::move(method)) {}

  GiOutput render(const FrameInputs& in) override {
    const bool mayRepair = in.services.budget().refineUpdates > 0 && in.part == LightPart::all;
    const int wanted = mayRepair ? repairParameters().read(in.settings).repair : 0;
    // Both halves have the same number of paths.
    const PathRepair::Options options{wanted / 2 * 2, pathsOf(in)};
    const bool isStill = in.changes.none() && in.view == view_;
    const bool skipsMethod = isStill && mayRepairAlone(in, options.paths);
    RepairStats stats;
    GiOutput out = skipsMethod ? idle() : renderMethod(in, options.paths > 0);
    const double start = in.stopwatch ? in.stopwatch() : 0.0;
    if (skipsMethod) {
      ++framesAlone_;
    } else {
      resolveEdges(in, options.paths > 0, out, stats);
      keep(in, isStill, out);
    }
    if (options.paths > 0 && out.settled && isStill)
      repair(in, options, out, stats);
    else if (options.paths > 0 && out.settled)
      showFirst(out);
    else if (options.paths > 0 && isStill && mayPreview(in, out))
      preview(in, options, skipsMethod, out, stats);
    else
      repair_.restart();
    if (in.stopwatch) out.stats.stageSeconds.push_back({kRepairStage, in.stopwatch() - start});
    const std::vector<Statistic> declared = repairStatistics().of(stats);
    out.stats.declared.insert(out.stats.declared.end(), declared.begin(), declared.end());
    return out;
  }

  void reset() override {
    method_->reset();
    repair_.restart();
    edges_.restart();
    last_ = {};
    mayBeSkipped_ = false;
  }
  Inspection inspect() const override { return method_->inspect(); }

 private:
  // A repaired picture is not refined with light samples or finer shadow maps, because paths show
  // the correct light sooner.
  GiOutput renderMethod(const FrameInputs& in, bool isRepaired) {
    if (!isRepaired) return method_->render(in);
    Settings settings = in.settings;
    settings.set("refine", 0);
    settings.set("settled_map_scale", 1);
    return method_->render({in.scene, in.changes, in.view, in.backend, in.services, settings,
                            in.frame, in.stopwatch, in.stageTimes, in.lightOnly, in.part});
  }

  // The picture of a frame without the method may depend on everything except the budget.
  static Settings withoutBudget(Settings settings) {
    settings.reset(kUpdates);
    return settings;
  }

  // After an edit, and in a new scene, the method gets another frame at once, which shows glossy
  // reflections.
  void keep(const FrameInputs& in, bool isStill, const GiOutput& out) {
    last_ = out.settled ? GiOutput() : out;
    settings_ = withoutBudget(in.settings);
    isLightOnly_ = in.lightOnly;
    framesAlone_ = 0;
    mayBeSkipped_ = isStill;
  }

  // Whether this frame may keep the last picture of the method and only trace paths.
  bool mayRepairAlone(const FrameInputs& in, int paths) const {
    return mayBeSkipped_ && framesAlone_ < in.services.budget().previewFrames && last_.radiance &&
           mayPreview(in, last_) && repair_.isUrgent(paths) && isLightOnly_ == in.lightOnly &&
           settings_ == withoutBudget(in.settings);
  }

  // The last output of the method, without the work of that frame.
  GiOutput idle() const {
    GiOutput out = last_;
    GiStats& s = out.stats;
    s.updates = s.refineUpdates = s.previewUpdates = 0;
    s.surfaceWork = 0.0f;
    s.raysTraced = 0;
    for (StageTime& t : s.stageSeconds) t.seconds = 0.0;
    for (Statistic& of : s.declared)
      if (of.spec->kind == StatisticKind::work) of.value = 0.0;
    out.failure = nullptr;
    return out;
  }

  // An edit that settles at once, such as of the brightness of a light, is shown without waiting
  // for paths.
  void showFirst(GiOutput& out) {
    repair_.restart();
    out.refined = false;
  }

  void repair(const FrameInputs& in, const PathRepair::Options& options, GiOutput& out,
              RepairStats& stats) {
    out.stats.refineUpdates = repair_.goOn(in, options, out.radiance, out.surfaces.get(),
                                           in.services.budget().refineUpdates);
    out.refined = repair_.isDone(options);
    if (repair_.image()) out.radiance = repair_.image();
    stats = {repair_.paths(), options.paths, stats.rays + repair_.takeRays()};
  }

  // Not if the picture will settle soon anyway.
  bool mayPreview(const FrameInputs& in, const GiOutput& out) const {
    return in.services.budget().previewUpdates > 0 && out.radiance->isInMainMemory() &&
           (repair_.hasBegun() || out.stats.framesUntilSettled >= kManyFrames);
  }

  // If paths are not urgent, few rows are traced, so that the picture settles. If they are urgent,
  // they are traced in frames without the method.
  void preview(const FrameInputs& in, PathRepair::Options options, bool isAlone, GiOutput& out,
               RepairStats& stats) {
    options.isPreview = true;
    int rows = in.services.budget().previewUpdates;
    if (!repair_.isUrgent(options.paths))
      rows = std::min(rows, kSlowRows);
    else if (!isAlone && in.services.budget().previewFrames > 0)
      rows = 0;
    out.stats.previewUpdates = repair_.goOn(in, options, out.radiance, nullptr, rows);
    if (repair_.image()) out.radiance = repair_.image();
    stats = {repair_.paths(), options.paths, stats.rays + repair_.takeRays()};
  }

  // Antialiases edges of a picture that has not settled, while the view does not change; in a new
  // scene at once, because its first frame takes long anyway.
  void resolveEdges(const FrameInputs& in, bool isWanted, GiOutput& out, RepairStats& stats) {
    const bool isSame = in.view == view_ && !in.changes.rebuilt && !in.changes.objects &&
                        in.changes.switchedObjects.empty();
    const bool hasTime = isSame || in.changes.rebuilt;
    const bool isShown = isWanted && !out.settled && out.smoothEdges != SmoothEdges::all &&
                         out.radiance->isInMainMemory();
    view_ = in.view;
    if (!isSame || !isWanted || (!isShown && in.changes.surfaces())) edges_.restart();
    if (!hasTime || !isShown) return;
    stats.rays += edges_.findMore(in);
    out.radiance = edges_.resolved(out.radiance, out.smoothEdges == SmoothEdges::none);
  }

  std::unique_ptr<GiMethod> method_;
  PathRepair repair_;
  EdgeResolve edges_;
  View view_;  // of the last frame
  // The last output of the method, with antialiased edges, and its input; whether it may be shown
  // again, and in how many frames it was.
  GiOutput last_;
  Settings settings_;
  bool isLightOnly_ = false, mayBeSkipped_ = false;
  int framesAlone_ = 0;
};

}  // namespace

const ParameterTable<RepairParameters>& repairParameters() {
  static const ParameterTable<RepairParameters> table{
      &RepairParameters::repair,
      "repair",
      "Repair with",
      "paths",
      "Paths per pixel of the reference that repair a picture at rest in the editor's window: the "
      "missing light that they find is added, except where it cannot be told from noise. More: "
      "less error; the time at rest grows in proportion. On the cpu backend the first paths are "
      "traced, and edges are antialiased, before the picture has settled. 0: no repair; the "
      "picture is refined with light samples instead. Recordings and replays do not repair; render "
      "does only if this is set.",
      {0, 1 << 16, kLogarithmic},
      ParameterGroup::picture};
  return table;
}

MethodInfo repaired(MethodInfo method) {
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(method.parameters, repairParameters().specs());
  append(method.statistics, repairStatistics().specs());
  method.stages.push_back(kRepairStage);
  method.make = [make = std::move(method.make)](Backend& backend) {
    return std::make_unique<RepairedMethod>(make(backend));
  };
  return method;
}

}  // namespace lamplighter
