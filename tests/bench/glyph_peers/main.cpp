// SPDX-License-Identifier: MIT
// slamscope_glyph_peers: a picture of all pairs of n features, drawn and read back, by us and,
// where it is installed, by VTK: medians of wall time, all in one run. Ours computes the pairs from
// the covariance on the way; VTK is given its glyphs ready made. Prints the table of
// tests/bench/README.md. `slamscope_glyph_peers PREFIX` writes what was drawn to PREFIX-*.ppm, too.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "apps/lib/freed_memory.hpp"
#include "engine/render/offscreen.hpp"
#include "tests/bench/pair_map.hpp"
#include "tests/bench/timing.hpp"
#ifdef SLAMSCOPE_VTK
#include "tests/bench/glyph_peers/vtk_glyphs.hpp"
#endif

namespace slamscope::engine {
namespace {

constexpr std::array kCounts{15, 100, 500, 1000};
constexpr double kBudget = 0.35;  // s a measurement

struct Case {
  int n;
  std::size_t eyes;
  bool changing;

  [[nodiscard]] std::vector<PairGlyphs> frames() const {
    std::vector<PairGlyphs> all{mapOf(n, 1)};
    if (changing) all.push_back(mapOf(n, 2));
    return all;
  }
};

/// How much of a picture is not black.
double covered(std::span<const std::uint8_t> rgba) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < rgba.size(); i += 4) count += rgba[i] > 0 ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(rgba.size() / 4);
}

void writePicture(const std::string& path, std::size_t width, std::span<const std::uint8_t> rgba) {
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << width << ' ' << rgba.size() / 4 / width << "\n255\n";
  for (std::size_t i = 0; i < rgba.size(); ++i) {
    if (i % 4 < 3) file.put(static_cast<char>(rgba[i]));
  }
}

struct Result {
  double ms = 0.0;
  double covered = 0.0;
};

class Measurement {
 public:
  explicit Measurement(std::string prefix) : prefix_(std::move(prefix)) {}

  Result ours(const Case& c) const {
    const auto eyes = aboveFloor(c.eyes);
    std::vector<Scene> scenes;
    for (const PairGlyphs& frame : c.frames()) {
      scenes.emplace_back().pairs = std::make_shared<PairGlyphs>(frame);
    }
    Offscreen offscreen(std::make_shared<Gpu>(), kBenchCamera.width, kBenchCamera.height,
                        static_cast<int>(c.eyes));
    std::vector<Image> pictures;
    const double seconds = medianSeconds(
        [&](std::size_t k) { offscreen.draw(eyes, scenes[k % scenes.size()], {}, pictures); },
        kBudget);
    return {1e3 * seconds, shown("ours", c, 1, pictures.front().rgba)};
  }

#ifdef SLAMSCOPE_VTK
  Result vtk(VtkGlyphs::Way way, const Case& c) const {
    VtkGlyphs glyphs(way, aboveFloor(c.eyes), c.frames());
    const double seconds = medianSeconds([&](std::size_t k) { glyphs.draw(k); }, kBudget);
    return {1e3 * seconds, shown("vtk" + std::to_string(static_cast<int>(way)), c, c.eyes,
                                 glyphs.draw(c.frames().size() - 1))};
  }
#endif

 private:
  double shown(const std::string& name, const Case& c, std::size_t eyes,
               std::span<const std::uint8_t> rgba) const {
    if (!prefix_.empty() && c.changing) {
      writePicture(
          prefix_ + "-" + name + "-" + std::to_string(c.n) + "-" + std::to_string(c.eyes) + ".ppm",
          eyes * kBenchCamera.width, rgba);
    }
    return covered(rgba);
  }

  std::string prefix_;
};

void printRow(const std::string& name, const std::vector<double>& cells, int digits) {
  std::printf("| %s |", name.c_str());
  for (const double cell : cells) std::printf(" %.*f |", digits, cell);
  for (std::size_t i = cells.size(); i < kCounts.size(); ++i) std::printf(" |");
  std::printf("\n");
  std::fflush(stdout);
}

std::vector<double> all(std::size_t eyes, bool changing, int most,
                        const std::function<double(const Case&)>& measure) {
  std::vector<double> cells;
  for (const int n : kCounts) {
    if (n <= most) cells.push_back(measure({n, eyes, changing}));
  }
  return cells;
}

#ifdef SLAMSCOPE_VTK
struct Peer {
  VtkGlyphs::Way way;
  const char* name;
  int most;  // features; with more a frame takes seconds
};
constexpr std::array<Peer, 5> kPeers{{
    {VtkGlyphs::Way::spheres, "VTK, sphere impostors", 1000},
    {VtkGlyphs::Way::gaussians, "VTK, gaussian impostors", 1000},
    {VtkGlyphs::Way::coarse_meshes, "VTK, spheres of 3 × 3", 500},
    {VtkGlyphs::Way::meshes, "VTK, spheres of 8 × 8", 100},
    {VtkGlyphs::Way::tensors, "VTK, tensor glyphs", 100},
}};

void printPeers(const Measurement& measurement, std::size_t eyes, bool changing,
                const std::vector<Result>& ours) {
  for (const Peer& peer : kPeers) {
    std::vector<double> ratios;
    const auto cells = all(eyes, changing, peer.most, [&](const Case& c) {
      const Result result = measurement.vtk(peer.way, c);
      const Result& beside = ours[ratios.size()];
      if (result.covered < 0.25 * beside.covered || result.covered > 2.0 * beside.covered) {
        std::printf("%s covers %.3f of the picture, ours %.3f: not compared\n", peer.name,
                    result.covered, beside.covered);
        std::exit(1);
      }
      ratios.push_back(result.ms / beside.ms);
      return result.ms;
    });
    printRow(peer.name, cells, 1);
    printRow("its time over ours", ratios, 2);
  }
}
#endif

void printBlock(const Measurement& measurement, std::size_t eyes, bool changing) {
  std::printf("| **%s, %s** | | | | |\n", eyes == 1 ? "one view" : "two views",
              changing ? "P changing" : "P as before");
  std::vector<Result> ours;
  const auto cells = all(eyes, changing, kCounts.back(), [&](const Case& c) {
    ours.push_back(measurement.ours(c));
    return ours.back().ms;
  });
  printRow("ours", cells, 1);
#ifdef SLAMSCOPE_VTK
  printPeers(measurement, eyes, changing, ours);
#endif
}

}  // namespace
}  // namespace slamscope::engine

int main(int argc, char** argv) {
  using namespace slamscope;
  using namespace slamscope::engine;
  if (argc > 2 || (argc == 2 && argv[1][0] == '-')) {
    std::puts("usage: slamscope_glyph_peers [PREFIX]    each last picture to PREFIX-….ppm");
    return 2;
  }
  apps::keepFreedMemory();
  const Measurement measurement(argc > 1 ? argv[1] : "");
  std::printf(
      "load before: %.1f\n\n| ms | n = 15 | 100 | 500 | 1000 |\n| --- | --- | --- | --- | --- |\n",
      machineLoad());
  for (const bool changing : {true, false}) {
    for (const std::size_t eyes : {1, 2}) printBlock(measurement, eyes, changing);
  }
  std::printf("\nload after: %.1f\n", machineLoad());
}
