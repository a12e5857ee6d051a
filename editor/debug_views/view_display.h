// Which view of the level is shown, and the light sample that it shows. Neither is part of the
// document: they have no undo and are not saved.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "editor/document/document.h"
#include "renderer/debug_views/view_picture.h"
#include "renderer/frame/frame.h"
#include "renderer/image/histogram.h"

namespace lamplighter {

class ViewDisplay {
 public:
  DebugView view() const { return view_; }
  void setView(DebugView view) { view_ = view; }
  // Whether the frame must render irradiance only for this view.
  bool lightOnly() const;
  LightPart part() const;
  bool showsVpls() const { return showsVpls_; }
  void showVpls(bool on) { showsVpls_ = on; }

  // The tone curve of the display. Like the window, it is a setting of the display.
  ToneMapper toneMapper() const { return toneMapper_; }
  void setToneMapper(ToneMapper mapper) { toneMapper_ = mapper; }
  bool showsHistogram() const { return showsHistogram_; }
  void showHistogram(bool on) { showsHistogram_ = on; }
  bool showsHistory() const { return showsHistory_; }
  void showHistory(bool on) { showsHistory_ = on; }
  // Histogram of the picture after exposure and tone mapping. Computed once for each picture.
  const Histogram& histogram(const std::shared_ptr<RadianceImage>& radiance, float exposureEv);

  const FalseColour& falseColour() const { return falseColour_; }
  void setFalseColour(const FalseColour& f) { falseColour_ = f; }
  // The light that the light-occlusion view shows: the last light that was selected or chosen,
  // while it exists; otherwise the light of the chosen light sample. The sky is kNoNode.
  void chooseLight(NodeId light) { light_ = light; }
  NodeId chosenLight(const Inspection& inspection) const;

  // Chooses a light sample by index. Throws InputError if the index is out of range.
  void choose(const Inspection& inspection, int index);
  // Index of the chosen light sample. It is the first sample if none was chosen or the chosen one
  // is gone. kNone: there are no light samples.
  int chosen(const Inspection& inspection) const;

  // Computes the picture of the view if the view is not radiance and something changed since the
  // last call. `changed` reports changes that the key below does not contain.
  void update(FrameRenderer& renderer, RadianceImage& radiance, const View& camera,
              const RenderSettings& settings, bool changed);
  // Null: the view shows the radiance of the frame.
  const std::shared_ptr<const ViewPicture>& picture() const { return picture_; }

  // Text for the status line: the view, the reason if it shows nothing, and the chosen light sample
  // if the view shows one. "": no text.
  std::string viewText() const;
  // `unit`: unit of the inspection [m].
  std::string vplText(const Scene& scene, const Inspection& inspection, float unit) const;

 private:
  struct Key {
    DebugView view = DebugView::lit;
    View camera;
    RenderSettings settings;
    int chosen = kNone;
    ToneMapper toneMapper = ToneMapper::filmic;
    FalseColour falseColour;
    NodeId light = kNoNode;
    bool operator==(const Key&) const = default;
  };

  DebugView view_ = DebugView::lit;
  bool showsVpls_ = false, showsHistogram_ = false, showsHistory_ = false;
  ToneMapper toneMapper_ = ToneMapper::filmic;
  std::optional<VplId> chosen_;
  std::optional<NodeId> light_;
  FalseColour falseColour_;
  Key key_;
  std::shared_ptr<const ViewPicture> picture_;
  // The picture of the histogram. Kept alive so that no other picture can get its address.
  std::shared_ptr<RadianceImage> countedFrom_;
  float countedEv_ = 0.0f;
  ToneMapper countedBy_ = ToneMapper::filmic;
  Histogram histogram_;
};

}  // namespace lamplighter
