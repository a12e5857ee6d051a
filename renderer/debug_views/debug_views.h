// The views that are not radiance and not drawn by a method; each is a function of the subject. The
// data that a view needs must exist (see problemOf).
#pragma once

#include "renderer/debug_views/view_picture.h"

namespace lamplighter::views {

ViewPicture albedo(const ViewSubject& subject);
ViewPicture normals(const ViewSubject& subject);
ViewPicture flat(const ViewSubject& subject);
ViewPicture patches(const ViewSubject& subject);
ViewPicture patchLevels(const ViewSubject& subject);
ViewPicture occlusion(const ViewSubject& subject);
ViewPicture partialLights(const ViewSubject& subject);
ViewPicture lightMaps(const ViewSubject& subject);
ViewPicture falseColour(const ViewSubject& subject);
ViewPicture lightOcclusion(const ViewSubject& subject);
ViewPicture lightsPerPatch(const ViewSubject& subject);
ViewPicture pendingPatches(const ViewSubject& subject);
ViewPicture lightMapDensity(const ViewSubject& subject);
ViewPicture shadowMap(const ViewSubject& subject);
ViewPicture edgeMask(const ViewSubject& subject);
ViewPicture prtObjects(const ViewSubject& subject);
ViewPicture meshEdges(const ViewSubject& subject);
ViewPicture meshSamples(const ViewSubject& subject);
ViewPicture meshContrast(const ViewSubject& subject);
ViewPicture meshAge(const ViewSubject& subject);
ViewPicture mapAge(const ViewSubject& subject);

}  // namespace lamplighter::views
