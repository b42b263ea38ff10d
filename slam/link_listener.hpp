// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace slamscope::slam {

/// A descriptor that is closed with its owner. Move only.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number, bool owned = true) : number_(number), owned_(owned) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  [[nodiscard]] int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_ = -1;
  bool owned_ = false;
};

/// A TCP socket that listens, and the port it got.
struct Listener {
  Descriptor socket;
  int port = 0;
};

/// `address` is HOST:PORT, :PORT, PORT (both loopback) or [IPv6]:PORT; port 0 is any free one.
/// Throws std::runtime_error where it is none of these or the port can't be had.
[[nodiscard]] Listener listenOn(std::string_view address);

/// The connection that waits, not blocking; empty where none does.
[[nodiscard]] Descriptor acceptFrom(const Listener& listener);

}  // namespace slamscope::slam
