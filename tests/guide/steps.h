// Steps of a page as a recording of input.
//
//   key CHORD              pressed and let go: Ctrl+Shift+S, F2, Enter
//   hold KEY, release KEY  Shift, Ctrl, Alt
//   type TEXT              into what has the keyboard
//   point WIDGET [X Y]     the pointer goes there: shares of the widget, pixels of "viewport"
//   click WIDGET [X Y]     point, then the left button
//   double WIDGET [X Y]    twice in quick succession
//   right WIDGET [X Y]     the right button
//   drag WIDGET X Y X Y…   the left button held from the first place to the last
//   wheel NOTCHES
//   setup ACTION           runs an action that a reader need not run
//   wait FRAMES
//   away                   the pointer goes where it points at nothing
//   settle                 until the picture is settled
//   picture NAME           of the window, once its picture is settled
#pragma once

#include "editor/input/recording.h"
#include "tests/guide/page.h"

namespace lamplighter::test {

// Throws InputError "PAGE:LINE: …".
Recording recordingOf(const Page& page);
// The names of its pictures, in order.
std::vector<std::string> picturesOf(const Page& page);

}  // namespace lamplighter::test
