// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "tracking/head_fit.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {

/// What is wrong with tags that don't fit the rest, told from where they are seen instead. What is
/// found in at least six of the last ten fits that saw the tag is named, and stays so while the tag
/// is out of view.
class TagFaults {
 public:
  /// One fit, of which at least two other tags were used.
  void add(std::span<const EyeCamera> eyes, const TagLayout& layout,
           std::span<const HeadSight> sights, const HeadFit& fit);

  /// "tag 3 has moved by 0.010 m", "tags 3 and 4 are swapped in the layout", "tag 3 stands in the
  /// place of tag 4", "tag 3 looks 0.160 m wide where 0.200 m is stated", "tag 3 is seen twice".
  [[nodiscard]] std::vector<std::string> named() const;

 private:
  enum class Kind : std::uint8_t { moved, size, swapped, in_place_of, twice };
  struct Key {
    Kind kind;
    int first, second;  // ids; second −1 where there is none
    auto operator<=>(const Key&) const = default;
  };
  struct Vote {
    int age;        // fits since then that saw the tag
    double amount;  // m
  };
  struct Stray;
  [[nodiscard]] static std::vector<Stray> straysOf(std::span<const EyeCamera> eyes,
                                                   const TagLayout& layout,
                                                   std::span<const HeadSight> sights,
                                                   const HeadFit& fit);
  void age(std::span<const HeadSight> sights);
  void vote(const Key& key, double amount);
  [[nodiscard]] static std::string text(const Key& key, double amount, const TagLayout& layout);

  TagLayout layout_;
  std::map<Key, std::vector<Vote>> votes_;
};

}  // namespace slamscope::tracking
