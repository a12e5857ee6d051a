// Headers that most tests include and that rarely change, precompiled (cmake/quick_build.cmake).
// Every source still includes what it uses, because only the release preset precompiles.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/scene/camera.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/render_scene.h"
