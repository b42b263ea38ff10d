// SPDX-License-Identifier: MIT
#include "slam/formats/numpy_run.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "slam/formats/array_names.hpp"
#include "slam/formats/npy_stream.hpp"
#include "slam/formats/zip_archive.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;

/// Opens the arrays of a run by name: members of an archive, or files beside each other.
class NumpyFiles {
 public:
  explicit NumpyFiles(const std::string& path) {
    if (path.ends_with(".npz")) {
      const auto archive = std::make_shared<ZipArchive>(path);
      for (const auto& [member, where] : archive->members()) {
        const std::string file = member;
        if (!file.ends_with(".npy")) continue;
        add(file.substr(0, file.size() - 4), [archive, file] { return archive->open(file); });
      }
      return;
    }
    // P.npy, or run_P.npy; beside it x.npy, or run_x.npy.
    add("P", [path] { return std::make_unique<FileBytes>(path); });
    const std::string stem = path.substr(0, path.size() - 4);
    const fs::path other = stem.substr(0, stem.size() - 1) + "x.npy";
    if (stem.ends_with('P') && fs::is_regular_file(other)) {
      add("x", [other] { return std::make_unique<FileBytes>(other); });
    }
  }

  [[nodiscard]] bool has(const std::string& name) const { return openers_.contains(name); }
  [[nodiscard]] NpyStream open(const std::string& name) const {
    return about(name, [&] { return NpyStream(openers_.at(name)()); });
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& [name, opener] : openers_) names.push_back(name);
    return names;
  }
  [[nodiscard]] std::optional<std::string> first(const std::vector<std::string_view>& names) const {
    const auto found = std::find_if(names.begin(), names.end(),
                                    [&](std::string_view name) { return has(std::string(name)); });
    if (found == names.end()) return std::nullopt;
    return std::string(*found);
  }

  /// Does it, and puts the name of the array before what may be thrown.
  template <class Act>
  static auto about(const std::string& name, Act act) -> decltype(act()) {
    try {
      return act();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(name + ": " + error.what());
    }
  }

 private:
  using Opener = std::function<std::unique_ptr<Bytes>()>;
  void add(std::string name, Opener opener) {
    openers_.emplace(std::move(name), std::move(opener));
  }

  std::map<std::string, Opener> openers_;
};

/// A stack in C's order, read step by step.
class StreamedSlices : public Slices {
 public:
  StreamedSlices(std::string name, NpyStream stream, std::size_t numbers)
      : name_(std::move(name)), stream_(std::move(stream)), numbers_(numbers) {}

  [[nodiscard]] std::span<const double> next() override {
    slice_.resize(numbers_);
    NumpyFiles::about(name_, [&] { stream_.read(slice_); });
    return slice_;
  }

 private:
  std::string name_;
  NpyStream stream_;
  std::size_t numbers_;
  std::vector<double> slice_;
};

/// x_0, x_1, …: an array a step.
class MemberSlices : public Slices {
 public:
  MemberSlices(std::shared_ptr<const NumpyFiles> files, std::vector<std::string> names)
      : files_(std::move(files)), names_(std::move(names)) {}

  [[nodiscard]] std::span<const double> next() override {
    const std::string& name = names_[step_++];
    array_ = NumpyFiles::about(name, [&] { return files_->open(name).readAll(); });
    if (array_.reversed) transpose(array_.values);
    return array_.values;
  }

 private:
  std::shared_ptr<const NumpyFiles> files_;
  std::vector<std::string> names_;
  NumberArray array_;
  std::size_t step_ = 0;
};

std::unique_ptr<Slices> stackSlices(const std::string& name, NpyStream stream,
                                    const StackPlan& plan, StepAxis axis, bool square) {
  const bool stream_it = axis == StepAxis::first && !(square && stream.reversed());
  if (stream_it) {
    const std::size_t numbers = numbersIn(stream.shape()) / std::max<std::size_t>(plan.steps, 1);
    return std::make_unique<StreamedSlices>(name, std::move(stream), numbers);
  }
  NumberArray array = NumpyFiles::about(name, [&] { return stream.readAll(); });
  return slicesOf(std::move(array), plan.steps, axis, square);
}

Stacked stacked(const NpyStream& stream) {
  Shape shape = squeezed(stream.shape(), 3);
  return {shape, stream.reversed() ? StepAxis::last : StepAxis::first};
}

/// The names with a number behind one of `stems` ("x_12", "x12"), by their numbers.
std::map<std::uint64_t, std::string> numbered(const std::vector<std::string>& names,
                                              const std::vector<std::string_view>& stems) {
  std::map<std::uint64_t, std::string> found;
  for (const std::string& name : names) {
    const std::size_t end = name.find_last_not_of("0123456789");
    if (end == name.npos || end + 1 == name.size() || name.size() - end > 18) continue;
    const std::string_view stem =
        std::string_view(name).substr(0, name[end] == '_' ? end : end + 1);
    if (std::find(stems.begin(), stems.end(), stem) == stems.end()) continue;
    found.emplace(std::stoull(name.substr(end + 1)), name);
  }
  return found;
}

/// Nothing where no array is called P_0, P_1, …
std::optional<RunArrays> arraysAStep(const std::shared_ptr<const NumpyFiles>& files,
                                     std::size_t& places) {
  const auto xs = numbered(files->names(), array_names::kX);
  const auto Ps = numbered(files->names(), array_names::kP);
  if (Ps.empty()) return std::nullopt;
  std::vector<std::string> x_names, P_names;
  for (const auto& [k, name] : Ps) {
    P_names.push_back(name);
    const auto x = xs.find(k);
    if (!xs.empty() && x == xs.end()) throw std::runtime_error("expected an x beside " + name);
    if (x != xs.end()) x_names.push_back(x->second);
  }
  if (xs.size() > x_names.size()) {
    throw std::runtime_error("expected as many P as x, found " + std::to_string(Ps.size()) +
                             " and " + std::to_string(xs.size()));
  }
  RunArrays arrays;
  arrays.steps = P_names.size();
  places = featurePlaces(files->open(P_names.back()).shape().back());
  arrays.P = std::make_unique<MemberSlices>(files, std::move(P_names));
  if (!x_names.empty()) arrays.x = std::make_unique<MemberSlices>(files, std::move(x_names));
  return arrays;
}

RunArrays stacks(const NumpyFiles& files, std::size_t& places) {
  const auto P_name = files.first(array_names::kP);
  const auto x_name = files.first(array_names::kX);
  if (!P_name) {
    std::string found;
    for (const std::string& name : files.names()) found += (found.empty() ? "" : ", ") + name;
    throw std::runtime_error("expected arrays x and P, found " + (found.empty() ? "none" : found));
  }
  NpyStream P = files.open(*P_name);
  std::optional<NpyStream> x;
  if (x_name) x.emplace(files.open(*x_name));
  std::optional<Stacked> x_stacked;
  if (x) {
    x_stacked = stacked(*x);
    x_stacked->shape = squeezed(x_stacked->shape, 2);
  }
  const StackPlan plan = planStack(x_stacked, stacked(P));
  RunArrays arrays;
  arrays.steps = plan.steps;
  places = featurePlaces(plan.size);
  arrays.P = stackSlices(*P_name, std::move(P), plan, plan.P, !plan.diagonal);
  if (x) arrays.x = stackSlices(*x_name, std::move(*x), plan, plan.x, false);
  return arrays;
}

RunArrays numpyArrays(const std::string& path) {
  const auto files = std::make_shared<const NumpyFiles>(path);
  std::size_t places = 0;
  auto arrays = arraysAStep(files, places);
  if (!arrays || files->first({"P"})) arrays = stacks(*files, places);
  addOptionalArrays(
      *arrays,
      [&](std::string_view word) -> std::optional<NumberArray> {
        const std::string name(word);
        if (!files->has(name)) return std::nullopt;
        return NumpyFiles::about(name, [&] { return files->open(name).readAll(); });
      },
      places);
  if (const auto event = files->first(array_names::kEvent)) {
    NpyStream words = files->open(*event);
    if (!words.isText()) throw std::runtime_error(*event + ": expected words, found numbers");
    arrays->events = NumpyFiles::about(*event, [&] { return words.readWords(); });
  }
  return std::move(*arrays);
}

}  // namespace

std::unique_ptr<RunSource> openNumpyRun(const std::string& path) {
  RunArrays arrays;
  const FileBytes there(path);
  try {
    arrays = numpyArrays(path);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    throw std::runtime_error(text.starts_with(path) ? text : path + ": " + text);
  }
  return std::make_unique<ArrayRun>(path, std::move(arrays));
}

}  // namespace slamscope::slam
