// The interface of a backend (docs/design/architecture.md): what all methods need on one device. It
// rasterises the G-buffer, composes pictures, and owns the kernels that a method adds. It has two
// implementations (cpu/, gl/). The caller decides what to compute and does not know which backend
// runs.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <typeindex>
#include <vector>

#include "renderer/backends/image_pool.h"
#include "renderer/backends/method_kernels.h"
#include "renderer/backends/radiance_image.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

class GBufferView;

// The device of a backend has no memory left, or the driver has reset it.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct BackendInfo {
  std::string name;    // "cpu" or "gl"
  std::string device;  // GL renderer string, or the instruction set
};

class Backend {
 public:
  Backend() = default;
  virtual ~Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;

  virtual const BackendInfo& info() const = 0;
  BackendCounts counts() const;  // of the backend and of all its kernels
  // Waits until all submitted work is done, for time measurements.
  virtual void finish() = 0;
  // Throws DeviceError if the device failed since the last call. Call it once per frame.
  virtual void checkDevice() {}
  // Discards all kernels and their memory, for example after an exception. The next setScene() must
  // be one in which everything is rebuilt.
  void reset();

  // Applies the changes of the scene. `rays` is already up to date. Both are used until the next
  // call.
  void setScene(const RenderScene& scene, const RenderSceneChanges& changes, const RayCaster& rays);

  // --- Raster ---

  // Renders the primary visibility of the view into the G-buffer; `jitter` is the position of the
  // sample in the pixel, in pixels from its middle.
  void renderGBuffer(const View& view, vec2 jitter);
  // The G-buffer in main memory. Valid until the next setScene() or renderGBuffer(). The cpu
  // backend shows its own. The gl backend traces the same pixels on the CPU at the first call
  // instead of reading textures back; kernels read the textures (gl::GlGBuffer).
  virtual GBufferView hostGBuffer() = 0;
  // The world-space shading normals and the albedo of the G-buffer, for tests and debug views.
  virtual Image readNormals() = 0;
  virtual Image readAlbedo() = 0;

  // --- Compose ---

  // Le + ρ/π · E, and the sky where nothing was hit, for the G-buffer. `irradiance`: E ≥ 0 [W/m²]
  // of each pixel. `white`: with ρ = 1, which shows only the light.
  virtual std::shared_ptr<RadianceImage> compose(const Image& irradiance, bool white) = 0;

  // The picture with each pixel multiplied by that of `gains`, an image of its size that does not
  // change. It is not read back.
  virtual std::shared_ptr<RadianceImage> multiplied(const std::shared_ptr<RadianceImage>& picture,
                                                    const std::shared_ptr<const Image>& gains);
  // Each pixel of the picture minus that of `taken`. It is not read back.
  virtual std::shared_ptr<RadianceImage> difference(const std::shared_ptr<RadianceImage>& picture,
                                                    const std::shared_ptr<RadianceImage>& taken);

  // --- Times of stages, without waiting for the device ---

  // The device's work from here to the first endStage(), and from each of these to the next,
  // belongs to that stage of the frame.
  virtual void beginStages() {}
  virtual void endStage(size_t /*stage*/) {}
  // Seconds of that work in the newest frame for which they are known; 0: no such work, or the
  // processor does it.
  virtual double stageSeconds(size_t /*stage*/) const { return 0.0; }

  // --- Kernels of methods ---

  // The kernels with this interface, created at the first call with the current scene and G-buffer.
  // Throws InputError if the backend has none; `method` is the name for the message.
  template <typename Interface>
  Interface& kernels(const std::string& method) {
    return static_cast<Interface&>(make(typeid(Interface), method));
  }
  template <typename Interface>
  bool offers() const {
    return std::ranges::find(offers_, std::type_index(typeid(Interface)), &Offer::interface) !=
           offers_.end();
  }
  // Null if the backend has none or they were not requested yet.
  template <typename Interface>
  Interface* kernelsInUse() {
    return static_cast<Interface*>(inUse(typeid(Interface)));
  }
  // Adds kernels: `make` is called when a method requests them. Replaces an earlier offer of the
  // same interface.
  template <typename Interface>
  void offer(std::function<std::unique_ptr<Interface>()> make) {
    offer(typeid(Interface), std::move(make));
  }

 protected:
  virtual BackendCounts ownCounts() const = 0;
  virtual void takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                         const RayCaster& rays) = 0;
  virtual void drawGBuffer(const View& view, vec2 jitter) = 0;

  void forEachKernels(const std::function<void(MethodKernels&)>& f);
  // For destructors: kernels may need the backend that they belong to.
  void dropKernels() { offers_.clear(); }

 private:
  struct Offer {
    std::type_index interface;
    std::function<std::unique_ptr<MethodKernels>()> make;
    std::unique_ptr<MethodKernels> kernels;  // null until a method requests them
  };
  void offer(std::type_index interface, std::function<std::unique_ptr<MethodKernels>()> make);
  MethodKernels& make(std::type_index interface, const std::string& method);
  MethodKernels* inUse(std::type_index interface);

  std::vector<Offer> offers_;
  ImagePool pictures_;                  // of multiplied() and difference()
  const RenderScene* scene_ = nullptr;  // of the last setScene()
  const RayCaster* rays_ = nullptr;
  bool hasGBuffer_ = false;
};

}  // namespace lamplighter
