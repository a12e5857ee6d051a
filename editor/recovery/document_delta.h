// What differs between two states of a document, as the values that it has afterwards; and from
// the earlier state and that to the later one, to the last bit.
#pragma once

#include "editor/recovery/value_json.h"

namespace lamplighter {

// Meshes and textures that `base` has are named by their place in it. `whole`: everything, so that
// it can be put on any document with the meshes and textures of `base`.
Json deltaBetween(const Scene& base, const Document& from, const Document& to, Blobs& blobs,
                  bool whole = false);
// Nothing but that. Throws InputError or Json's exceptions, with `document` untouched.
void applyDelta(const Scene& base, Document& document, const Json& delta, Blobs& blobs);

}  // namespace lamplighter
