// Cells and samples of the low-resolution pass (shared/low_resolution.h).
#ifndef LAMPLIGHTER_CELLS_GLSL
#define LAMPLIGHTER_CELLS_GLSL

// The pixel of a sample; last: the last pixel of the picture.
ivec2 pixelOfSample(ivec2 at, int block, ivec2 last) {
  return min(block * at, last);
}

// The cell from which a pixel is interpolated; `samples`: number of samples of the whole picture.
// Pixels on the border between two cells belong to the later one; the last row and column belong to
// the last cell.
ivec2 cellOfPixel(ivec2 pixel, int block, ivec2 samples) {
  return min(ivec2((vec2(pixel) + 0.5) / float(block)), samples - 2);
}

#endif
