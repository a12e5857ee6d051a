// One recording that is played on any level with any method: a lamp is dragged, an object is moved,
// the lamp becomes brighter, and the camera flies.
#pragma once

#include <array>
#include <string_view>

#include "renderer/scene/camera.h"
#include "renderer/scene/scene.h"

namespace lamplighter::test {

class LevelRecording {
 public:
  struct Step {
    std::string_view name;
    int frames = 0;  // of motion; the step ends when the picture has settled after the last one
  };
  static constexpr std::array<Step, 5> kSteps = {
      {{"open", 1}, {"drag a light", 30}, {"move an object", 30}, {"brighter", 1}, {"fly", 30}}};

  // What the recording sets, in the space of the level.
  struct State {
    vec3 lamp{0.0f}, box{0.0f};  // positions [m]
    vec3 radiance{0.0f};         // of the lamp [W/(m² sr)]
    View view;
  };

  // Adds a lamp and a box to the level, in front of the camera and in sizes that suit the distance
  // to what it sees. The light of the lamp suits that of the picture.
  LevelRecording(Scene level, const View& view);

  const Scene& scene() const { return scene_; }
  // After this number of frames of a step, from 1 to its number of frames.
  State after(size_t step, int frame) const;
  NodeId lamp() const { return lamp_; }
  NodeId box() const { return box_; }
  // Brings a scene to a state.
  void apply(const State& state, Scene& scene) const;

 private:
  Scene scene_;
  NodeId lamp_ = kNoNode, box_ = kNoNode;
  float distance_ = 0.0f;  // to what the camera sees [m]
  State first_;
};

}  // namespace lamplighter::test
