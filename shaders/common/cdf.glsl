// Samples a cumulative distribution: `row` of rows with `count` weights each, in the layout of
// kScanShares. The includer defines the buffer as CDF_VALUES. Rounding of the sums can leave an entry
// of weight 0 a share of about 1e-7.
#ifndef LAMPLIGHTER_CDF_GLSL
#define LAMPLIGHTER_CDF_GLSL

// The entry that u in [0, 1) selects. within: the unused part of u, uniform in [0, 1). As Cdf and
// GridCdf (renderer/base/cdf.h).
int sampleCdf(int row, int count, float u, out float within) {
  int first = row * (count + 1);
  int low = 0, high = count - 1;  // the entry is one of low … high
  while (low < high) {
    int middle = (low + high) / 2;
    if (CDF_VALUES[first + middle + 1] > u) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  // Never selects an interval of zero width.
  while (low > 0 && !(CDF_VALUES[first + low + 1] > CDF_VALUES[first + low])) --low;
  while (low + 1 < count && !(CDF_VALUES[first + low + 1] > CDF_VALUES[first + low])) ++low;
  float below = CDF_VALUES[first + low], above = CDF_VALUES[first + low + 1];
  within = clamp((u - below) / (above - below), 0.0, 0.99999994);
  return low;
}

#endif
