// Pictures of light on surfaces at rest, which are found in bands of rows over several frames.
#include "renderer/surface_light/pixels/resting_picture.h"

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/methods/pixel_jitter.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr int kSamples = 2;

// A room with a glossy floor, its light, and pictures of it.
struct GlossyRoom {
  Scene edited;
  RenderScene scene;
  std::unique_ptr<RayCaster> rays;
  SurfaceLight light;
  ViewRecords records;
  std::unique_ptr<Backend> backend = makeCpuBackend();
  View view = test::lookAt(vec3(0, 0.5f, 2.2f), vec3(0, -1.0f, -1.0f), 60, 45, 0.9f);

  explicit GlossyRoom(float brightness) {
    const int wall = test::addMaterial(edited, vec3(0.6f, 0.5f, 0.4f));
    const int gloss = test::addMaterial(edited, vec3(0.8f), 0.5f, 0.25f);
    test::addMesh(edited, test::roomMesh(vec3(4, 3, 5), wall));
    test::addMesh(edited, test::boxMesh(vec3(3.0f, 0.2f, 3.0f), gloss), vec3(0, -1.3f, 0));
    test::addRectangleLight(edited, vec3(0.3f, 1.4f, 0), vec2(0.8f, 0.5f), vec3(brightness));
    scene = test::renderSceneOf(edited);
    rays = std::make_unique<RayCaster>(scene);
    light.update(scene, test::everythingRebuilt(), *rays, options(), SurfaceLight::kAllRays);
    backend->setScene(scene, test::everythingRebuilt(), *rays);
  }
  static SurfaceLightOptions options() { return {3, 0.4f, 64}; }
  void brighten(float factor) {
    const Scene before = edited;
    for (Node& n : edited.nodes)
      if (n.area) n.area->radiance *= factor;
    const RenderSceneChanges changes = update(scene, edited, compare(before, edited));
    rays->update(changes);
    light.update(scene, changes, *rays, options(), SurfaceLight::kAllRays);
  }
  GatherScene gathered() const { return {scene, *rays, light.mesh(), light.cuts()}; }

  void find(RestingPicture& picture, int rows) {
    picture.restart(view, kSamples, 0);
    for (int frames = 0; !picture.isComplete(); ++frames) {
      ASSERT_LT(frames, kSamples * view.height);
      backend->renderGBuffer(view, pixelJitter(picture.sample(), kSamples));
      picture.add(gathered(), light, records, backend->hostGBuffer(), {}, rows);
    }
  }
  Image shown(RestingPicture& picture) const {
    Image out(view.width, view.height);
    picture.addTo(gathered(), light, records, out);
    return out;
  }
};

TEST(RestingPicture, IsTheSameInBandsOfAnyHeight) {
  GlossyRoom room(9.0f);
  RestingPicture whole, bands;
  room.find(whole, room.view.height);
  room.find(bands, 7);
  const Image picture = room.shown(whole);
  EXPECT_TRUE(test::sameBits(room.shown(bands), picture));
  EXPECT_TRUE(test::sameBits(room.shown(whole), picture)) << "shown again";
}

// A call adds rows of one sample only: the next one needs another G-buffer.
TEST(RestingPicture, EndsASampleWithItsLastRow) {
  GlossyRoom room(9.0f);
  RestingPicture picture;
  EXPECT_FALSE(picture.isComplete());
  picture.restart(room.view, kSamples, 0);
  for (const int sample : {0, 1, 1, 2}) {
    room.backend->renderGBuffer(room.view, pixelJitter(picture.sample(), kSamples));
    picture.add(room.gathered(), room.light, room.records, room.backend->hostGBuffer(), {}, 40);
    EXPECT_EQ(picture.sample(), sample);
    EXPECT_EQ(picture.isComplete(), sample == kSamples);
  }
}

// What lobes reflect is kept until it is said that the light is another.
TEST(RestingPicture, ShowsOtherLight) {
  GlossyRoom room(9.0f), bright(36.0f);
  RestingPicture edited, fresh;
  room.find(edited, room.view.height);
  const Image before = room.shown(edited);
  room.brighten(4.0f);
  edited.outdateLight();
  bright.find(fresh, room.view.height);
  const Image expected = bright.shown(fresh);
  EXPECT_FALSE(test::sameBits(before, expected));
  EXPECT_TRUE(test::sameBits(room.shown(edited), expected));
}

}  // namespace
}  // namespace lamplighter
