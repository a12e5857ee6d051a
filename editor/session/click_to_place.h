// Click to place: what Session::startPlacing() has named is added and put on a surface.
#pragma once

namespace lamplighter {

class Session;

// On the surface under the pointer, facing out of it, as one step. Nothing happens where there is
// none. `goesOn`: the next click places another.
void placeUnderPointer(Session& session, bool goesOn);

}  // namespace lamplighter
