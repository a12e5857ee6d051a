// Converts the steps of a page to a recording of input.
//
//   key CHORD              press and release: Ctrl+Shift+S, F2, Enter
//   hold KEY, release KEY  Shift, Ctrl, Alt
//   type TEXT              into the widget with the keyboard focus
//   point WIDGET [X Y]     moves the pointer: fractions of the widget, pixels of "viewport"
//   click WIDGET [X Y]     point, then the left button
//   double WIDGET [X Y]    twice in quick succession
//   right WIDGET [X Y]     the right button
//   drag WIDGET X Y X Y…   holds the left button from the first point to the last
//   wheel NOTCHES
//   setup ACTION           runs an action that the text does not mention
//   wait FRAMES
//   away                   moves the pointer away from all widgets
//   settle                 waits until the picture is settled
//   picture NAME           takes a picture of the window when it is settled
#pragma once

#include "editor/input/recording.h"
#include "tests/guide/page.h"

namespace lamplighter::test {

// Throws InputError "PAGE:LINE: …".
Recording recordingOf(const Page& page);
// The names of the pictures of the page, in order.
std::vector<std::string> picturesOf(const Page& page);

}  // namespace lamplighter::test
