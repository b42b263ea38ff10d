// SPDX-License-Identifier: MIT
#include "slam/formats/mat_run.hpp"

#include <algorithm>
#include <stdexcept>

#include "slam/formats/array_names.hpp"
#include "slam/formats/mat_file.hpp"

namespace slamscope::slam {
namespace {

using Names = std::vector<std::string_view>;
using Column = std::vector<MatVariable>;  ///< a value a step

/// Where the values of a run lie: variables of a file, or fields of structs.
struct Place {
  std::function<std::optional<MatVariable>(std::string_view)> whole;  ///< all steps in one
  std::function<std::optional<Column>(std::string_view)> column;      ///< one a step
};

template <class Find>
auto firstOf(const Names& names, Find find) -> decltype(find(names.front())) {
  for (const std::string_view name : names) {
    if (auto found = find(name)) return found;
  }
  return std::nullopt;
}

class CellSlices : public Slices {
 public:
  CellSlices(std::string name, Column cells, bool square)
      : name_(std::move(name)), cells_(std::move(cells)), square_(square) {}

  [[nodiscard]] std::span<const double> next() override {
    try {
      array_ = cells_[step_++].numbers();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(name_ + ": " + error.what());
    }
    const Shape& s = array_.shape;
    if (square_ && s.size() == 2 && s[0] == s[1]) transpose(array_.values);
    return array_.values;
  }

 private:
  std::string name_;
  Column cells_;
  bool square_;
  NumberArray array_;
  std::size_t step_ = 0;
};

std::size_t filled(const Column& column) {
  return static_cast<std::size_t>(std::count_if(
      column.begin(), column.end(), [](const MatVariable& value) { return value.count() != 0; }));
}

/// Cells that were made in advance and never used are left out at the end.
std::size_t usedSteps(const Column& column) {
  std::size_t steps = column.size();
  while (steps > 0 && column[steps - 1].count() == 0) --steps;
  return steps;
}

std::size_t widest(const Column& column) {
  std::size_t side = 0;
  for (const MatVariable& value : column) {
    if (value.count() != 0) side = std::max(side, value.numbers().shape.back());
  }
  return side;
}

/// x and P as one value a step.
RunArrays ofColumns(Column P, std::optional<Column> x, std::size_t& places) {
  RunArrays arrays;
  arrays.steps = usedSteps(P);
  P.erase(P.begin() + static_cast<std::ptrdiff_t>(arrays.steps), P.end());
  if (filled(P) != P.size())
    throw std::runtime_error("P: expected a matrix in each step, found none");
  places = featurePlaces(x ? 0 : widest(P));
  // In Tim Bailey's simulator as many use it, the line that keeps x is commented out.
  const std::size_t kept = x ? filled(*x) : 0;
  if (x && x->size() >= arrays.steps && kept < arrays.steps && kept <= 1) {
    arrays.warnings.push_back("x was kept in " + std::to_string(kept) + " of " +
                              std::to_string(arrays.steps) + " steps only: means are unknown");
    x.reset();
  }
  if (x && x->size() < arrays.steps) {
    throw std::runtime_error("x: expected " + std::to_string(arrays.steps) +
                             ", as many as P, found " + std::to_string(x->size()));
  }
  if (x) {
    for (const MatVariable& value : *x) places = std::max(places, featurePlaces(value.count()));
    arrays.x = std::make_unique<CellSlices>("x", std::move(*x), false);
  } else {
    const bool diagonal = std::all_of(P.begin(), P.end(), [](const MatVariable& value) {
      return std::min(value.numbers().shape.front(), value.numbers().shape.back()) == 1;
    });
    if (diagonal) {
      throw std::runtime_error(
          "expected x beside the diagonal of P, found neither means nor "
          "correlations: keep x and P in each step");
    }
  }
  arrays.P = std::make_unique<CellSlices>("P", std::move(P), true);
  return arrays;
}

RunArrays ofStacks(NumberArray P, std::optional<NumberArray> x, std::size_t& places) {
  P.shape = squeezed(P.shape, 3);
  std::optional<Stacked> x_stacked;
  if (x) x_stacked = Stacked{squeezed(x->shape, 2), StepAxis::first};
  const StackPlan plan = planStack(x_stacked, {P.shape, StepAxis::first});
  RunArrays arrays;
  arrays.steps = plan.steps;
  places = featurePlaces(plan.size);
  arrays.P = slicesOf(std::move(P), plan.steps, plan.P, !plan.diagonal);
  if (x) arrays.x = slicesOf(std::move(*x), plan.steps, plan.x);
  return arrays;
}

void addColumns(RunArrays& arrays, const Place& place) {
  const auto take = [&](const Names& names) -> std::optional<Column> {
    auto column = firstOf(names, place.column);
    if (column && column->size() < arrays.steps) column.reset();
    return column;
  };
  if (const auto times = take(array_names::kTime)) {
    for (std::size_t k = 0; k < arrays.steps; ++k) {
      const NumberArray time = (*times)[k].numbers();
      if (time.values.size() != 1) throw std::runtime_error("t: expected a number a step");
      arrays.times.push_back(time.values.front());
    }
  }
  if (const auto events = take(array_names::kEvent)) {
    for (std::size_t k = 0; k < arrays.steps; ++k) arrays.events.push_back((*events)[k].text());
  }
  if (auto ids = take(array_names::kIds)) {
    arrays.ids = std::make_unique<CellSlices>("ids", std::move(*ids), false);
  }
  if (auto observed = take(array_names::kObserved)) {
    arrays.observed_is_mask = observed->front().numbers().logical;
    arrays.observed = std::make_unique<CellSlices>("observed", std::move(*observed), false);
  }
}

RunArrays gather(const Place& place) {
  std::size_t places = 0;
  RunArrays arrays;
  if (auto P = firstOf(array_names::kP, place.column)) {
    arrays = ofColumns(std::move(*P), firstOf(array_names::kX, place.column), places);
  } else {
    const auto stack = firstOf(array_names::kP, place.whole);
    const auto x = firstOf(array_names::kX, place.whole);
    std::optional<NumberArray> means;
    if (x) means = x->numbers();
    arrays = ofStacks(stack->numbers(), std::move(means), places);
  }
  addColumns(arrays, place);
  addOptionalArrays(
      arrays,
      [&](std::string_view name) -> std::optional<NumberArray> {
        const auto found = place.whole(name);
        if (!found || found->kind() != MatVariable::Kind::numbers) return std::nullopt;
        NumberArray array = found->numbers();
        // Made in advance for more steps than there were: 3 × steps and zeros.
        const Shape& s = array.shape;
        if (s.size() == 2 && s[1] == 3 && s[0] > arrays.steps) {
          array.shape[0] = arrays.steps;
          array.values.resize(3 * arrays.steps);
        }
        return array;
      },
      places);
  return arrays;
}

/// A struct array with a field P, or one that holds it as its field `state`.
std::optional<Place> placeOf(const MatVariable& variable, bool of_state) {
  std::optional<MatVariable> states;
  if (of_state) {
    const auto inner = variable.field("state");
    if (inner && inner->size() == 1) states = inner->front();
  } else {
    states = variable;
  }
  const auto field = [states](std::string_view name) { return states->field(name); };
  if (!states || !firstOf(array_names::kP, field)) return std::nullopt;
  const auto whole = [variable](std::string_view name) -> std::optional<MatVariable> {
    const auto values = variable.field(name);
    if (!values || values->size() != 1) return std::nullopt;
    return values->front();
  };
  return Place{whole, field};
}

std::optional<Place> structIn(const MatFile& file, bool of_state) {
  for (const std::string& name : file.names()) {
    if (!file.isOf(MatVariable::Kind::structs, name)) continue;
    if (auto place = placeOf(*file.read(name), of_state)) return place;
  }
  return std::nullopt;
}

Place variablesOf(const std::shared_ptr<const MatFile>& file) {
  const auto whole = [file](std::string_view name) { return file->read(name); };
  const auto column = [file](std::string_view name) -> std::optional<Column> {
    if (!file->isOf(MatVariable::Kind::cells, name)) return std::nullopt;
    return file->read(name)->cells();
  };
  return {whole, column};
}

RunArrays matArrays(const std::string& path) {
  const auto file = std::make_shared<const MatFile>(path);
  if (const auto place = structIn(*file, true)) return gather(*place);
  const Place variables = variablesOf(file);
  const auto there = [&](std::string_view name) { return file->has(name); };
  if (std::any_of(array_names::kP.begin(), array_names::kP.end(), there)) return gather(variables);
  if (const auto place = structIn(*file, false)) return gather(*place);
  std::string found;
  for (const std::string& name : file->names()) found += (found.empty() ? "" : ", ") + name;
  throw std::runtime_error(
      "expected x and P (cell arrays, or stacked), or a struct array with fields x and P, found " +
      (found.empty() ? "no variables" : found));
}

}  // namespace

std::unique_ptr<RunSource> openMatRun(const std::string& path) {
  RunArrays arrays;
  try {
    arrays = matArrays(path);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    throw std::runtime_error(text.starts_with(path) ? text : path + ": " + text);
  }
  for (std::string& warning : arrays.warnings) warning.insert(0, path + ": ");
  return std::make_unique<ArrayRun>(path, std::move(arrays));
}

}  // namespace slamscope::slam
