// SPDX-License-Identifier: MIT
#include "slam/link_listener.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace slamscope::slam {
namespace {

struct Address {
  std::string host = "127.0.0.1";
  std::string port;
};

Address splitAddress(std::string_view text) {
  Address address;
  const auto colon = text.rfind(':');
  std::string_view host = colon == text.npos ? std::string_view() : text.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  if (host == "*") host = "0.0.0.0";
  if (!host.empty()) address.host = host;
  address.port = colon == text.npos ? text : text.substr(colon + 1);
  unsigned number = 0;
  const char* end = address.port.data() + address.port.size();
  const auto read = std::from_chars(address.port.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || number > 65535) {
    throw std::runtime_error("tcp://" + std::string(text) +
                             ": expected tcp://HOST:PORT with a port from 0 to 65535");
  }
  return address;
}

int portOf(int socket) {
  sockaddr_storage name{};
  socklen_t size = sizeof(name);
  if (::getsockname(socket, reinterpret_cast<sockaddr*>(&name), &size) != 0) return 0;
  if (name.ss_family == AF_INET6) {
    return ntohs(reinterpret_cast<const sockaddr_in6*>(&name)->sin6_port);
  }
  return ntohs(reinterpret_cast<const sockaddr_in*>(&name)->sin_port);
}

}  // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept
    : number_(std::exchange(other.number_, -1)), owned_(std::exchange(other.owned_, false)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  std::swap(owned_, other.owned_);
  return *this;
}

Descriptor::~Descriptor() {
  if (owned_) ::close(number_);
}

Listener listenOn(std::string_view text) {
  const Address address = splitAddress(text);
  const std::string name = "tcp://" + address.host + ":" + address.port;
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
  if (error != 0) {
    throw std::runtime_error(name + ": unknown host (" + ::gai_strerror(error) + ")");
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> list(found, &::freeaddrinfo);
  int reason = 0;
  for (const addrinfo* info = found; info != nullptr; info = info->ai_next) {
    Descriptor socket(::socket(info->ai_family, info->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK,
                               info->ai_protocol));
    const int on = 1;
    if (socket && ::setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on)) == 0 &&
        ::bind(socket.number(), info->ai_addr, info->ai_addrlen) == 0 &&
        ::listen(socket.number(), 8) == 0) {
      const int port = portOf(socket.number());
      return {std::move(socket), port};
    }
    reason = errno;
  }
  throw std::runtime_error(name + ": can't be listened on (" + std::strerror(reason) + ")");
}

Descriptor acceptFrom(const Listener& listener) {
  return Descriptor(
      ::accept4(listener.socket.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK), true);
}

}  // namespace slamscope::slam
