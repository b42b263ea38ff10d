// SPDX-License-Identifier: MIT
#include "apps/lib/view/hmd.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/slamscope/monitor_flags.hpp"
#include "apps/slamscope/run_viewer.hpp"
#include "apps/slamscope/verbs.hpp"
#include "engine/window/displays.hpp"

namespace slamscope::apps {
namespace {

struct HmdFlags {
  MonitorFlags shared;
  HmdOptions rest;
  std::string layout = "side-by-side";

  [[nodiscard]] HmdOptions options() const {
    HmdOptions options = rest;
    options.view = shared.options();
    options.layout = eyeLayoutFromName(layout);
    return options;
  }
};

void addEyeFlags(CLI::App& verb, HmdFlags& flags) {
  const std::string group = "Head";
  MonitorOptions& view = flags.shared.rest;
  verb.add_option("--cameras", view.camera,
                  "lab (synthetic); LEFT,RIGHT: two devices, films or folders; one of these: "
                  "frames of both eyes side by side, or a single camera")
      ->group(group);
  verb.add_option("--rig", flags.rest.rig,
                  "cameras, their places on the head and the display's lenses, YAML (slamscope "
                  "calibrate stereo)")
      ->group(group);
  verb.add_option("--tags", view.tags, "tags of the room, YAML (slamscope calibrate tags)")
      ->group(group);
  verb.add_option("--robot", view.robot,
                  "the robot's tag, YAML (id, size_m, T_robot_tag); none: the map starts at the "
                  "origin of --tags")
      ->group(group);
  verb.add_option("--layout", flags.layout, "how the eyes share the picture")
      ->check(CLI::IsMember({"side-by-side", "half-side-by-side", "top-bottom", "anaglyph"}))
      ->group(group);
  verb.add_flag("--swap-eyes", flags.rest.swap_eyes, "the left eye's picture on the right")
      ->group(group);
  verb.add_option("--display", flags.rest.display,
                  "full screen on this monitor, by name or index (slamscope displays)")
      ->group(group);
  verb.add_option("--walk", flags.rest.walk, "what the head in the lab does")
      ->check(CLI::IsMember({"stand", "walk", "turn", "wander"}))
      ->group(group);
  verb.add_option("--latency", flags.rest.latency,
                  "CSV: mid-exposure, dequeue, pose and present of each frame")
      ->group(group);
  addCaptureFlags(verb, flags.shared, group);
}

void runHmd(const HmdOptions& options) {
  std::optional<int> screen;
  if (!options.display.empty()) screen = engine::findDisplay(options.display).index;
  Hmd hmd(options);
  const MonitorOptions& view = options.view;
  runViewer(hmd, {.window = view.window,
                  .title = "slamscope hmd – " + view.camera,
                  .screen = screen,
                  .files = {view.output, view.picture, view.report, options.latency}});
}

}  // namespace

void addHmd(CLI::App& program) {
  const auto flags = std::make_shared<HmdFlags>();
  CLI::App* verb = program.add_subcommand(
      "hmd", "the view of a head-mounted display: two eyes, the head tracked by tags in the room");
  verb->footer(
      "Examples:\n"
      "  slamscope hmd                                            a window: a walk around the "
      "lab's robot\n"
      "  slamscope hmd --layout anaglyph --output walk.mp4        the same for red-cyan glasses\n"
      "  slamscope hmd --cameras /dev/video0,/dev/video2 --rig rig.yaml --tags room.yaml \\\n"
      "                --robot robot.yaml --slam tcp://127.0.0.1:7007 --display HDMI-1");
  addEyeFlags(*verb, *flags);
  addViewFlags(*verb, flags->shared);
  verb->callback([flags] {
    HmdOptions options = flags->options();
    const MonitorOptions& view = options.view;
    const bool to_files = !view.output.empty() || !view.picture.empty() || !view.report.empty();
    options.view.window = view.window || !to_files || !options.display.empty();
    runHmd(options);
  });
}

}  // namespace slamscope::apps
