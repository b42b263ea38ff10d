// SPDX-License-Identifier: MIT
#pragma once

// The one place that includes Vulkan: 5 s and 370 MB a file, so it is the engine's precompiled
// header and no header that apps see includes it. The loader is opened at run time; a machine
// without one gets a clear message instead of a program that does not start.
// VULKAN_HPP_NO_STRUCT_CONSTRUCTORS (designated initialisers) is defined for the whole target.
#include <vulkan/vulkan_raii.hpp>
