// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "slam/snapshot.hpp"
#include "slam/subject.hpp"

namespace slamscope::slam {

/// How a live link is doing.
struct LinkStatus {
  enum class State {
    waiting,    ///< nobody is sending (yet, or any more: a new source is welcome)
    connected,  ///< somebody is sending
    ended       ///< standard input came to its end; nothing more will come
  };
  State state = State::waiting;
  /// Counts runs: each connection, each header and each `initial` record begins one. An observer
  /// drops what it remembers (the path) when this changes.
  std::uint64_t runs = 0;
  std::uint64_t connections = 0;
  std::uint64_t records = 0;
  std::uint64_t unreadable = 0;  ///< lines skipped because they could not be read
  std::uint64_t equal_stamps = 0;
  std::string last_error;  ///< why the last unreadable line was skipped
  RunHeader header;        ///< of the current run
};

/// Snapshots from a filter that runs now, in any language: JSON lines (see jsonl.hpp) from standard
/// input or from a TCP connection. An unreadable line is skipped and counted; the link stays alive.
/// A source that dies may come back: its connection (or, on one stream, its header) begins a new
/// run. Each line stands for itself, so source and viewer may start in any order; a stream that is
/// joined in the middle of a line is read from the next one on.
///
/// Over TCP one source is shown at a time. The newest that has sent something wins, so that a dead
/// peer never blocks a restarted filter; a connection that sends nothing (a port scan) changes
/// nothing.
///
///   LiveLink link("tcp://127.0.0.1:7007");
///   auto subscription = link.observe(show);
///   while (running) link.poll(10ms);
///
/// No threads inside: `poll` publishes on the caller's thread.
class LiveLink : public Subject {
 public:
  /// `-` for standard input, or `tcp://HOST:PORT` to listen on; `tcp://:PORT` and `tcp://PORT` are
  /// loopback, `tcp://0.0.0.0:PORT` every interface, port 0 any free one. Throws
  /// std::runtime_error where the source is neither or the port can't be had.
  explicit LiveLink(std::string_view source);
  /// Any readable descriptor (pipe, FIFO, socket). It stays the caller's.
  explicit LiveLink(int descriptor);
  ~LiveLink();

  /// Waits for input, at most `timeout`, and publishes the records of all complete lines that have
  /// arrived, in order (at most some MiB per call, so that a fast source does not hold up the
  /// caller). How many it published.
  std::size_t poll(std::chrono::milliseconds timeout);

  [[nodiscard]] int port() const;  ///< listened on; 0 for a stream
  [[nodiscard]] const LinkStatus& status() const;

 private:
  [[nodiscard]] std::size_t publishLines();
  [[nodiscard]] std::size_t publishLine(std::string_view line);
  [[nodiscard]] std::size_t publishLast();

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace slamscope::slam
