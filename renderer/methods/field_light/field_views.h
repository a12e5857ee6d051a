// Debug views of a light field.
#pragma once

#include <string_view>

#include "renderer/light_field/light_field.h"
#include "renderer/methods/atlas_picture.h"

namespace lamplighter {

const std::vector<MethodView>& fieldViews();

// The current scene and its field.
struct FieldViewSubject {
  const AtlasPicture& picture;
  const LightField& light;
  const RenderScene& scene;
  const RayCaster& rays;
};
// Draws a view by its name, which must be one of fieldViews().
ViewPicture drawFieldView(std::string_view name, const FieldViewSubject& in);

}  // namespace lamplighter
