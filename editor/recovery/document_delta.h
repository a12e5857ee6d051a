// The difference between two states of a document, stored as the values of the later state. Applied
// to the earlier state it gives the later one, bit for bit.
#pragma once

#include "editor/recovery/value_json.h"

namespace lamplighter {

// Meshes and textures of `base` are stored by index. `whole`: stores everything, so that the delta
// can be applied to any document with the meshes and textures of `base`.
Json deltaBetween(const Scene& base, const Document& from, const Document& to, Blobs& blobs,
                  bool whole = false);
// Applies a delta. Throws InputError or Json's exceptions; `document` is then unchanged.
void applyDelta(const Scene& base, Document& document, const Json& delta, Blobs& blobs);

}  // namespace lamplighter
