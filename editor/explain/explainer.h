// "Why is it dark here?": the point that was asked about, and the answer as of the present frame.
#pragma once

#include <optional>

#include "editor/explain/explanation.h"
#include "editor/tools/overlay.h"

namespace lamplighter {

class Explainer {
 public:
  // The answer; null while nothing is asked.
  const Explanation* answer() const { return answer_ ? &*answer_ : nullptr; }
  void ask(const Scene& scene, const RenderScene& world, const RayCaster& rays,
           const PickedPoint& point, const LightSamples& samples);
  // The same question of what is there now. It is taken back when the object is gone.
  void askAgain(const Scene& scene, const RenderScene& world, const RayCaster& rays,
                const LightSamples& samples);
  void close() { *this = Explainer(); }

  // The light whose rays are drawn; null: none, or it is gone.
  const LightShare* chosen() const;
  // By its row; throws InputError when there are not so many.
  void choose(int row);
  // What stands before a light; throws InputError when there is nothing of that number.
  NodeId blocker(int row, int index) const;

  // A mark at the point, and lines to the samples of the chosen light: those that reach the point,
  // and those that something keeps away, as far as that.
  void draw(Overlay& overlay, const View& view, const RenderScene& world, const RayCaster& rays,
            const LightSamples& samples) const;

 private:
  const LightShare& row(int index) const;

  std::optional<Anchor> anchor_;
  std::optional<Explanation> answer_;
  std::optional<NodeId> chosen_;
};

}  // namespace lamplighter
