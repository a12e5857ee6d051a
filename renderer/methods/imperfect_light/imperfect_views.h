// Debug views of the method of paper 2.
#pragma once

#include "renderer/methods/imperfect_light/imperfect_picture.h"

namespace lamplighter {

const std::vector<MethodView>& imperfectViews();
// By name, for Inspection::pictures. They refer to the picture.
std::map<std::string, std::function<ViewPicture()>> imperfectPictures(
    const ImperfectPicture& picture);

}  // namespace lamplighter
