// SPDX-License-Identifier: MIT
#include "apps/lib/drawable_run.hpp"

#include <stdexcept>

namespace slamscope::apps {

slam::RunReader openDrawable(const std::string& path) {
  slam::RunReader reader(path);
  if (reader.header().means_known) return reader;
  throw std::runtime_error(path +
                           ": covariances without means (level LC), so there is nothing to draw; "
                           "slamscope audit judges such runs");
}

}  // namespace slamscope::apps
