// SPDX-License-Identifier: MIT
#include "apps/slamscope/verbs.hpp"

namespace slamscope::apps {

std::vector<AddVerb> verbs() {
  return {
#ifdef SLAMSCOPE_VIEW
      addDemo,      addMonitor, addHmd,
#endif
      addSimulate,  addSlam,    addAudit,    addInfo, addConvert,
#ifdef SLAMSCOPE_VIEW
      addCalibrate, addDevices, addDisplays,
#endif
  };
}

}  // namespace slamscope::apps
