#include "ui/app/replay_checks.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include "renderer/image/image_io.h"
#include "ui/app/picture_check.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

// Tolerances of the cpu backend's pictures, of 255. If a ray hits two triangles at the same
// distance, another processor may choose the other one.
constexpr double kCpuLargest = 4.0, kCpuMean = 0.02;

void add(std::string& problems, const std::string& more) {
  if (!problems.empty() && !more.empty()) problems += "; ";
  problems += more;
}

}  // namespace

void ReplayChecks::begin(const ReplayRun& run) {
  if (first_.empty()) first_ = std::exchange(now_, {});
  now_.clear();
  run_ = run;
}

const ReplayChecks::Seen* ReplayChecks::find(const std::vector<Seen>& seen,
                                             const std::string& name) const {
  const auto at =
      std::find_if(seen.begin(), seen.end(), [&](const Seen& s) { return s.name == name; });
  return at == seen.end() ? nullptr : &*at;
}

fs::path ReplayChecks::outputOf(const Checkpoint& checkpoint, const std::string& ending) const {
  const fs::path folder = options_.outputFolder.empty() ? "out/replay" : options_.outputFolder;
  const std::string run = run_.label.empty() ? "" : "." + run_.label;
  return folder / (recording_.path.stem().string() + "." + checkpoint.name + run + ending);
}

void ReplayChecks::writeBaseline(const Checkpoint& checkpoint, const Image8& picture) const {
  if (checkpoint.image) writePng(halved(picture), recording_.baselineOf(checkpoint));
}

std::string ReplayChecks::writeHeatMap(const Checkpoint& checkpoint, const Image8& picture,
                                       const Image8& expected) const {
  const fs::path heat = outputOf(checkpoint, ".difference.png");
  fs::create_directories(heat.parent_path());
  writePng(picture, outputOf(checkpoint, ".png"));
  if (picture.width == expected.width && picture.height == expected.height)
    writePng(differencePicture(picture, expected), heat);
  return "; see " + heat.string();
}

std::string ReplayChecks::documentProblem(const Checkpoint& checkpoint,
                                          const std::string& document) const {
  if (checkpoint.document.empty() || checkpoint.document == document) return "";
  return "the document is " + document + " and should be " + checkpoint.document;
}

std::string ReplayChecks::baselineProblem(const Checkpoint& checkpoint,
                                          const Image8& picture) const {
  if (!checkpoint.image) return "";
  const fs::path path = recording_.baselineOf(checkpoint);
  if (!fs::exists(path))
    return "there is no " + path.filename().string() + "; write it with --update-baselines";
  const Image8 baseline = readPicture(path), seen = halved(picture);
  const PictureDifference difference = comparePictures(seen, baseline);
  const bool isGood = run_.isOnCpu ? difference.within(kCpuLargest, kCpuMean)
                                   : difference.within(checkpoint.max, checkpoint.mean);
  return isGood ? "" : difference.text() + writeHeatMap(checkpoint, seen, baseline);
}

std::string ReplayChecks::sameAsProblem(const Checkpoint& checkpoint, const Image8& picture) const {
  if (checkpoint.sameAs.empty()) return "";
  const Seen* other = find(now_, checkpoint.sameAs);
  if (other == nullptr) return "there is no earlier checkpoint " + checkpoint.sameAs;
  const PictureDifference difference = comparePictures(picture, other->picture);
  if (difference.none()) return "";
  return "differs from " + checkpoint.sameAs + ": " + difference.text() +
         writeHeatMap(checkpoint, picture, other->picture);
}

std::string ReplayChecks::firstRunProblem(const Checkpoint& checkpoint, const std::string& document,
                                          const Image8& picture) const {
  const Seen* other = find(first_, checkpoint.name);
  if (other == nullptr) return "the first run did not reach it";
  std::string problem;
  if (other->document != document)
    problem = "the document is " + document + " and was " + other->document;
  const PictureDifference difference = comparePictures(picture, other->picture);
  const bool isGood =
      run_.hasSameBackend ? difference.none() : difference.within(checkpoint.max, checkpoint.mean);
  if (!isGood) add(problem, difference.text() + writeHeatMap(checkpoint, picture, other->picture));
  return problem;
}

void ReplayChecks::take(const Checkpoint& checkpoint, const std::string& document, Image8 picture) {
  // A method given on the command line renders a different picture.
  const bool isOtherMethod = !options_.method.empty();
  std::string problem = documentProblem(checkpoint, document);
  if (run_.label.empty()) {
    if (!isOtherMethod) add(problem, baselineProblem(checkpoint, picture));
  } else {
    add(problem, firstRunProblem(checkpoint, document, picture));
  }
  if (!isOtherMethod) add(problem, sameAsProblem(checkpoint, picture));
  const std::string name = checkpoint.name + (run_.label.empty() ? "" : " with " + run_.label);
  (problem.empty() ? passed_ : failed_) += 1;
  report_.push_back({{"name", name}, {"passed", problem.empty()}, {"problem", problem}});
  std::cout << name << ": " << (problem.empty() ? "passed" : "FAILED: " + problem) << std::endl;
  now_.push_back({checkpoint.name, document, std::move(picture)});
}

}  // namespace lamplighter
