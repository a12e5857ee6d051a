// Chooses VPLs by their contribution to the view: of more candidate VPLs than wanted, only those
// that contribute most to what the camera sees are used and get shadow maps (Georgiev and
// Slusallek, "Simple and Robust Iterative Importance Sampling of Virtual Point Lights",
// Eurographics 2010 short papers). Solves the problem of paper 1, section 6.1, figure 6-1: few
// samples of a random walk pass through a narrow gap.
#pragma once

#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/choice/point_visibility.h"
#include "renderer/sampling/view_points.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Importance of each candidate: √mean over the points of (E/ΣE)². E is its irradiance at the point,
// with the shadow found by a ray and 1/d² clamped as in the picture; ΣE is the sum over all
// candidates and `others`. VPLs in proportion to it minimise the error relative to the local
// brightness. Unit 1, only relative values matter.
std::vector<float> importanceOf(std::span<const SceneVpl> candidates,
                                std::span<const SceneVpl> others, std::span<const SeenPoint> points,
                                const RayCaster& rays, float clampDistance, PointVisibility& kept);

// Upper bound of the weight of a chosen VPL, 1/(its probability), relative to the mean weight,
// which is the number of candidates divided by the number of chosen ones.
constexpr float kLargestWeight = 4.0f;

// Chooses `count` candidates, in their order, and scales each to the flux of those that it
// replaces. The candidates are the first points of one sequence per emitter. Each region of the
// scene takes the first of its points, as many as its importance requires, like sequences with
// varying density made from ranks (Ostromoukhov, Donohue, Jodoin, "Fast Hierarchical Importance
// Sampling with Blue Noise Properties", 2004). With uniform importance the result is the first
// points, as without importance sampling. Importance is rounded to steps of a factor of 2, so that
// an edit changes few VPLs and the brightness of few. The mean over scrambles equals the light of
// all candidates.
std::vector<SceneVpl> chooseByImportance(std::span<const SceneVpl> candidates,
                                         std::span<const float> importance, int count);

// Returns the set with the wanted number of candidates (VplCounts::candidates), chosen for the view
// in two stages: unshadowed_importance.h leaves three times the wanted number, of which
// importanceOf() takes those to keep. The probabilities of both stages multiply, so the mean stays
// the light of all candidates; their product is rounded, so kLargestWeight bounds it, too. The
// lights' own (direct) VPLs are unchanged and come first. `visibility` is a cache that saves rays;
// it does not change the result.
VplSet chooseForView(const VplSet& set, const VplCounts& counts, const RenderScene& scene,
                     const RayCaster& rays, const View& view, float clampDistance,
                     PointVisibility& visibility);

}  // namespace lamplighter
