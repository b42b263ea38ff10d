// SPDX-License-Identifier: MIT
#include "apps/lib/whole_file.hpp"

#include <fstream>
#include <stdexcept>

namespace slamscope::apps {

void writeWhole(const std::filesystem::path& file, std::string_view text) {
  const bool special = std::filesystem::exists(file) && !std::filesystem::is_regular_file(file);
  const std::filesystem::path written =
      special ? file : std::filesystem::path(file.string() + ".partial");
  std::ofstream out(written, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": can't be written");
  if (!special) std::filesystem::rename(written, file);
}

}  // namespace slamscope::apps
