// SPDX-License-Identifier: MIT
#include "tests/slam/variants/variants.hpp"

#include <stdexcept>
#include <string>

#include "tests/slam/variants/absolute_and_diffuse.hpp"
#include "tests/slam/variants/information.hpp"
#include "tests/slam/variants/joseph.hpp"
#include "tests/slam/variants/linearisation.hpp"
#include "tests/slam/variants/square_root.hpp"
#include "tests/slam/variants/unscented.hpp"

namespace slamscope::slam::testing {

std::unique_ptr<EkfEquations> makeVariant(std::string_view name, Sensor sensor,
                                          std::shared_ptr<const Compass> compass) {
  if (name == "plain") return std::make_unique<EkfEquations>(sensor);
  if (name == "joseph") return std::make_unique<JosephForm>(sensor);
  if (name == "square-root") return std::make_unique<SquareRootForm>(sensor);
  if (name == "information") return std::make_unique<InformationForm>(sensor);
  if (name == "unscented") return std::make_unique<UnscentedFilter>(sensor);
  if (name == "iterated") return std::make_unique<IteratedFilter>(sensor);
  if (name == "first-estimates") return std::make_unique<FirstEstimatesFilter>(sensor);
  if (name == "frozen") return std::make_unique<FrozenFilter>(sensor);
  if (name == "diffuse") return std::make_unique<DiffuseFilter>(sensor);
  if (name == "compass") return std::make_unique<CompassAidedFilter>(sensor, std::move(compass));
  throw std::invalid_argument("no variant of the name '" + std::string(name) + "'");
}

}  // namespace slamscope::slam::testing
