// SPDX-License-Identifier: MIT
#include "slam/live_link.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <utility>

#include "slam/line_buffer.hpp"
#include "slam/link_listener.hpp"
#include "slam/run_decoder.hpp"

namespace slamscope::slam {
/// One stream of bytes from a filter.
struct LinkSource {
  LinkSource(Descriptor from, const std::string& name)
      : descriptor(std::move(from)), decoder(name, RunDecoder::Runs::many) {}

  Descriptor descriptor;
  LineBuffer lines;
  RunDecoder decoder;
};

namespace {

constexpr std::size_t kReceiveAtOnce = std::size_t{64} << 10U;
constexpr int kReceivesAPoll = 64;  // 4 MiB, some 300 records of 15 features

constexpr std::string_view kScheme = "tcp://";

enum class Read { data, nothing, end };

Read readInto(LinkSource& source) {
  const auto room = source.lines.room(kReceiveAtOnce);
  const ssize_t size = ::read(source.descriptor.number(), room.data(), room.size());
  if (size > 0) source.lines.commit(static_cast<std::size_t>(size));
  if (size > 0) return Read::data;
  const bool later = size < 0 && (errno == EAGAIN || errno == EINTR);
  return later ? Read::nothing : Read::end;
}

bool readable(int descriptor) {
  pollfd wanted{descriptor, POLLIN, 0};
  return ::poll(&wanted, 1, 0) > 0;
}

}  // namespace

struct LiveLink::State {
  std::string name;
  Listener listener;
  std::unique_ptr<LinkSource> active;
  std::unique_ptr<LinkSource> pending;  ///< connected, but has sent nothing yet
  LinkStatus status;
  std::uint64_t runs_before = 0;  ///< of earlier connections
  std::uint64_t equal_before = 0;

  void open(Descriptor descriptor) {
    active = std::make_unique<LinkSource>(std::move(descriptor), name);
    ++status.connections;
  }

  void promote() {
    close();
    active = std::move(pending);
    ++status.connections;
    status.state = LinkStatus::State::connected;
  }

  void close() {
    if (!active) return;
    runs_before += active->decoder.runs();
    equal_before += active->decoder.equalStamps();
    active.reset();
    status.state = listener.socket ? LinkStatus::State::waiting : LinkStatus::State::ended;
  }

  void countUnreadable(const std::runtime_error& error) {
    ++status.unreadable;
    status.last_error = error.what();
  }

  /// The next complete line; one that is too long is counted, and what follows it is looked at.
  std::optional<std::string_view> nextLine() {
    while (true) {
      try {
        return active->lines.next();
      } catch (const std::runtime_error& error) {
        countUnreadable(error);
      }
    }
  }

  SnapshotPtr decode(std::string_view line) {
    const bool joined_in_the_middle = active->decoder.lines() == 0 && !line.starts_with('{');
    try {
      SnapshotPtr snapshot = active->decoder.decode(line);
      status.records += snapshot ? 1 : 0;
      status.runs = runs_before + active->decoder.runs();
      status.equal_stamps = equal_before + active->decoder.equalStamps();
      status.header = active->decoder.header();
      return snapshot;
    } catch (const std::runtime_error& error) {
      if (!joined_in_the_middle) countUnreadable(error);
      return nullptr;
    }
  }

  /// Waits until something can be read. Whether the active source has something.
  void wait(std::chrono::milliseconds timeout) {
    std::array<pollfd, 3> wanted{};
    const auto number = [](const std::unique_ptr<LinkSource>& source) {
      return source ? source->descriptor.number() : -1;  // poll passes over negative ones
    };
    wanted[0] = {listener.socket.number(), POLLIN, 0};
    wanted[1] = {number(active), POLLIN, 0};
    wanted[2] = {number(pending), POLLIN, 0};
    ::poll(wanted.data(), wanted.size(), static_cast<int>(timeout.count()));
  }

  /// A new connection takes over once it sends something.
  void welcome() {
    if (!listener.socket) return;
    while (Descriptor connection = acceptFrom(listener)) {
      pending = std::make_unique<LinkSource>(std::move(connection), name);
    }
    if (!pending) return;
    const Read read = readInto(*pending);
    if (read == Read::end) pending.reset();
    if (read == Read::data) promote();
  }
};

LiveLink::LiveLink(std::string_view source) : state_(std::make_unique<State>()) {
  if (source == "-") {
    state_->name = "standard input";
    state_->open(Descriptor(STDIN_FILENO, false));
  } else if (source.starts_with(kScheme)) {
    state_->name = source;
    state_->listener = listenOn(source.substr(kScheme.size()));
  } else {
    throw std::runtime_error(std::string(source) +
                             ": expected - (standard input) or tcp://HOST:PORT");
  }
}

LiveLink::LiveLink(int descriptor) : state_(std::make_unique<State>()) {
  state_->name = "stream";
  state_->open(Descriptor(descriptor, false));
}

LiveLink::~LiveLink() = default;

int LiveLink::port() const {
  return state_->listener.port;
}
const LinkStatus& LiveLink::status() const {
  return state_->status;
}

std::size_t LiveLink::poll(std::chrono::milliseconds timeout) {
  State& link = *state_;
  if (link.status.state == LinkStatus::State::ended) return 0;
  link.wait(timeout);
  link.welcome();
  std::size_t published = publishLines();
  for (int chunk = 0; chunk < kReceivesAPoll && link.active; ++chunk) {
    if (!readable(link.active->descriptor.number())) break;
    const Read read = readInto(*link.active);
    if (read == Read::data) link.status.state = LinkStatus::State::connected;
    published += publishLines();
    if (read != Read::end) continue;
    published += publishLast();
    link.close();
  }
  return published;
}

std::size_t LiveLink::publishLines() {
  std::size_t published = 0;
  while (state_->active) {
    const auto line = state_->nextLine();
    if (!line) break;
    published += publishLine(*line);
  }
  return published;
}

std::size_t LiveLink::publishLine(std::string_view line) {
  const SnapshotPtr snapshot = state_->decode(line);
  if (!snapshot) return 0;
  publish(snapshot);
  return 1;
}

std::size_t LiveLink::publishLast() {
  const std::string line(state_->active->lines.rest());
  return line.empty() ? 0 : publishLine(line);
}

}  // namespace slamscope::slam
