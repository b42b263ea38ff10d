// SPDX-License-Identifier: MIT
#include "slam/formats/mat_file.hpp"

#include <matio.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "slam/formats/bytes.hpp"

namespace slamscope::slam {
namespace {

constexpr std::uint64_t kHeader5 = 128;  // bytes before the first variable of a file of version 5

std::uint32_t word(const std::string& bytes, std::size_t at, bool swap) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t from = swap ? at + k : at + 3 - k;
    value = value << 8U | static_cast<unsigned char>(bytes[from]);
  }
  return value;
}

/// libmatio reads what is left of a file that was cut off; its variables say how long they are.
void checkWhole5(const std::string& path) {
  const std::uint64_t size = std::filesystem::file_size(path);
  std::string header(kHeader5, '\0');
  static_cast<void>(FileBytes(path).read(header));
  const bool swap = header.substr(126) == "MI";
  for (std::uint64_t at = kHeader5; at < size;) {
    std::string tag(8, '\0');
    const bool whole = FileBytes(path, at).read(tag) == tag.size();
    at += tag.size() + word(tag, 4, swap);
    if (!whole || at > size) throw std::runtime_error("it is cut off");
  }
}

template <class From>
void append(const void* data, std::size_t count, std::vector<double>& numbers) {
  const auto* from = static_cast<const From*>(data);
  std::transform(from, from + count, std::back_inserter(numbers),
                 [](From value) { return static_cast<double>(value); });
}

/// False where the class is none of numbers.
bool appendNumbers(const matvar_t& variable, std::size_t count, std::vector<double>& numbers) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      append<double>(variable.data, count, numbers);
      return true;
    case MAT_C_SINGLE:
      append<float>(variable.data, count, numbers);
      return true;
    case MAT_C_INT8:
      append<std::int8_t>(variable.data, count, numbers);
      return true;
    case MAT_C_UINT8:
      append<std::uint8_t>(variable.data, count, numbers);
      return true;
    case MAT_C_INT16:
      append<std::int16_t>(variable.data, count, numbers);
      return true;
    case MAT_C_UINT16:
      append<std::uint16_t>(variable.data, count, numbers);
      return true;
    case MAT_C_INT32:
      append<std::int32_t>(variable.data, count, numbers);
      return true;
    case MAT_C_UINT32:
      append<std::uint32_t>(variable.data, count, numbers);
      return true;
    case MAT_C_INT64:
      append<std::int64_t>(variable.data, count, numbers);
      return true;
    case MAT_C_UINT64:
      append<std::uint64_t>(variable.data, count, numbers);
      return true;
    default:
      return false;
  }
}

std::size_t elements(const matvar_t& variable) {
  return numbersIn(Shape(variable.dims, variable.dims + variable.rank));
}

}  // namespace

MatVariable::Kind MatVariable::kind() const {
  if (!variable_) return Kind::numbers;
  switch (variable_->class_type) {
    case MAT_C_CELL:
      return Kind::cells;
    case MAT_C_STRUCT:
      return Kind::structs;
    case MAT_C_CHAR:
      return Kind::text;
    case MAT_C_OBJECT:
    case MAT_C_FUNCTION:
    case MAT_C_OPAQUE:
      return Kind::other;
    default:
      return Kind::numbers;
  }
}

std::size_t MatVariable::count() const {
  return variable_ ? elements(*variable_) : 0;
}

NumberArray MatVariable::numbers() const {
  NumberArray array;
  array.reversed = true;
  if (!variable_ || elements(*variable_) == 0) {
    array.shape = {0};
    return array;
  }
  if (variable_->class_type == MAT_C_SPARSE) {
    throw std::runtime_error("expected a full matrix, found a sparse one: save full(P)");
  }
  if (variable_->isComplex != 0) throw std::runtime_error("expected real numbers, found complex");
  array.shape.assign(variable_->dims, variable_->dims + variable_->rank);
  std::reverse(array.shape.begin(), array.shape.end());
  array.logical = variable_->isLogical != 0;
  const std::size_t count = elements(*variable_);
  array.values.reserve(count);
  if (variable_->data == nullptr || !appendNumbers(*variable_, count, array.values)) {
    throw std::runtime_error("expected numbers, found something else");
  }
  return array;
}

std::string MatVariable::text() const {
  if (!variable_ || variable_->data == nullptr) return {};
  if (variable_->class_type != MAT_C_CHAR)
    throw std::runtime_error("expected words, found numbers");
  std::string result;
  const std::size_t count = elements(*variable_);
  const bool wide = variable_->data_type == MAT_T_UINT16 || variable_->data_type == MAT_T_UTF16;
  for (std::size_t k = 0; k < count; ++k) {
    result += wide ? static_cast<char>(static_cast<const std::uint16_t*>(variable_->data)[k])
                   : static_cast<const char*>(variable_->data)[k];
  }
  return result;
}

std::vector<MatVariable> MatVariable::cells() const {
  std::vector<MatVariable> result;
  const std::size_t count = variable_ && variable_->data != nullptr ? elements(*variable_) : 0;
  for (std::size_t k = 0; k < count; ++k) {
    result.push_back(part(static_cast<matvar_t* const*>(variable_->data)[k]));
  }
  return result;
}

std::optional<std::vector<MatVariable>> MatVariable::field(std::string_view name) const {
  if (!variable_ || variable_->class_type != MAT_C_STRUCT) return std::nullopt;
  auto* const whole = const_cast<matvar_t*>(variable_.get());  // libmatio does not write to it
  const unsigned fields = Mat_VarGetNumberOfFields(whole);
  char* const* names = Mat_VarGetStructFieldnames(whole);
  const auto* at = std::find(names, names + fields, name);
  if (at == names + fields || variable_->data == nullptr) return std::nullopt;
  const auto* values = static_cast<matvar_t* const*>(variable_->data);
  std::vector<MatVariable> result;
  for (std::size_t k = 0; k < elements(*variable_); ++k) {
    result.push_back(part(values[k * fields + static_cast<std::size_t>(at - names)]));
  }
  return result;
}

MatFile::MatFile(const std::string& path) {
  const FileBytes there(path);
  mat_t* file = Mat_Open(path.c_str(), MAT_ACC_RDONLY);
  if (file == nullptr) {
    throw std::runtime_error("expected a file of MATLAB or Octave; save with -v7");
  }
  file_ = std::shared_ptr<mat_t>(file, [](mat_t* open) { Mat_Close(open); });
  if (Mat_GetVersion(file) == MAT_FT_MAT5) checkWhole5(path);
  std::size_t count = 0;
  char* const* names = Mat_GetDir(file, &count);
  if (names != nullptr) names_.assign(names, names + count);
}

bool MatFile::has(std::string_view name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::optional<MatVariable> MatFile::find(std::string_view name, bool with_values) const {
  if (!has(name)) return std::nullopt;
  const std::string text(name);
  auto* const file = static_cast<mat_t*>(file_.get());
  matvar_t* variable =
      with_values ? Mat_VarRead(file, text.c_str()) : Mat_VarReadInfo(file, text.c_str());
  if (variable == nullptr) throw std::runtime_error(text + ": can't be read; save with -v7");
  return MatVariable(std::shared_ptr<const matvar_t>(
      variable, [](const matvar_t* read) { Mat_VarFree(const_cast<matvar_t*>(read)); }));
}

std::optional<MatVariable> MatFile::read(std::string_view name) const {
  return find(name, true);
}

bool MatFile::isOf(MatVariable::Kind kind, std::string_view name) const {
  const auto variable = find(name, false);
  return variable && variable->kind() == kind;
}

}  // namespace slamscope::slam
