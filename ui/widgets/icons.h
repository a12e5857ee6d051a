// Code points of Fork Awesome, in UTF-8.
#pragma once

namespace lamplighter::icon {

inline constexpr unsigned short kFirst = 0xf000, kLast = 0xf2ff;
inline constexpr unsigned short kProbe = 0xf245;  // its presence shows that the icon font is loaded

inline constexpr const char* kSelect = "\uf245";     // mouse-pointer
inline constexpr const char* kMove = "\uf047";       // arrows
inline constexpr const char* kRotate = "\uf021";     // refresh
inline constexpr const char* kScale = "\uf065";      // expand
inline constexpr const char* kRectangle = "\uf096";  // square-o
inline constexpr const char* kDisk = "\uf10c";       // circle-o
inline constexpr const char* kSphere = "\uf111";     // circle
inline constexpr const char* kTube = "\uf068";       // minus
inline constexpr const char* kSpot = "\uf0b0";       // filter, a cone
inline constexpr const char* kPoint = "\uf192";      // dot-circle-o
inline constexpr const char* kLock = "\uf023";
inline constexpr const char* kUnlock = "\uf09c";  // unlock-alt, open
inline constexpr const char* kUndo = "\uf0e2";
inline constexpr const char* kRedo = "\uf01e";
inline constexpr const char* kFrame = "\uf05b";  // crosshairs
inline constexpr const char* kLight = "\uf0eb";  // lightbulb-o
inline constexpr const char* kSun = "\uf185";
inline constexpr const char* kMesh = "\uf1b2";    // cube
inline constexpr const char* kGroup = "\uf114";   // folder-o
inline constexpr const char* kCamera = "\uf03d";  // video-camera
inline constexpr const char* kEye = "\uf06e";
inline constexpr const char* kEyeSlash = "\uf070";
inline constexpr const char* kSearch = "\uf002";
inline constexpr const char* kFolder = "\uf07b";
inline constexpr const char* kFile = "\uf016";        // file-o
inline constexpr const char* kWarning = "\uf071";     // exclamation-triangle
inline constexpr const char* kExplain = "\uf059";     // question-circle
inline constexpr const char* kMeasure = "\uf07d";     // arrows-v
inline constexpr const char* kProbeLight = "\uf1fb";  // eyedropper
inline constexpr const char* kHistogram = "\uf080";   // bar-chart
inline constexpr const char* kClose = "\uf00d";
inline constexpr const char* kSettled = "\uf058";   // check-circle
inline constexpr const char* kUpdating = "\uf252";  // hourglass-half

}  // namespace lamplighter::icon
