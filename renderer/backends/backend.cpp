#include "renderer/backends/backend.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/base/error.h"

namespace lamplighter {

BackendCounts Backend::counts() const {
  BackendCounts sum = ownCounts();
  for (const Offer& offer : offers_) {
    if (!offer.kernels) continue;
    const BackendCounts counts = offer.kernels->counts();
    sum.rays += counts.rays;
    sum.memoryBytes += counts.memoryBytes;
    sum.waits += counts.waits;
  }
  return sum;
}

void Backend::reset() {
  for (Offer& offer : offers_) offer.kernels.reset();
  scene_ = nullptr;
  rays_ = nullptr;
  hasGBuffer_ = false;
}

void Backend::setScene(const RenderScene& scene, const RenderSceneChanges& changes,
                       const RayCaster& rays) {
  scene_ = &scene;
  rays_ = &rays;
  takeScene(scene, changes, rays);
  forEachKernels([&](MethodKernels& kernels) { kernels.takeScene(scene, changes, rays); });
}

void Backend::renderGBuffer(const View& view, vec2 jitter) {
  drawGBuffer(view, jitter);
  hasGBuffer_ = true;
  forEachKernels([](MethodKernels& kernels) { kernels.takeGBuffer(); });
}

std::shared_ptr<RadianceImage> Backend::multiplied(const std::shared_ptr<RadianceImage>& picture,
                                                   const std::shared_ptr<const Image>& gains) {
  const Image& from = picture->pixels();
  const auto result = pictures_.take(from.width, from.height);
  tbb::parallel_for(0, from.height, [&](int y) {
    for (int x = 0; x < from.width; ++x) result->image.at(x, y) = from.at(x, y) * gains->at(x, y);
  });
  return result;
}

std::shared_ptr<RadianceImage> Backend::difference(const std::shared_ptr<RadianceImage>& picture,
                                                   const std::shared_ptr<RadianceImage>& taken) {
  const Image &from = picture->pixels(), &less = taken->pixels();
  const auto result = pictures_.take(from.width, from.height);
  tbb::parallel_for(0, from.height, [&](int y) {
    for (int x = 0; x < from.width; ++x) result->image.at(x, y) = from.at(x, y) - less.at(x, y);
  });
  return result;
}

void Backend::forEachKernels(const std::function<void(MethodKernels&)>& f) {
  for (const Offer& offer : offers_)
    if (offer.kernels) f(*offer.kernels);
}

void Backend::offer(std::type_index interface,
                    std::function<std::unique_ptr<MethodKernels>()> make) {
  std::erase_if(offers_, [&](const Offer& offer) { return offer.interface == interface; });
  offers_.push_back({interface, std::move(make), nullptr});
}

MethodKernels& Backend::make(std::type_index interface, const std::string& method) {
  const auto offer = std::ranges::find(offers_, interface, &Offer::interface);
  if (offer == offers_.end())
    throw InputError("method", method + " does not run on the backend " + info().name,
                     "choose another method or another --backend");
  if (!offer->kernels) {
    offer->kernels = offer->make();
    if (scene_ != nullptr) {
      RenderSceneChanges all;
      all.rebuilt = true;
      offer->kernels->takeScene(*scene_, all, *rays_);
    }
    if (hasGBuffer_) offer->kernels->takeGBuffer();
  }
  return *offer->kernels;
}

MethodKernels* Backend::inUse(std::type_index interface) {
  const auto offer = std::ranges::find(offers_, interface, &Offer::interface);
  return offer == offers_.end() ? nullptr : offer->kernels.get();
}

}  // namespace lamplighter
