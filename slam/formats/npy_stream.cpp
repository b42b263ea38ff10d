// SPDX-License-Identifier: MIT
#include "slam/formats/npy_stream.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace slamscope::slam {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kBatch = 8192;  // numbers converted at a time

[[noreturn]] void failHeader(const std::string& text) {
  throw std::runtime_error(text);
}

constexpr const char* kDigits = "0123456789";

/// What stands behind `'key':` and spaces, between `opening` and the first of `closing`.
std::string field(const std::string& header, const std::string& key, const std::string& opening,
                  const char* closing, const std::string& name) {
  const std::string label = "'" + key + "':";
  std::size_t begin = header.find(label);
  if (begin != header.npos) begin = header.find_first_not_of(" \t", begin + label.size());
  if (begin == header.npos || header.compare(begin, opening.size(), opening) != 0) {
    failHeader("expected " + name + " in the header of the array, found none");
  }
  begin += opening.size();
  return header.substr(begin,
                       std::min(header.size(), header.find_first_of(closing, begin)) - begin);
}

template <class From>
void convert(const char* raw, std::span<double> numbers) {
  for (double& number : numbers) {
    From value;
    std::memcpy(&value, raw, sizeof value);
    number = static_cast<double>(value);
    raw += sizeof value;
  }
}

using Convert = void (*)(const char*, std::span<double>);

/// Nothing for a type that is not supported.
Convert conversion(char kind, std::size_t size) {
  if (kind == 'f') return size == 8 ? convert<double> : size == 4 ? convert<float> : nullptr;
  if (kind == 'b') return convert<std::uint8_t>;
  const bool is_signed = kind == 'i';
  if (!is_signed && kind != 'u') return nullptr;
  switch (size) {
    case 1:
      return is_signed ? convert<std::int8_t> : convert<std::uint8_t>;
    case 2:
      return is_signed ? convert<std::int16_t> : convert<std::uint16_t>;
    case 4:
      return is_signed ? convert<std::int32_t> : convert<std::uint32_t>;
    case 8:
      return is_signed ? convert<std::int64_t> : convert<std::uint64_t>;
    default:
      return nullptr;
  }
}

}  // namespace

NpyStream::NpyStream(std::unique_ptr<Bytes> bytes) : bytes_(std::move(bytes)) {
  std::string start(8, '\0');
  fill(start);
  if (start.substr(0, 6) != "\x93NUMPY") failHeader("expected an array in NumPy's format");
  const int version = static_cast<unsigned char>(start[6]);
  if (version < 1 || version > 3) {
    failHeader("expected version 1 to 3 of NumPy's format, found " + std::to_string(version));
  }
  std::uint32_t length = 0;
  fill({reinterpret_cast<char*>(&length), version == 1 ? 2U : 4U});
  if (length > (1U << 20U)) failHeader("the header of the array is damaged");
  std::string header(length, '\0');
  fill(header);
  parse(header);
}

void NpyStream::parse(const std::string& header) {
  // {'descr': '<f8', 'fortran_order': False, 'shape': (100, 3), }
  if (header.find("'descr': [") != header.npos) {
    failHeader(
        "expected numbers, found records of several fields: save x and P as arrays of their own");
  }
  const std::string type = field(header, "descr", "'", "'", "the type of numbers");
  if (type.find('O') != type.npos) {
    failHeader(
        "an object array (pickled Python objects, which are not read): save with np.savez(..., "
        "x=..., P=...) as float arrays; pad with NaN");
  }
  reversed_ = field(header, "fortran_order", "", ",} ", "the order") == "True";
  const std::string shape = field(header, "shape", "(", ")", "the shape");
  for (std::size_t at = shape.find_first_of(kDigits); at != shape.npos;) {
    const std::size_t end = std::min(shape.size(), shape.find_first_not_of(kDigits, at));
    if (end - at > 15) failHeader("the shape of the array is damaged");
    shape_.push_back(std::stoull(shape.substr(at, end - at)));
    at = shape.find_first_of(kDigits, end);
  }
  static_cast<void>(numbersIn(shape_));
  if (reversed_ && shape_.size() < 2) reversed_ = false;
  if (reversed_) std::reverse(shape_.begin(), shape_.end());
  // Byte order, kind, bytes: "<f8".
  const std::size_t kind = type.find_first_not_of("<>|=");
  const std::string bytes = kind < type.size() ? type.substr(kind + 1) : "";
  if (kind > 1 || bytes.empty() || bytes.size() > 6 ||
      bytes.find_first_not_of(kDigits) != bytes.npos) {
    failHeader("expected numbers (float64), found type '" + type + "'");
  }
  big_endian_ = type.front() == '>';
  kind_ = type[kind];
  item_ = std::stoul(bytes) * (kind_ == 'U' ? 4 : 1);
  if (!isText() && conversion(kind_, item_) == nullptr) {
    failHeader("expected numbers of type float64 or float32, found '" + type + "'");
  }
}

void NpyStream::fill(std::span<char> buffer) {
  if (bytes_->read(buffer) != buffer.size()) failHeader("it is cut off");
}

void NpyStream::read(std::span<double> numbers) {
  if (isText()) failHeader("expected numbers, found text");
  const Convert convert_batch = conversion(kind_, item_);
  while (!numbers.empty()) {
    const std::span<double> batch = numbers.first(std::min(numbers.size(), kBatch));
    raw_.resize(batch.size() * item_);
    fill(raw_);
    if (big_endian_ && item_ > 1) {
      for (auto at = raw_.begin(); at != raw_.end(); at += static_cast<std::ptrdiff_t>(item_)) {
        std::reverse(at, at + static_cast<std::ptrdiff_t>(item_));
      }
    }
    convert_batch(raw_.data(), batch);
    numbers = numbers.subspan(batch.size());
  }
}

NumberArray NpyStream::readAll() {
  NumberArray array{shape_, {}, reversed_, kind_ == 'b'};
  // Grows as it is read: a shape that lies must not reserve memory that no data follows for.
  for (std::size_t left = numbersIn(shape_); left != 0;) {
    const std::size_t part = std::min<std::size_t>(left, 1U << 20U);
    array.values.resize(array.values.size() + part);
    read(std::span(array.values).last(part));
    left -= part;
  }
  return array;
}

std::vector<std::string> NpyStream::readWords() {
  std::vector<std::string> words(std::min<std::size_t>(numbersIn(shape_), 1U << 28U));
  std::vector<char> raw(item_);
  for (std::string& word : words) {
    fill(raw);
    const std::size_t step = kind_ == 'U' ? 4 : 1;
    for (std::size_t k = 0; k < raw.size(); k += step) {
      std::uint32_t code = 0;
      std::memcpy(&code, raw.data() + k, step);
      if (big_endian_ && step == 4) code = __builtin_bswap32(code);
      if (code != 0) word += code < 0x80 ? static_cast<char>(code) : '?';  // known words are ASCII
    }
  }
  return words;
}

}  // namespace slamscope::slam
