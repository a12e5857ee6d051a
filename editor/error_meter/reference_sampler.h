// The path tracer that runs beside the live picture. Step by step it adds paths to two independent
// pictures of the same subject. Their difference gives the noise, which is separated from the error
// of the live picture.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "renderer/frame/world.h"
#include "renderer/image/image.h"
#include "renderer/methods/path_tracer/path_tracer.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// What the reference shows. A new number means a new subject, and sampling restarts.
struct MeterSubject {
  uint64_t number = 0;
  uint64_t level = 0;  // a new number means that nothing of the previous scene remains
  std::shared_ptr<const Scene> scene;
  View view;  // the view of the live picture
  PathTracerOptions paths;
  int block = 4;  // side of the compared blocks [pixels]
};

// Two estimates of the same picture that share no random numbers. Each is the mean of `samples`
// paths in every block of pixels.
struct ReferenceHalves {
  uint64_t subject = 0;  // number of the subject
  int block = 1;
  int samples = 0;
  Image first, second;  // radiance [W/(m² sr)], one pixel per block
  // Whether a block is compared. Blocks that show a lamp directly are not. Every method shows lamps
  // with the same brightness, but lamps are much brighter than the surfaces they light. The
  // reference has only noisy values for their outlines, and this noise would hide all other errors.
  // Empty: all blocks are compared.
  std::vector<uint8_t> counts;

  Image mean() const;
};

class ReferenceSampler {
 public:
  void begin(const MeterSubject& subject);
  // Adds one path to each block of both halves. Returns false if `stop` asked to stop; the paths of
  // this step are then lost and only begin() can continue. Deterministic for any number of threads.
  bool step(const std::function<bool()>& stop = {});
  ReferenceHalves halves() const;

 private:
  MeterSubject subject_;  // its view in the unit of world_
  Scene scene_;           // the scene of world_
  World world_;
  LightSet lights_;
  void leaveOutLamps();

  int samples_ = 0;
  int block_ = 1;
  std::vector<uint8_t> counts_;
  Image first_, second_;  // sums
};

}  // namespace lamplighter
