// The memory limit of the undo history, as a parameter.
#pragma once

#include "editor/edits/history.h"
#include "renderer/base/parameters.h"

namespace lamplighter {

const ParameterSpec& undoMemory();  // MiB
inline constexpr size_t kMebibyte = size_t{1} << 20;

}  // namespace lamplighter
