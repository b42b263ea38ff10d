// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "engine/gpu/compute.hpp"
#include "engine/render/shader_code.hpp"
#include "shaders/interop/frame.h"
#include "shaders/interop/glyphs.h"
#include "shaders/interop/groups.h"
#include "shaders/interop/pairs.h"

namespace slamscope::engine {
namespace {

/// As in shaders/interop_echo.comp.
struct Everything {
  interop::FrameData frame;
  interop::GroupPairData groups;
  interop::EllipsoidGlyph ellipsoid;
  interop::ConeGlyph cone;
  interop::ArrowGlyph arrow;
  interop::SegmentGlyph segment;
  interop::RectGlyph rect;
  interop::LetterGlyph letter;
  interop::PairsData pairs;
  interop::PairsCounts counts;
};

/// Gives every field its own number, in the order of declaration, and lists them.
class Counter {
 public:
  void operator()(float& x) { x = next(); }
  void operator()(interop::uint& x) { x = static_cast<interop::uint>(next()); }
  template <std::size_t N>
  void operator()(std::array<float, N>& x) {
    for (float& each : x) each = next();
  }
  template <typename... Fields>
  void all(Fields&... fields) {
    ((*this)(fields), ...);
  }
  void operator()(interop::ViewData& v) {
    all(v.R_eye_shared, v.t_eye_shared, v.up_eye, v.focal, v.principal, v.skew, v.size,
        v.background);
  }
  void operator()(Everything& e) {
    all(e.frame.views[0], e.frame.views[1], e.frame.near, e.frame.border_px);
    all(e.groups.least_i, e.groups.least_j, e.groups.greatest_i, e.groups.greatest_j,
        e.groups.mean);
    all(e.ellipsoid.centre, e.ellipsoid.axis0, e.ellipsoid.axis1, e.ellipsoid.axis2,
        e.ellipsoid.colour);
    all(e.cone.tip, e.cone.axis, e.cone.height, e.cone.radius, e.cone.colour);
    all(e.arrow.origin, e.arrow.along, e.arrow.across, e.arrow.colour);
    all(e.segment.previous, e.segment.from, e.segment.to, e.segment.next, e.segment.width_px,
        e.segment.colour);
    all(e.rect.min_px, e.rect.max_px, e.rect.colour);
    all(e.letter.anchor, e.letter.offset_px, e.letter.min_px, e.letter.max_px, e.letter.uv,
        e.letter.colour, e.letter.anchored, e.letter.halo);
    interop::PairsData& p = e.pairs;
    all(p.points, p.pairs, p.views, p.law, p.gain, p.unit, p.origin, p.ex, p.ey, p.ez, p.scale,
        p.colour, p.conditions, p.least_area, p.most, p.run, p.most_by);
    interop::PairsCounts& n = e.counts;
    all(n.chosen, n.drawn, n.not_finite, n.large, n.vertices, n.instances, n.first_vertex,
        n.first_instance, n.least_key, n.rank, n.greatest_key);
  }
  [[nodiscard]] const std::vector<float>& numbers() const { return numbers_; }

 private:
  float next() {
    numbers_.push_back(static_cast<float>(numbers_.size() + 1));
    return numbers_.back();
  }
  std::vector<float> numbers_;
};

std::vector<float> echoed(const Gpu& gpu, std::span<const std::byte> input, std::size_t count) {
  const auto bytes = gpu::runCompute(gpu, shaderCode("interop_echo_comp"), input, count * 4);
  std::vector<float> numbers(count);
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

TEST(SharedStructs, HaveTheSameOffsetsInCppAndGlsl) {
  const Gpu gpu({.validation = true});
  std::array<Everything, 2> values = {};
  Counter count;
  count.all(values[0], values[1]);
  const auto input = std::as_bytes(std::span(values));
  EXPECT_EQ(count.numbers().size() * 4, sizeof(values)) << "a field is not listed in this test";
  EXPECT_EQ(echoed(gpu, input, count.numbers().size()), count.numbers());
  // Twin: one float of padding.
  std::vector<std::byte> padded(4);
  padded.insert(padded.end(), input.begin(), input.end());
  EXPECT_NE(echoed(gpu, padded, count.numbers().size()), count.numbers());
  EXPECT_TRUE(gpu.validationMessages().empty()) << gpu.validationMessages().front();
}

TEST(Validation, CollectsMessagesWhereSomethingIsWrong) {
  // The twin of all tests that want validation silent: more groups than any lavapipe allows.
  const Gpu gpu({.device = "llvmpipe", .validation = true});
  const std::vector<std::byte> input(2 * sizeof(Everything));
  (void)gpu::runCompute(gpu, shaderCode("interop_echo_comp"), input, 4096, 70000);
  EXPECT_FALSE(gpu.validationMessages().empty());
}

/// Exit status of spirv-val for these words.
int validate(std::span<const std::uint32_t> words) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("slamscope_shader_" + std::to_string(getpid()) + ".spv");
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(words.data()),
             static_cast<std::streamsize>(words.size_bytes()));
  const std::string command = "spirv-val --target-env vulkan1.3 --scalar-block-layout " +
                              file.string() + " >/dev/null 2>&1";
  const int status = std::system(command.c_str());
  std::filesystem::remove(file);
  return status;
}

TEST(Shaders, AreValidSpirV) {
  EXPECT_GE(allShaders().size(), 15U);
  for (const ShaderCode& shader : allShaders()) EXPECT_EQ(validate(shader.words), 0) << shader.name;
  std::vector<std::uint32_t> broken(allShaders()[0].words.begin(), allShaders()[0].words.end());
  broken.resize(broken.size() - 2);
  EXPECT_NE(validate(broken), 0);
}

}  // namespace
}  // namespace slamscope::engine
