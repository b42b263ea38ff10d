// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace slamscope::engine {

/// The bytes of DejaVuSans.ttf, part of the program.
[[nodiscard]] std::span<const std::uint8_t> fontBytes();

}  // namespace slamscope::engine
