// Debug views of the method of paper 2.
#pragma once

#include "renderer/methods/imperfect_light/imperfect_picture.h"

namespace lamplighter {

const std::vector<MethodView>& imperfectViews();
// The views by name, for Inspection::pictures. They keep references to the picture.
std::map<std::string, std::function<ViewPicture()>> imperfectPictures(
    const ImperfectPicture& picture);

}  // namespace lamplighter
