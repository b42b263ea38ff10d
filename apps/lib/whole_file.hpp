// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace slamscope::apps {

/// Writes the text beside the file first, so that nothing half-written bears its name; straight
/// into what is no regular file (/dev/stdout, a pipe). Throws std::runtime_error where it can't be
/// written.
void writeWhole(const std::filesystem::path& file, std::string_view text);

}  // namespace slamscope::apps
