// Actions of the sky: its kind, its picture, and the picture's rotation and brightness.
#include <cmath>

#include "editor/actions/arguments.h"
#include "editor/document/sky_text.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

std::filesystem::path folderOf(const Session& s) { return s.document().path.parent_path(); }

// The sky if it is a picture. Otherwise throws InputError.
Sky pictureOf(const Session& s, const char* action) {
  const Sky& sky = s.document().scene.sky;
  if (sky.kind != SkyKind::image)
    throw InputError(action, "the sky is not a picture", "choose one with sky.image FILE");
  return sky;
}

bool isPicture(const Session& s) { return s.document().scene.sky.kind == SkyKind::image; }

}  // namespace

void addSkyActions(ActionRegistry& r) {
  r.add({"sky.set", "Set sky", kSkyUsage,
         "Sets the sky: none, a radiance in W/(m² sr), a gradient or a picture.", "",
         [](Session& s, const Arguments& a) { s.setSky(parseSky(a[0], folderOf(s))); }});
  r.add({"sky.image", "Sky picture", "FILE",
         "Sets an equirectangular picture as the sky. It keeps the rotation and brightness of the "
         "previous picture.",
         "",
         [](Session& s, const Arguments& a) {
           const Sky& before = s.document().scene.sky;
           s.setSky(Sky::picture(findSkyImage(a[0], folderOf(s)), before.rotation, before.scale));
         }})
      .asks = {.title = "Open a picture of the sky", .extensions = kSkyExtensions};
  r.add({"sky.rotate", "Turn sky", "DEGREES",
         "Rotates the sky's picture about the vertical axis, counter-clockwise seen from above.",
         "",
         [](Session& s, const Arguments& a) {
           Sky sky = pictureOf(s, "sky.rotate");
           sky.rotation = glm::radians(std::fmod(numberOf(a[0]), 360.0f));
           s.setSky(sky);
         },
         isPicture});
  r.add({"sky.scale", "Scale sky", "FACTOR",
         "Sets the factor for the radiance of the sky's picture.", "",
         [](Session& s, const Arguments& a) {
           Sky sky = pictureOf(s, "sky.scale");
           sky.scale = numberOf(a[0]);
           if (!(sky.scale >= 0.0f && sky.scale <= 1e9f))
             throw InputError("sky.scale", "a factor must be from 0 to 1e9", "give one such as 1");
           s.setSky(sky);
         },
         isPicture});
}

}  // namespace lamplighter
