// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace slamscope::slam {

/// The files of page/, part of the program (slam/CMakeLists.txt).
[[nodiscard]] std::string_view pageDocument();  ///< with {{slots}} that report_html.cpp fills
[[nodiscard]] std::string_view pageStyle();
[[nodiscard]] std::string_view pageScript();

}  // namespace slamscope::slam
