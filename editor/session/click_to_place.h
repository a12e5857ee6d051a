// Click to place: adds the object that was passed to Session::startPlacing(), on a surface.
#pragma once

namespace lamplighter {

class Session;

// Places it on the surface under the pointer, facing away from it, as one step. Does nothing if
// there is no surface. `goesOn`: the next click places another one.
void placeUnderPointer(Session& session, bool goesOn);

}  // namespace lamplighter
