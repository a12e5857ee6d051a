// Pictures of a level in other units of length are those in metres.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "tests/support/scenes/scaled_scene.h"

namespace lamplighter::test {

// The settled picture of the room of all lights.
inline Image pictureOfRoom(std::unique_ptr<Backend> backend, float factor,
                           const std::string& method, const Settings& settings) {
  FrameRenderer renderer(std::move(backend));
  const Scene scene = scaledScene(roomOfAllLights(), factor);
  const View view = scaledView(viewOfRoom(93, 61), factor);
  SceneChanges changes = SceneChanges::all();
  for (;;) {
    const GiOutput out = renderer.render({scene, changes, view, method, settings});
    if (out.settled) return out.radiance->pixels();
    changes = {};
  }
}

inline Settings settingsOfTechnique(const std::string& technique) {
  Settings settings;
  settings.set("share_memory", 0);
  settings.set("technique", technique);
  settings.set("vpls", 60);
  settings.set("map_resolution", 32);
  settings.set("antialias", 1);
  settings.set("refine", 0);
  return settings;
}

}  // namespace lamplighter::test
