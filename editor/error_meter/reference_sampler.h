// The path tracer beside the live picture: it adds paths step by step to two independent pictures
// of the same subject, from which the live picture's error and the noise of both are told apart.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/methods/path_tracer/path_tracer.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// What the reference is of. Another number is another subject, and the paths begin again.
struct MeterSubject {
  uint64_t number = 0;
  uint64_t level = 0;  // another one: nothing of the scene before is in this one
  std::shared_ptr<const Scene> scene;
  View view;  // the live picture's
  PathTracerOptions paths;
  int block = 4;  // pixels a side of the blocks that are compared
};

// Two estimates of the same picture that share no random number, each the mean of `samples` paths
// in every block of pixels.
struct ReferenceHalves {
  uint64_t subject = 0;  // its number
  int block = 1;
  int samples = 0;
  Image first, second;  // radiance [W/(m² sr)], a pixel each block
  // Whether a block counts: none does in which a lamp itself is seen. Lamps are as bright as they
  // are in every method, but so much brighter than what they light that their outlines, of which
  // the reference has no more than noise, would drown all else. Empty: all count.
  std::vector<uint8_t> counts;

  Image mean() const;
};

// The picture averaged over blocks of pixels; rows and columns that fill no block are left out. A
// picture that is smaller than a block is one block.
Image averageBlocks(const Image& picture, int block);

class ReferenceSampler {
 public:
  void begin(const MeterSubject& subject);
  // One path more in each block of both halves. False: `stop` said so, and the paths of this step
  // are lost; the next begin() is all that helps. The same bits at any number of threads.
  bool step(const std::function<bool()>& stop = {});
  ReferenceHalves halves() const;

 private:
  MeterSubject subject_;
  Scene scene_;  // that world_ shows
  RenderScene world_;
  std::unique_ptr<RayCaster> rays_;
  LightSet lights_;
  void leaveOutLamps();

  int samples_ = 0;
  int block_ = 1;
  std::vector<uint8_t> counts_;
  Image first_, second_;  // sums
};

}  // namespace lamplighter
