// "Why is it dark here?": the selected point and the explanation for the current frame.
#pragma once

#include <optional>

#include "editor/explain/explanation.h"
#include "editor/explain/light_senders.h"
#include "editor/tools/overlay.h"

namespace lamplighter {

class Explainer {
 public:
  // The explanation. Null while no point is selected.
  const Explanation* answer() const { return answer_ ? &*answer_ : nullptr; }
  // Where the bounced light of the point comes from; meaningful while answer() is not null.
  const LightSenders& senders() const { return senders_; }
  void ask(const Scene& scene, const RenderScene& world, const RayCaster& rays,
           const PickedPoint& point, const LightSamples& samples, const Inspection& inspection);
  // Computes the explanation again for the current scene. Clears it if the object is gone.
  void askAgain(const Scene& scene, const RenderScene& world, const RayCaster& rays,
                const LightSamples& samples, const Inspection& inspection);
  void close() { *this = Explainer(); }

  // The light whose rays are drawn. Null: none is chosen, or the light is gone.
  const LightShare* chosen() const;
  // Chooses a light by its row. Throws InputError if the row is out of range.
  void choose(int row);
  // The surface to which lines are drawn instead; senders().all if it is all of them. Null: none.
  const LightSender* chosenSender() const;
  // Chooses a surface by its row, or all of them. Both throw InputError if there is no such
  // surface.
  void chooseSender(int row);
  void chooseAllSenders();
  // The object of a row of senders(). Throws InputError if the row is out of range, or represents
  // several surfaces.
  NodeId senderObject(int row) const;
  // An object that blocks the light of a row. Throws InputError if the index is out of range.
  NodeId blocker(int row, int index) const;

  // Draws a mark at the point and lines to the samples of the chosen light, or to the places of the
  // chosen surface: stronger lines for more light. The line of a blocked sample ends at the
  // occluder. The view is in metres.
  void draw(Overlay& overlay, const View& metres, const RenderScene& world, const RayCaster& rays,
            const LightSamples& samples) const;

 private:
  const LightShare& row(int index) const;
  void requireSenders() const;
  const LightSender& senderRow(int index) const;

  std::optional<Anchor> anchor_;
  std::optional<Explanation> answer_;
  LightSenders senders_;
  std::optional<NodeId> chosen_;
  std::optional<SenderKey> chosenSender_;
  bool hasChosenAll_ = false;  // all senders are chosen
};

}  // namespace lamplighter
