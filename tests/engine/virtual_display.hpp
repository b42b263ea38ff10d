// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/view.hpp"

// Last: X11 defines macros named None, Bool, Success …
#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace slamscope::engine {

/// A display in memory (Xvfb) of 800 × 600, and the other side of it: what a person and
/// a window manager do to a window, and what is seen on the screen.
class VirtualDisplay {
 public:
  /// One for all tests of a process: GLFW never leaves its first display. Started before GLFW, so
  /// it ends after it.
  [[nodiscard]] static VirtualDisplay& ofThisProcess() {
    static VirtualDisplay display;
    return display;
  }

  VirtualDisplay() {
    int ends[2];
    if (pipe(ends) != 0) return;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // (dup2 of a descriptor onto itself would leave it closed on exec.)
    posix_spawn_file_actions_adddup2(&actions, ends[1], 9);
    const char* arguments[] = {"Xvfb",       "-displayfd", "9",   "-screen",    "0",
                               "800x600x24", "-nolisten",  "tcp", "-terminate", nullptr};
    if (posix_spawnp(&server_, "Xvfb", &actions, nullptr, const_cast<char**>(arguments), environ) !=
        0) {
      server_ = 0;
    }
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    std::string number;
    for (char c = 0; server_ != 0 && read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
    close(ends[0]);
    if (number.empty()) return;
    name_ = ":" + number;
    // With this connection open the server stays; it ends by itself when the test dies.
    display_ = XOpenDisplay(name_.c_str());
  }

  ~VirtualDisplay() {
    if (display_ != nullptr) XCloseDisplay(display_);
    if (server_ != 0) {
      kill(server_, SIGTERM);
      waitpid(server_, nullptr, 0);
    }
  }
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// False where Xvfb is not installed.
  [[nodiscard]] bool running() const { return display_ != nullptr; }

  /// Makes it $DISPLAY.
  void use() const {
    setenv("DISPLAY", name_.c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
  }

  /// What the window shows; none while it has another size, or is not on the screen.
  [[nodiscard]] std::optional<Image> screenshot(const std::string& title) const {
    const ::Window window = find(title);
    XWindowAttributes attributes;
    if (window == 0 || XGetWindowAttributes(display_, window, &attributes) == 0)
      return std::nullopt;
    if (attributes.map_state != IsViewable) return std::nullopt;
    XImage* seen = XGetImage(display_, window, 0, 0, static_cast<unsigned>(attributes.width),
                             static_cast<unsigned>(attributes.height), AllPlanes, ZPixmap);
    if (seen == nullptr) return std::nullopt;
    Image image{attributes.width, attributes.height, {}};
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const unsigned long pixel = XGetPixel(seen, x, y);
        for (const int shift : {16, 8, 0}) {
          image.rgba.push_back(static_cast<std::uint8_t>(pixel >> shift));
        }
        image.rgba.push_back(255);
      }
    }
    XDestroyImage(seen);
    return image;
  }

  void resize(const std::string& title, unsigned width, unsigned height) const {
    XResizeWindow(display_, find(title), width, height);
    XSync(display_, False);
  }

  /// As a window manager does it: the state is written at the window, then it is taken away.
  void setMinimised(const std::string& title, bool minimised) {
    const ::Window window = minimised ? find(title) : minimised_;
    const Atom state_atom = XInternAtom(display_, "WM_STATE", False);
    const long state[2] = {minimised ? IconicState : NormalState, 0};
    XChangeProperty(display_, window, state_atom, state_atom, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(state), 2);
    minimised ? XUnmapWindow(display_, window) : XMapWindow(display_, window);
    minimised_ = window;
    XSync(display_, False);
  }

  void askToClose(const std::string& title) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = find(title);
    event.xclient.message_type = XInternAtom(display_, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(XInternAtom(display_, "WM_DELETE_WINDOW", False));
    send(event.xclient.window, event, 0);
  }

  void pressKey(const std::string& title, KeySym key, bool shift = false) {
    XEvent event{};
    event.xkey.type = KeyPress;
    event.xkey.window = find(title);
    event.xkey.root = DefaultRootWindow(display_);
    event.xkey.time = ++time_ms_;
    event.xkey.same_screen = True;
    event.xkey.keycode = XKeysymToKeycode(display_, key);
    event.xkey.state = shift ? ShiftMask : 0;
    send(event.xkey.window, event, KeyPressMask);
    event.xkey.type = KeyRelease;
    send(event.xkey.window, event, KeyReleaseMask);
  }

  void click(const std::string& title, int x, int y) {
    const ::Window window = find(title);
    XWarpPointer(display_, 0, window, 0, 0, 0, 0, x, y);
    XEvent event{};
    event.xbutton.type = ButtonPress;
    event.xbutton.window = window;
    event.xbutton.root = DefaultRootWindow(display_);
    event.xbutton.time = ++time_ms_;
    event.xbutton.same_screen = True;
    event.xbutton.button = Button1;
    send(window, event, ButtonPressMask);
  }

 private:
  void send(::Window window, XEvent& event, long mask) const {
    XSendEvent(display_, window, False, mask, &event);
    XSync(display_, False);
  }

  /// The window of that title, 0 where there is none.
  [[nodiscard]] ::Window find(const std::string& title) const {
    ::Window root = 0;
    ::Window parent = 0;
    ::Window* children = nullptr;
    unsigned count = 0;
    XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &children, &count);
    ::Window found = 0;
    for (unsigned i = 0; i < count; ++i) {
      char* name = nullptr;
      if (XFetchName(display_, children[i], &name) != 0 && name == title) found = children[i];
      if (name != nullptr) XFree(name);
    }
    if (children != nullptr) XFree(children);
    return found;
  }

  pid_t server_ = 0;
  std::string name_;
  Display* display_ = nullptr;
  ::Window minimised_ = 0;
  Time time_ms_ = 1000;
};

}  // namespace slamscope::engine
