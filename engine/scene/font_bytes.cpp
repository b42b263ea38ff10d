// SPDX-License-Identifier: MIT
#include "engine/scene/font_bytes.hpp"

// The assembler copies the font in when the program is built (SLAMSCOPE_FONT is found by CMake):
// the program then runs where no font is installed.
asm(".section .rodata\n"
    ".balign 16\n"
    ".global slamscope_font_begin\n"
    ".global slamscope_font_end\n"
    "slamscope_font_begin:\n"
    ".incbin \"" SLAMSCOPE_FONT
    "\"\n"
    "slamscope_font_end:\n"
    ".byte 0\n"
    ".previous\n");

extern "C" {
extern const std::uint8_t slamscope_font_begin[];  // NOLINT(readability-identifier-naming)
extern const std::uint8_t slamscope_font_end[];    // NOLINT(readability-identifier-naming)
}

namespace slamscope::engine {

std::span<const std::uint8_t> fontBytes() {
  return {slamscope_font_begin, slamscope_font_end};
}

}  // namespace slamscope::engine
