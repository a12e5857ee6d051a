// The same level in another unit of length.
#pragma once

#include "renderer/scene/camera.h"
#include "renderer/scene/scene.h"

namespace lamplighter::test {

// Every length times `factor`. The brightness of point and spot lights changes such that irradiance
// stays the same. Exact for powers of two.
Scene scaledScene(const Scene& scene, float factor);
View scaledView(const View& view, float factor);

// A room with two boxes, open at one side, lit by an area light, a point light, a spot and a sun.
Scene roomOfAllLights();
View viewOfRoom(int width, int height);

}  // namespace lamplighter::test
