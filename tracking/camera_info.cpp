// SPDX-License-Identifier: MIT
#include "tracking/camera_info.hpp"
