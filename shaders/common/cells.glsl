// Cells and samples of the low-resolution pass (shared/low_resolution.h).
#ifndef LAMPLIGHTER_CELLS_GLSL
#define LAMPLIGHTER_CELLS_GLSL

// The pixel of a sample; last: the picture's last one.
ivec2 pixelOfSample(ivec2 at, int block, ivec2 last) {
  return min(block * at, last);
}

// The cell that a pixel takes its light from; `samples` are of the whole picture. Rows and columns
// between two cells are of the later one, the last ones of the last.
ivec2 cellOfPixel(ivec2 pixel, int block, ivec2 samples) {
  return min(ivec2((vec2(pixel) + 0.5) / float(block)), samples - 2);
}

#endif
