// Which view of the level is shown, and which light sample it is about. Neither is part of the
// work: no undo, nothing saved.
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
  // What the frame must render for the view.
  bool lightOnly() const;
  LightPart part() const;
  bool showsVpls() const { return showsVpls_; }
  void showVpls(bool on) { showsVpls_ = on; }

  // How radiance is shown; a setting of the display, as the window is.
  ToneMapper toneMapper() const { return toneMapper_; }
  void setToneMapper(ToneMapper mapper) { toneMapper_ = mapper; }
  bool showsHistogram() const { return showsHistogram_; }
  void showHistogram(bool on) { showsHistogram_ = on; }
  bool showsHistory() const { return showsHistory_; }
  void showHistory(bool on) { showsHistory_ = on; }
  // Of the picture as it is exposed and mapped; counted once for each.
  const Histogram& histogram(const std::shared_ptr<RadianceImage>& radiance, float exposureEv);

  const FalseColour& falseColour() const { return falseColour_; }
  void setFalseColour(const FalseColour& f) { falseColour_ = f; }
  // The light that the view of a light's occlusion is about: the last one that was selected or
  // chosen, as long as it is there; else that of the chosen light sample. Its sky: kNoNode.
  void chooseLight(NodeId light) { light_ = light; }
  NodeId chosenLight(const Inspection& inspection) const;

  // By its place among the light samples; throws InputError when there are not so many.
  void choose(const Inspection& inspection, int index);
  // The place of the chosen one: the first while none was chosen or when it is gone. kNone: there
  // are no light samples.
  int chosen(const Inspection& inspection) const;

  // Makes the picture of the view, if it is no radiance and anything changed since the last call.
  // `changed`: something that the key below does not tell.
  void update(FrameRenderer& renderer, RadianceImage& radiance, const View& camera,
              const RenderSettings& settings, bool changed);
  // Null: the frame's radiance is what is shown.
  const std::shared_ptr<const ViewPicture>& picture() const { return picture_; }

  // For the status line: what the view is and why it shows nothing; the chosen light sample, where
  // one is looked at. "": nothing to say.
  std::string viewText() const;
  std::string vplText(const Scene& scene, const Inspection& inspection) const;

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
  // What the histogram is of; held, so that no other picture can have its address.
  std::shared_ptr<RadianceImage> countedFrom_;
  float countedEv_ = 0.0f;
  ToneMapper countedBy_ = ToneMapper::filmic;
  Histogram histogram_;
};

}  // namespace lamplighter
