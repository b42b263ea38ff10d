// SPDX-License-Identifier: MIT
#include "tracking/tag_layout.hpp"

#include <algorithm>

#include "tracking/yaml_fields.hpp"

namespace slamscope::tracking {

const MappedTag* TagLayout::find(int id) const {
  const auto tag =
      std::find_if(tags.begin(), tags.end(), [id](const MappedTag& t) { return t.id == id; });
  return tag == tags.end() ? nullptr : &*tag;
}

TagLayout readTagLayout(const std::filesystem::path& file) {
  const YamlField root = YamlField::open(file);
  root.allowOnly({"family", "size_m", "tags"});
  TagLayout layout;
  if (const auto field = root.find("family")) layout.family = field->text();
  const auto common_size = root.find("size_m");
  const YamlField list = root.at("tags");
  for (const YamlField& entry : list.list()) {
    entry.allowOnly({"id", "size_m", "T_world_tag", "position_m"});
    MappedTag tag;
    tag.id = entry.at("id").integer();
    if (layout.find(tag.id))
      entry.at("id").reject("tag " + std::to_string(tag.id) + " is given twice");
    const auto size = entry.find("size_m");
    tag.size_m = size          ? size->positive()
                 : common_size ? common_size->positive()
                               : entry.at("size_m").positive();
    if (const auto position = entry.find("position_m")) {
      if (entry.find("T_world_tag")) entry.reject("expected either T_world_tag or position_m");
      tag.T_world_tag.translation() = position->vector(3);
    } else {
      tag.T_world_tag = entry.at("T_world_tag").pose();
    }
    layout.tags.push_back(tag);
  }
  if (layout.tags.empty()) list.reject("expected at least one tag");
  return layout;
}

void writeTagLayout(const TagLayout& layout, const std::filesystem::path& file) {
  std::string text = "family: " + layout.family + "\ntags:\n";
  for (const MappedTag& tag : layout.tags) {
    text += "  - id: " + std::to_string(tag.id) + "\n    size_m: " + yamlNumber(tag.size_m) +
            "\n    T_world_tag: " + yamlPose(tag.T_world_tag) + "\n";
  }
  writeText(file, text);
}

}  // namespace slamscope::tracking
