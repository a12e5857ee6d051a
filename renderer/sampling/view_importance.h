// Samples where light arrives: of more candidate VPLs than are wanted, those that bring most to
// what the camera sees get their shadow maps (Georgiev and Slusallek, "Simple and Robust Iterative
// Importance Sampling of Virtual Point Lights", Eurographics 2010 short papers). It is an answer to
// paper 1, section 6.1, figure 6-1: behind a narrow gap few of a random walk's samples arrive.
#pragma once

#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/point_visibility.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// At most `count` places that the camera sees, evenly over the picture and a little beyond its
// edges, in an order of which any part is even too. A function of scene, view and count alone; the
// view's size counts only by its ratio.
std::vector<SeenPoint> seenPoints(const RenderScene& scene, const RayCaster& rays, const View& view,
                                  int count);

// The view for which samples are chosen: the camera's, with eye and direction on a grid (half a
// metre, 15°), so that small moves change no sample. Where a surface stands between the eye and the
// grid's point, the eye itself. So it depends on the present camera and scene alone, not on the way
// there.
View steadyView(const View& view, const RayCaster& rays);

// What each candidate brings: √mean over the points of (E/ΣE)², E its irradiance there with its
// shadow found by a ray and 1/d² bounded as when it is shown, ΣE that of all candidates and of
// `others`. So the error of the picture relative to its brightness at each place is least for
// samples in proportion to it. Unit 1, relative to each other only.
std::vector<float> importanceOf(std::span<const SceneVpl> candidates,
                                std::span<const SceneVpl> others, std::span<const SeenPoint> points,
                                const RayCaster& rays, float clampDistance, PointVisibility& kept);

// `count` of the candidates, in their order, each brighter by what it stands for. The candidates
// are the first points of sequences, one an emitter; of these each place in the scene takes as many
// of the first as its importance says, as sequences of points of varying density are made from
// ranks (Ostromoukhov, Donohue, Jodoin, "Fast Hierarchical Importance Sampling with Blue Noise
// Properties", 2004). Where all are as important it is the first points, as without. Importance
// counts in steps of 2, so that an edit changes few samples and the brightness of few. The mean
// over scrambles is that of all candidates.
std::vector<SceneVpl> chooseByImportance(std::span<const SceneVpl> candidates,
                                         std::span<const float> importance, int count);

// The set with as many of its candidates (VplCounts::candidates) chosen for the view as were
// wanted. Lights' own samples are as ever; they stand first. `kept` spares rays and changes
// nothing.
VplSet chooseForView(const VplSet& set, const VplCounts& counts, const RenderScene& scene,
                     const RayCaster& rays, const View& view, float clampDistance,
                     PointVisibility& kept);

}  // namespace lamplighter
