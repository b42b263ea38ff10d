// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <vector>

#include "apps/lib/audit_watch.hpp"
#include "apps/lib/view/legend.hpp"

namespace slamscope::apps {

/// What the audit says, for its panel: a broken law a line (which one, by which features, since
/// when) and under it the amount. `shown`: time of the snapshot in the picture, to say how far the
/// audit is behind. Of a filter that breaks nothing a line only where `also_whole`.
[[nodiscard]] std::vector<AlarmLine> alarmLines(const Judgement& judgement,
                                                std::chrono::nanoseconds shown, bool also_whole);

}  // namespace slamscope::apps
