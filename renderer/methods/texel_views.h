// Debug views of texels, for methods whose bounced light goes along links.
#pragma once

#include <span>
#include <string_view>

#include "renderer/methods/atlas_picture.h"
#include "renderer/surface_depths/texel_radiosity.h"

namespace lamplighter {

const std::vector<MethodView>& texelViews();

// The current scene and its texels.
struct TexelViewSubject {
  const AtlasPicture& picture;
  const TexelRadiosity& light;
  const RenderScene& scene;
  const RayCaster& rays;
};
// Draws a view by its name, which must be one of texelViews().
ViewPicture drawTexelView(std::string_view name, const TexelViewSubject& in);

}  // namespace lamplighter
