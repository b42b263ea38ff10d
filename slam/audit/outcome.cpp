// SPDX-License-Identifier: MIT
#include "slam/audit/outcome.hpp"

namespace slamscope::slam {

void Outcome::show(std::string_view what, double given, double lawful, LawfulIs lawful_is) {
  Evidence& e = evidence.emplace_back();
  e.what = what;
  e.given = given;
  e.lawful = lawful;
  e.lawful_is = lawful_is;
}

}  // namespace slamscope::slam
