// Prints the hits of rays in a scene, one per line, for same_on_other_cpu.sh: random rays, and rays
// at the midpoints of edges and at corners, where several triangles have the same distance.
//
// The same rays in packets of eight, of which only the distance is asked, as shadow maps do.
//
//   lamplighter_ray_hits SCENE RAYS > hits   lines "a|e|c OBJECT TRIANGLE t u v" and "d t", bits as
//   hex
#include <array>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>
#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {
namespace {

void print(char kind, const Hit& hit) {
  if (!hit) {
    std::printf("%c none\n", kind);
    return;
  }
  std::printf("%c %u %u %08x %08x %08x\n", kind, hit.object, hit.triangle,
              std::bit_cast<uint32_t>(hit.t), std::bit_cast<uint32_t>(hit.u),
              std::bit_cast<uint32_t>(hit.v));
}

// A random number in [0, 1), equal with every standard library.
float share(std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24f; }

void castRays(const Scene& scene, uint32_t count) {
  RenderScene world;
  update(world, scene, SceneChanges::all());
  const RayCaster rays(world);
  std::mt19937 random(1);
  const auto inside = [&] {
    return world.bounds.min +
           world.bounds.extent() * vec3(share(random), share(random), share(random));
  };
  std::vector<Ray> packet;
  for (uint32_t i = 0; i < count; ++i) {
    const vec3 origin = inside();
    vec3 target = inside();
    const char kind = "aec"[i % 3];
    if (kind != 'a') {
      const uint32_t* corner = &world.indices[random() % world.triangleCount() * 3];
      const vec3 a = world.positions[corner[0]], b = world.positions[corner[1]];
      target = kind == 'e' ? 0.5f * (a + b) : a;
    }
    packet.push_back({origin, 0.0f, target - origin});
    print(kind, rays.intersect(packet.back()));
    if (packet.size() < 8) continue;
    std::array<float, 8> distances;
    rays.distance8(std::span<const Ray, 8>(packet), distances);
    for (const float t : distances) std::printf("d %08x\n", std::bit_cast<uint32_t>(t));
    packet.clear();
  }
}

}  // namespace
}  // namespace lamplighter

int main(int count, char** arguments) try {
  if (count != 3) {
    std::fprintf(stderr, "usage: lamplighter_ray_hits SCENE RAYS\n");
    return 2;
  }
  lamplighter::castRays(lamplighter::loadGltf(arguments[1]).scene,
                        static_cast<uint32_t>(std::strtoul(arguments[2], nullptr, 10)));
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "error: %s\n", e.what());
  return 2;
}
