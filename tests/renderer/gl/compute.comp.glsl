// For compute_gltest.cpp: writes an image from a buffer, and counts what it wrote.
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) readonly buffer Colours { vec4 colours[]; };
layout(std430, binding = 1) buffer Count { uint count; };
layout(rgba32f, binding = 0) writeonly uniform image2D uImage;
layout(r32ui, binding = 1) uniform uimage2D uHits;

void main() {
  ivec2 size = imageSize(uImage), at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, size))) return;
  imageStore(uImage, at, FACTOR * colours[at.y * size.x + at.x]);
  imageAtomicAdd(uHits, ivec2(at.x % 2, 0), 1u);
  atomicAdd(count, 1u);
}
