// SPDX-License-Identifier: MIT
// What is stated wrongly of cameras and room, from the lab's pictures to what hmd says of it.
#include <gtest/gtest.h>

#include <algorithm>

#include "apps/lib/view/head_view.hpp"

namespace slamscope::apps {
namespace {

using tracking::RigCamera, tracking::MappedTag;

class HmdFaults : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    HmdOptions options;
    options.view.camera = "lab";
    options.view.fps = 8.0;
    setup_ = new StereoSetup(openStereo(options, std::nullopt));
    pairs_ = new std::vector<tracking::StereoFrame>;
    for (int k = 0; k < 20; ++k) pairs_->push_back(*setup_->source->next());
  }
  static void TearDownTestSuite() {
    delete pairs_;
    delete setup_;
  }

  /// What is said after the walk, of a rig and a room that are stated so.
  static std::vector<std::string> saidOf(const tracking::Rig& rig,
                                         const tracking::TagLayout& tags) {
    StereoSetup stated;
    stated.source = std::move(setup_->source);  // lent: nobody asks it for pictures
    stated.rig = rig;
    stated.tags = tags;
    HeadView head(stated, 30);
    for (const tracking::StereoFrame& pair : *pairs_) head.add(pair);
    setup_->source = std::move(stated.source);
    return head.problems();
  }
  static const tracking::Rig& rig() { return setup_->rig; }
  static const tracking::TagLayout& tags() { return setup_->tags; }

  static StereoSetup* setup_;
  static std::vector<tracking::StereoFrame>* pairs_;
};
StereoSetup* HmdFaults::setup_ = nullptr;
std::vector<tracking::StereoFrame>* HmdFaults::pairs_ = nullptr;

::testing::AssertionResult names(const std::vector<std::string>& said, const std::string& what) {
  std::string all;
  for (const std::string& one : said) {
    if (one.find(what) != std::string::npos) return ::testing::AssertionSuccess();
    all += "\n  " + one;
  }
  return ::testing::AssertionFailure() << "\"" << what << "\" is not among" << all;
}

TEST_F(HmdFaults, NothingIsSaidWhereAllIsAsStated) {
  EXPECT_EQ(saidOf(rig(), tags()), std::vector<std::string>{});
}

TEST_F(HmdFaults, FocalLengthIsNamed) {
  tracking::Rig wrong = rig();
  for (RigCamera& camera : wrong.cameras) camera.info.K.topLeftCorner<2, 2>() *= 1.04;
  EXPECT_TRUE(names(saidOf(wrong, tags()), "focal length of the left camera looks"));
}

TEST_F(HmdFaults, HalfAPixelIsNamed) {
  tracking::Rig wrong = rig();
  for (RigCamera& camera : wrong.cameras) camera.info.K.topRightCorner<2, 1>().array() += 0.5;
  EXPECT_TRUE(names(saidOf(wrong, tags()), "principal point of the left camera looks"));
}

TEST_F(HmdFaults, LensThatIsNotStatedIsNamed) {
  tracking::Rig wrong = rig();
  for (RigCamera& camera : wrong.cameras) std::ranges::fill(camera.info.D, 0.0);
  EXPECT_TRUE(names(saidOf(wrong, tags()), "left camera"));
}

TEST_F(HmdFaults, SizeOfAllTagsIsNamed) {
  tracking::TagLayout small = tags();
  for (MappedTag& tag : small.tags) tag.size_m *= 0.9;
  EXPECT_TRUE(names(saidOf(rig(), small), "tags look"));
}

TEST_F(HmdFaults, SwappedIdsAreNamed) {
  HeadView head(*setup_, 30);
  head.add(pairs_->front());
  const auto& seen = head.tracker().last();
  ASSERT_GE(seen.tags_used, 5);
  tracking::TagLayout swapped = tags();
  // Two that stand before the head when it begins: see defaultRoomTags.
  const auto at = [&](int id) { return std::ranges::find(swapped.tags, id, &MappedTag::id); };
  std::swap(at(6)->T_world_tag, at(7)->T_world_tag);
  EXPECT_TRUE(names(saidOf(rig(), swapped), "tags 6 and 7 are swapped in the layout"));
}

TEST_F(HmdFaults, MirroredPicturesAreNamed) {
  HeadView head(*setup_, 30);
  for (int k = 0; k < 12; ++k) {
    tracking::StereoFrame pair = (*pairs_)[static_cast<std::size_t>(k)];
    for (auto& eye : pair.eyes) {
      const std::vector<std::uint8_t> upright = eye->bgr;
      const auto width = static_cast<std::size_t>(eye->width);
      for (std::size_t i = 0; i < upright.size() / 3; ++i) {
        const std::size_t row = i / width, column = width - 1 - i % width;
        std::copy_n(&upright[3 * (row * width + column)], 3, &eye->bgr[3 * i]);
      }
    }
    head.add(pair);
  }
  EXPECT_TRUE(names(head.problems(), "left camera: the picture is mirrored"));
  EXPECT_TRUE(names(head.problems(), "right camera: the picture is mirrored"));
  EXPECT_EQ(head.state(), tracking::HeadState::searching);
}

}  // namespace
}  // namespace slamscope::apps
