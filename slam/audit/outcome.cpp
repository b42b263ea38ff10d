// SPDX-License-Identifier: MIT
#include "slam/audit/outcome.hpp"

namespace slamscope::slam {

void Outcome::show(std::string_view what, double given, double lawful) {
  Evidence& e = evidence.emplace_back();
  e.what = what;
  e.given = given;
  e.lawful = lawful;
}

}  // namespace slamscope::slam
