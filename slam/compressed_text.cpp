// SPDX-License-Identifier: MIT
#include "slam/compressed_text.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace slamscope::slam {
namespace {

constexpr std::size_t kChunk = std::size_t{256} << 10U;
constexpr int kLevel = 3;  // zstd's default: about 400 MB/s, which keeps ahead of the formatting

[[noreturn]] void failSystem(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what + " (" + std::strerror(errno) + ")");
}

bool isZstd(std::string_view start) {
  return start.starts_with("\x28\xb5\x2f\xfd") ||
         (start.size() >= 4 && (start[0] & 0xf0) == 0x50 && start.substr(1, 3) == "\x2a\x4d\x18");
}

std::size_t readSome(int descriptor, char* data, std::size_t size, const std::string& path) {
  while (true) {
    const ssize_t got = ::read(descriptor, data, size);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) failSystem(path, "can't be read");
  }
}

void writeAll(int descriptor, std::string_view text, const std::string& path) {
  while (!text.empty()) {
    const ssize_t put = ::write(descriptor, text.data(), text.size());
    if (put >= 0) {
      text.remove_prefix(static_cast<std::size_t>(put));
    } else if (errno != EINTR) {
      failSystem(path, "can't be written");
    }
  }
}

bool isRegularOrNew(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) != 0 || S_ISREG(info.st_mode);
}

}  // namespace

RunFormat runFormat(const std::string& path) {
  if (path.ends_with(".jsonl")) return RunFormat::json_lines;
  if (path.ends_with(".jsonl.zst")) return RunFormat::json_lines_zst;
  if (path == "-" || (!isRegularOrNew(path) && !std::filesystem::is_directory(path))) {
    return RunFormat::json_lines;
  }
  const auto ending = std::filesystem::path(path).extension().string();
  throw std::runtime_error(path + ": " + (ending.empty() ? "a name without ending" : ending) +
                           " is not supported; runs are written as .jsonl or .jsonl.zst");
}

struct TextInput::State {
  std::string path;
  int descriptor = -1;
  std::string packed;  ///< bytes as stored: the first ones, or what zstd has yet to unpack
  std::size_t used = 0;
  ZSTD_DStream* zstd = nullptr;
  bool in_frame = false;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (descriptor >= 0) ::close(descriptor);
    ZSTD_freeDStream(zstd);
  }

  bool refill() {
    packed.resize(kChunk);
    packed.resize(readSome(descriptor, packed.data(), kChunk, path));
    used = 0;
    return !packed.empty();
  }

  std::size_t plain(std::span<char> buffer) {
    if (used == packed.size()) return readSome(descriptor, buffer.data(), buffer.size(), path);
    const std::size_t size = packed.copy(buffer.data(), buffer.size(), used);
    used += size;
    return size;
  }

  std::size_t unpack(std::span<char> buffer) {
    ZSTD_outBuffer out{buffer.data(), buffer.size(), 0};
    while (out.pos == 0) {
      if (used == packed.size() && !refill()) break;
      ZSTD_inBuffer in{packed.data(), packed.size(), used};
      const std::size_t left = ZSTD_decompressStream(zstd, &out, &in);
      if (ZSTD_isError(left) != 0) {
        throw std::runtime_error(path + ": compressed data is damaged (" + ZSTD_getErrorName(left) +
                                 ")");
      }
      used = in.pos;
      in_frame = left != 0;
    }
    return out.pos;
  }
};

TextInput::TextInput(const std::string& path) : state_(std::make_unique<State>()) {
  state_->path = path;
  if (std::filesystem::is_directory(path)) {
    throw std::runtime_error(path + ": expected a file, found a directory");
  }
  state_->descriptor =
      path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (state_->descriptor < 0) failSystem(path, "can't be opened");
  state_->refill();
  if (isZstd(state_->packed)) state_->zstd = ZSTD_createDStream();
}

TextInput::~TextInput() = default;
TextInput::TextInput(TextInput&&) noexcept = default;
TextInput& TextInput::operator=(TextInput&&) noexcept = default;

std::size_t TextInput::read(std::span<char> buffer) {
  return state_->zstd != nullptr ? state_->unpack(buffer) : state_->plain(buffer);
}

bool TextInput::cutOff() const {
  return state_->in_frame;
}

struct TextOutput::State {
  std::string path;
  std::string temporary;  ///< empty where the target is written directly
  int descriptor = -1;
  bool owned = false;
  std::string waiting;
  ZSTD_CStream* zstd = nullptr;
  std::vector<char> packed;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (owned) ::close(descriptor);
    if (!temporary.empty()) ::unlink(temporary.c_str());
    ZSTD_freeCStream(zstd);
  }

  void open() {
    if (path == "-") {
      descriptor = STDOUT_FILENO;
    } else if (!isRegularOrNew(path)) {
      descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
      openTemporary();
    }
    if (descriptor < 0) failSystem(path, "can't be written");
    owned = path != "-";
  }

  void openTemporary() {
    const std::string target =
        std::filesystem::exists(path) ? std::filesystem::canonical(path).string() : path;
    for (int k = 0; descriptor < 0 && k < 100; ++k) {
      temporary = target + ".part" + std::to_string(::getpid()) + "-" + std::to_string(k);
      descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor < 0 && errno != EEXIST) break;
    }
    if (descriptor < 0) temporary.clear();
    path = target;
  }

  void put(std::string_view text, ZSTD_EndDirective end) {
    if (zstd == nullptr) return writeAll(descriptor, text, path);
    ZSTD_inBuffer in{text.data(), text.size(), 0};
    for (bool more = true; more;) {
      ZSTD_outBuffer out{packed.data(), packed.size(), 0};
      const std::size_t left = ZSTD_compressStream2(zstd, &out, &in, end);
      if (ZSTD_isError(left) != 0) throw std::runtime_error(path + ": " + ZSTD_getErrorName(left));
      writeAll(descriptor, {packed.data(), out.pos}, path);
      more = end == ZSTD_e_continue ? in.pos < in.size : left != 0;
    }
  }
};

TextOutput::TextOutput(std::string path, bool zst) : state_(std::make_unique<State>()) {
  state_->path = std::move(path);
  state_->open();
  if (!zst) return;
  state_->zstd = ZSTD_createCStream();
  ZSTD_CCtx_setParameter(state_->zstd, ZSTD_c_compressionLevel, kLevel);
  ZSTD_CCtx_setParameter(state_->zstd, ZSTD_c_checksumFlag, 1);
  state_->packed.resize(ZSTD_CStreamOutSize());
}

TextOutput::~TextOutput() = default;
TextOutput::TextOutput(TextOutput&&) noexcept = default;
TextOutput& TextOutput::operator=(TextOutput&&) noexcept = default;

void TextOutput::write(std::string_view text) {
  if (live()) return state_->put(text, ZSTD_e_flush);
  state_->waiting += text;
  if (state_->waiting.size() < kChunk) return;
  state_->put(state_->waiting, ZSTD_e_continue);
  state_->waiting.clear();
}

bool TextOutput::live() const {
  return state_->temporary.empty();
}

void TextOutput::finish() {
  state_->put(state_->waiting, ZSTD_e_end);
  state_->waiting.clear();
  if (!state_->owned) return;
  const int closed = ::close(state_->descriptor);
  state_->owned = false;
  if (closed != 0) failSystem(state_->path, "can't be written");
  if (live()) return;
  if (::rename(state_->temporary.c_str(), state_->path.c_str()) != 0) {
    failSystem(state_->path, "can't be put in place");
  }
  state_->temporary.clear();
}

}  // namespace slamscope::slam
