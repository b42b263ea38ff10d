// SPDX-License-Identifier: MIT
#include "engine/window/displays.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/slamscope/verbs.hpp"

namespace slamscope::apps {

void addDisplays(CLI::App& program) {
  CLI::App* verb = program.add_subcommand("displays", "monitors that a window can fill");
  verb->footer("Example: slamscope displays\nThen: slamscope hmd --display 1");
  verb->callback([] {
    for (const engine::Display& display : engine::listDisplays()) {
      std::printf("%d  %s  %d x %d, %d Hz, at %d,%d%s\n", display.index, display.name.c_str(),
                  display.width, display.height, display.refresh_hz, display.x, display.y,
                  display.index == 0 ? "  (main)" : "");
    }
  });
}

}  // namespace slamscope::apps
