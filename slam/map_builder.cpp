// SPDX-License-Identifier: MIT
#include "slam/map_builder.hpp"

#include <algorithm>
#include <stdexcept>

namespace slamscope::slam {
namespace {

constexpr FeatureId kNoFeature = 0;

const FeatureLifeOptions& checkedLife(const FeatureLifeOptions& options) {
  if (options.confirm_after < 1 || options.drop_after < 1 || options.drop_confirmed_after < 0 ||
      !(options.separation >= 0.0) || options.most_tentative < 1) {
    throw std::invalid_argument(
        "a feature is confirmed after 1 sighting or more and dropped after 1 miss or more; "
        "separation is not negative, and 1 feature at least may be tentative");
  }
  return options;
}

}  // namespace

MapBuilder::MapBuilder(EkfSlam& filter, Association association, const AssociationGates& gates,
                       const FeatureLifeOptions& life)
    : filter_(filter),
      associator_(filter.options().sensor, association, gates),
      options_(checkedLife(life)) {}

void MapBuilder::observe(std::chrono::nanoseconds time, std::span<const Observation> readings,
                         const View& view) {
  time_ = time;
  mergeDuplicates();
  const std::vector<ExpectedReading> expected =
      expectedReadings(filter_.state(), filter_.options().sensor);
  const Matches matches = associator_.match(filter_.state(), expected, readings);
  counters_.cut_searches += matches.cut_short ? 1 : 0;
  seen_last_.clear();
  const std::vector<Observation> observations = named(readings, matches);
  announceTentative();
  filter_.observe(time, observations);
  for (const FeatureId id : missing(matches, view)) {
    ++counters_.dropped;
    remove(id);
  }
}

bool MapBuilder::confirmed(FeatureId id) const {
  const auto life = lives_.find(id);
  return life != lives_.end() && life->second.confirmed;
}

/// The readings as the filter takes them: those of known features, then those of new ones.
std::vector<Observation> MapBuilder::named(std::span<const Observation> readings,
                                           const Matches& matches) {
  std::vector<Observation> observations;
  std::vector<Observation> fresh;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    if (matches.feature[k] == Matches::kAmbiguous) {
      ++counters_.ambiguous;
    } else if (matches.feature[k] == Matches::kFresh) {
      fresh.push_back(readings[k]);
    } else {
      observations.push_back(readings[k]);
      observations.back().id = filter_.state().ids[static_cast<std::size_t>(matches.feature[k])];
      see(observations.back().id, readings[k].id);
    }
  }
  const std::vector<Observation> born = births(fresh);
  observations.insert(observations.end(), born.begin(), born.end());
  return observations;
}

void MapBuilder::see(FeatureId id, FeatureId carried) {
  ++counters_.paired;
  carried_.count(id, carried);
  Life& life = lives_[id];
  ++life.seen;
  life.missed = 0;
  life.last = time_;
  seen_last_.push_back(id);
  if (life.confirmed || life.seen < options_.confirm_after) return;
  life.confirmed = true;
  --tentative_;
  ++counters_.confirmed;
}

/// Features that were expected and not seen once too often, or in doubt for too long. Asked after
/// the update, by which the robot knows best where it looked.
std::vector<FeatureId> MapBuilder::missing(const Matches& matches, const View& view) {
  std::vector<FeatureId> gone;
  const std::vector<ExpectedReading> expected =
      view ? expectedReadings(filter_.state(), filter_.options().sensor)
           : std::vector<ExpectedReading>{};
  for (std::size_t k = 0; k < matches.hinted.size(); ++k) {  // those born now come after them
    const FeatureId id = filter_.state().ids[k];
    Life& life = lives_[id];
    if (matches.hinted[k]) continue;
    const int most = life.confirmed ? options_.drop_confirmed_after : options_.drop_after;
    const bool missed = view && most > 0 && view(expected[k].z, expected[k].HPHt);
    if (missed) ++life.missed;
    const bool doubtful = !life.confirmed && options_.longest_doubt.count() > 0 &&
                          time_ - life.last > options_.longest_doubt;
    if (doubtful || (missed && life.missed >= most)) gone.push_back(id);
  }
  return gone;
}

std::vector<Observation> MapBuilder::births(std::span<const Observation> fresh) {
  std::vector<Observation> born;
  std::vector<Eigen::Vector2d> places;
  const EkfState& state = filter_.state();
  for (int row = 3; row < state.size() && !fresh.empty(); row += 2) {
    places.emplace_back(state.x.segment<2>(row));
  }
  for (const Observation& reading : fresh) {
    const Eigen::Vector2d place = locateFeature(filter_.options().sensor, state.pose(), reading.z);
    const bool near = std::any_of(places.begin(), places.end(), [&](const Eigen::Vector2d& other) {
      return (place - other).norm() < options_.separation;
    });
    if (near || tentative_ >= static_cast<std::uint64_t>(options_.most_tentative)) {
      ++counters_.crowded;
      continue;
    }
    places.push_back(place);
    born.push_back(reading);
    born.back().id = ++last_name_;
    Life& life = lives_[last_name_];
    life.last = time_;
    life.confirmed = options_.confirm_after == 1;
    carried_.count(last_name_, reading.id);
    ++counters_.born;
    ++(options_.confirm_after == 1 ? counters_.confirmed : tentative_);
  }
  return born;
}

void MapBuilder::mergeDuplicates() {
  if (options_.separation == 0.0) return;
  for (const FeatureId id : seen_last_) {
    if (!filter_.knows(id)) continue;
    const FeatureId other = duplicateOf(id);
    if (other == kNoFeature) continue;
    ++counters_.duplicates;
    remove(lives_[other].seen < lives_[id].seen ? other : id);
  }
}

/// The nearest feature that stands where nothing else than this one can; kNoFeature if none does.
FeatureId MapBuilder::duplicateOf(FeatureId id) const {
  const EkfState& state = filter_.state();
  const Eigen::Vector2d place = state.x.segment<2>(state.rowOf(id).value());
  FeatureId nearest = kNoFeature;
  double distance = options_.separation;
  for (int k = 0; k < state.featureCount(); ++k) {
    const FeatureId other = state.ids[static_cast<std::size_t>(k)];
    const double d = (state.x.segment<2>(Snapshot::row(k)) - place).norm();
    if (other == id || !(d < distance)) continue;
    nearest = other;
    distance = d;
  }
  return nearest;
}

void MapBuilder::remove(FeatureId id) {
  if (!lives_[id].confirmed) --tentative_;
  lives_.erase(id);
  carried_.forget(id);
  filter_.remove(id);
}

void MapBuilder::announceTentative() {
  std::vector<FeatureId> ids;
  for (const auto& [id, life] : lives_) {
    if (!life.confirmed) ids.push_back(id);
  }
  filter_.setTentative(std::move(ids));
}

}  // namespace slamscope::slam
