// A change of a document as JSON: the values of the later state. Applied to the earlier state it
// gives the later one, bit for bit.
#pragma once

#include "editor/edits/document_change.h"
#include "editor/recovery/value_json.h"

namespace lamplighter {

// Meshes and textures of `base` are stored by index. `after`: the document after the change.
Json deltaOf(const Scene& base, const DocumentChange& change, const Document& after, Blobs& blobs);
// Everything: can be applied to any document with the meshes and textures of `base`.
Json wholeDocument(const Scene& base, const Document& document, Blobs& blobs);
// Applies a delta. Throws InputError or Json's exceptions; `document` is then unchanged.
void applyDelta(const Scene& base, Document& document, const Json& delta, Blobs& blobs);

}  // namespace lamplighter
