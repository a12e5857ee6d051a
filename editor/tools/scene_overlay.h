// Draws marks of lights and the selection over the picture.
#pragma once

#include "editor/document/document.h"
#include "editor/tools/overlay.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// `view`: in metres.
void drawScene(Overlay& overlay, const View& view, const Document& document,
               const RenderScene& scene);

}  // namespace lamplighter
