// Headers that most sources include and that never change, compiled once (cmake/quick_build.cmake).
// Every source still includes what it uses: only the preset release precompiles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <tbb/parallel_for.h>

#include "renderer/base/math.h"
