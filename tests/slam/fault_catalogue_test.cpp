// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "slam/faults.hpp"

// The table in slam/README.md says of every fault what the code says.
namespace slamscope::slam {
namespace {

std::string classInWords(const FaultDescription& fault) {
  if (fault.kind == FaultKind::code) return "code";
  if (!fault.code_where_declared) return "statistics";
  const bool of_motion = fault.name == "noise-unrotated";
  return of_motion ? "statistics; code where Q is declared"
                   : "statistics; code where R is declared";
}

std::string blameInWords(FaultBlame blame) {
  switch (blame) {
    case FaultBlame::chosen_features:
      return "those features";
    case FaultBlame::new_features:
      return "the new feature";
    case FaultBlame::written_block:
      return "the feature whose block is written";
    case FaultBlame::jacobian_entry:
      return "the entry of F";
    default:
      return "–";
  }
}

std::string rowOf(const FaultDescription& fault) {
  std::string row = "| `" + std::string(fault.name) + "` | " + std::string(fault.description);
  row += " | " + classInWords(fault) + " | L" + std::to_string(fault.level) + " | ";
  row += blameInWords(fault.blame) + " | ";
  row += fault.shipped_by.empty() ? "|" : std::string(fault.shipped_by) + " |";
  return row;
}

/// Faults without their row, and rows of the table that belong to no fault.
std::vector<std::string> differences(const std::string& table) {
  std::vector<std::string> rows;
  std::istringstream text(table);
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("| `")) rows.push_back(line);
  }
  std::vector<std::string> wrong;
  for (const FaultDescription& fault : faultNames()) {
    if (fault.kind == FaultKind::none) continue;
    const auto found = std::find(rows.begin(), rows.end(), rowOf(fault));
    if (found == rows.end()) {
      wrong.push_back("missing: " + rowOf(fault));
    } else {
      rows.erase(found);
    }
  }
  for (const std::string& row : rows) wrong.push_back("no such fault: " + row);
  return wrong;
}

std::string readme() {
  std::ifstream file(SLAMSCOPE_SOURCE_DIR "/slam/README.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(FaultCatalogue, TableInTheReadmeSaysWhatTheCodeSays) {
  for (const std::string& difference : differences(readme())) ADD_FAILURE() << difference;
  EXPECT_EQ(faultNames().size(), 25U);  // and the correct filter
}

TEST(FaultCatalogue, MissingRowAChangedOneAndAStrangerAreSeen) {
  const std::string table = readme();
  const auto with = [&table](const std::string& from, const std::string& to) {
    std::string changed = table;
    const auto at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? changed : changed.replace(at, from.size(), to);
  };
  const std::string row = rowOf(faultNamed("wrong-block"));
  EXPECT_EQ(differences(with(row + "\n", "")).size(), 1U);
  EXPECT_EQ(differences(with("| `wrong-block`", "| `wrong-blok`")).size(), 2U);
  EXPECT_EQ(
      differences(with(row, row + "\n| `gremlins` | in the machine | code | L1 | – | |")).size(),
      1U);
}

}  // namespace
}  // namespace slamscope::slam
