// SPDX-License-Identifier: MIT
#include "slam/eigen_templates.hpp"

SLAMSCOPE_EIGEN_TEMPLATES();
SLAMSCOPE_EIGEN_KERNELS();
