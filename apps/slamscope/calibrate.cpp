// SPDX-License-Identifier: MIT
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "apps/lib/progress.hpp"
#include "apps/slamscope/verbs.hpp"
#include "tracking/camera_calibration.hpp"
#include "tracking/frame_source.hpp"
#include "tracking/room_calibration.hpp"
#include "tracking/sheet.hpp"
#include "tracking/stereo_source.hpp"

namespace slamscope::apps {
namespace {

using tracking::Board, tracking::BoardSight;

struct CalibrateFlags {
  tracking::SheetOptions sheet;
  std::string kind = "tags", paper = "a4";
  // Pictures
  std::vector<std::string> pictures;
  std::string right;
  std::uint64_t every = 1;
  double fps = 0;
  // What is looked at
  std::string board = "chessboard";
  int columns = 6, rows = 8, first_id = 0;
  double size = 0, spacing = 0.3;
  std::string family = "36h11";
  // The room
  std::string rig, camera_info;
  std::vector<std::string> sizes;
  int gauge = -1;
  std::vector<int> floor;
  std::filesystem::path output;

  [[nodiscard]] Board asBoard() const {
    const bool chess = board == "chessboard";
    return {chess ? Board::Kind::chessboard : Board::Kind::april_grid,
            columns,
            rows,
            size,
            spacing,
            first_id,
            family};
  }
  [[nodiscard]] tracking::FrameSourceOptions sourceOptions() const {
    tracking::FrameSourceOptions options;
    options.fps = fps;
    return options;
  }
};

void setPaper(const std::string& name, tracking::SheetOptions& sheet) {
  if (name == "a3") {
    sheet.paper_width_mm = 297;
    sheet.paper_height_mm = 420;
  } else if (name == "letter") {
    sheet.paper_width_mm = 215.9;
    sheet.paper_height_mm = 279.4;
  }
}

void runSheet(CalibrateFlags& flags) {
  tracking::SheetOptions& sheet = flags.sheet;
  sheet.kind = flags.kind == "tags"         ? tracking::SheetKind::tags
               : flags.kind == "april-grid" ? tracking::SheetKind::april_grid
                                            : tracking::SheetKind::chessboard;
  setPaper(flags.paper, sheet);
  tracking::writeSheet(sheet, flags.output);
  spdlog::info("wrote {}: print it without scaling, and measure the bar", flags.output.string());
}

/// Calls `each` with every picture of all sources, one in `every`.
template <typename Each>
void forPictures(const CalibrateFlags& flags, const std::vector<std::string>& sources,
                 const Each& each) {
  Progress progress("looking");
  std::uint64_t count = 0;
  for (const std::string& spec : sources) {
    const auto source = tracking::openFrameSource(spec, flags.sourceOptions());
    while (const auto frame = source->next()) {
      if (count++ % flags.every != 0) continue;
      each(*frame);
      progress.show(std::to_string(count) + " pictures");
    }
  }
}

struct Seen {
  std::vector<std::optional<BoardSight>> sights;  // by picture
  int width = 0, height = 0;
};

Seen look(const CalibrateFlags& flags, const std::vector<std::string>& sources) {
  Seen seen;
  forPictures(flags, sources, [&](const tracking::Frame& frame) {
    if (seen.width != 0 && (seen.width != frame.width || seen.height != frame.height)) {
      throw std::runtime_error(frame.source + ": another size than the pictures before");
    }
    seen.width = frame.width;
    seen.height = frame.height;
    seen.sights.push_back(tracking::findBoard(frame, flags.asBoard()));
  });
  return seen;
}

void tell(const char* what, const tracking::CameraCalibration& result) {
  spdlog::info(
      "{}: f {:.1f} ± {:.1f} px, residual {:.3f} px over {} pictures, points in {:.0f} % of the "
      "picture",
      what, result.info.K(0, 0), result.sigma_focal_px, result.residual_px,
      result.picture_px.size(), 100 * result.coverage);
  for (std::size_t i = 0; i < result.picture_px.size(); ++i) {
    spdlog::info("  picture {:3}: {:.3f} px", i, result.picture_px[i]);
  }
  for (const std::string& hint : result.hints) spdlog::warn("{}: {}", what, hint);
}

void runCamera(const CalibrateFlags& flags) {
  const Seen seen = look(flags, flags.pictures);
  std::vector<BoardSight> sights;
  for (const auto& sight : seen.sights) {
    if (sight) sights.push_back(*sight);
  }
  spdlog::info("the board is in {} of {} pictures", sights.size(), seen.sights.size());
  const auto result = tracking::calibrateCamera(sights, seen.width, seen.height);
  tell("camera", result);
  tracking::writeCameraInfo(result.info, flags.output);
  spdlog::info("wrote {}", flags.output.string());
}

void runStereo(const CalibrateFlags& flags) {
  if (flags.pictures.size() != 2) {
    throw std::runtime_error(
        "calibrate stereo: expected two sources, the left and the right camera's");
  }
  const Seen left = look(flags, {flags.pictures[0]}), right = look(flags, {flags.pictures[1]});
  if (left.width != right.width || left.height != right.height) {
    throw std::runtime_error("calibrate stereo: the two cameras' pictures differ in size");
  }
  std::vector<BoardSight> a, b;
  for (std::size_t i = 0; i < std::min(left.sights.size(), right.sights.size()); ++i) {
    if (!left.sights[i] || !right.sights[i]) continue;
    a.push_back(*left.sights[i]);
    b.push_back(*right.sights[i]);
  }
  spdlog::info("both see the board in {} of {} pairs", a.size(),
               std::min(left.sights.size(), right.sights.size()));
  const auto result = tracking::calibrateStereo(a, b, left.width, left.height);
  tell("left camera", result.left);
  tell("right camera", result.right);
  spdlog::info("stereo: baseline {:.2f} mm, residual {:.3f} px", 1e3 * result.rig.baseline(),
               result.residual_px);
  tracking::writeRig(result.rig, flags.output);
  spdlog::info("wrote {}", flags.output.string());
}

std::map<int, double> readSizes(const std::vector<std::string>& texts) {
  std::map<int, double> sizes;
  for (const std::string& text : texts) {
    try {
      const std::size_t at = text.find('=');
      if (at == std::string::npos) throw std::invalid_argument(text);
      const double size = std::stod(text.substr(at + 1));
      if (!(size > 0)) throw std::invalid_argument(text);
      sizes[std::stoi(text.substr(0, at))] = size;
    } catch (const std::logic_error&) {
      throw std::runtime_error("--tag-size: \"" + text + "\": expected ID=METRES, as 3=0.16");
    }
  }
  return sizes;
}

/// Pictures of the walk: by the rig's cameras, or by one.
std::vector<tracking::CameraModel> walkCameras(const CalibrateFlags& flags) {
  std::vector<tracking::CameraModel> cameras;
  if (!flags.rig.empty()) {
    for (const auto& camera : tracking::readRig(flags.rig).cameras)
      cameras.emplace_back(camera.info);
  } else if (!flags.camera_info.empty()) {
    cameras.emplace_back(tracking::readCameraInfo(flags.camera_info));
  } else {
    throw std::runtime_error("calibrate tags: expected --rig or --camera-info");
  }
  return cameras;
}

void runTags(const CalibrateFlags& flags) {
  const auto cameras = walkCameras(flags);
  if (flags.pictures.size() > cameras.size()) {
    throw std::runtime_error("calibrate tags: more sources than cameras");
  }
  std::vector<tracking::RoomPicture> pictures;
  for (std::size_t i = 0; i < flags.pictures.size(); ++i) {
    tracking::TagDetectorOptions options;
    options.family = flags.family;
    options.camera = cameras[i];
    tracking::TagDetector detector(options);
    forPictures(flags, {flags.pictures[i]}, [&](const tracking::Frame& frame) {
      tracking::requireSize(cameras[i].info(), frame.width, frame.height);
      pictures.push_back({i, detector.detect(frame)});
    });
  }
  tracking::RoomCalibrationOptions options;
  options.size_m = flags.size;
  options.sizes = readSizes(flags.sizes);
  if (flags.gauge >= 0) options.gauge = flags.gauge;
  options.floor = flags.floor;
  options.family = flags.family;
  const auto result = tracking::calibrateRoom(cameras, pictures, options);
  for (std::size_t i = 0; i < result.picture_px.size(); ++i) {
    if (result.picture_px[i]) spdlog::info("picture {:3}: {:.3f} px", i, *result.picture_px[i]);
  }
  for (const auto& tag : result.tags) {
    spdlog::info("tag {:3}: {:3} pictures, residual {:.3f} px", tag.id, tag.pictures,
                 tag.residual_px);
  }
  for (const std::string& hint : result.hints) spdlog::warn("{}", hint);
  spdlog::info("{} tags, residual {:.3f} px", result.layout.tags.size(), result.residual_px);
  if (flags.floor.empty()) {
    spdlog::warn("no --floor tags: the world is the gauge tag's frame, and z need not point up");
  } else {
    spdlog::info("floor tags are {:.1f} mm off their plane", 1e3 * result.floor_m);
  }
  tracking::writeTagLayout(result.layout, flags.output);
  spdlog::info("wrote {}", flags.output.string());
}

void addSheet(CLI::App& calibrate, CalibrateFlags& flags) {
  CLI::App* verb = calibrate.add_subcommand("sheet", "a PDF, true to scale, of tags or a board");
  verb->footer(
      "Example: slamscope calibrate sheet --kind tags --first 100 --count 8 --size-mm 120 -o "
      "tags.pdf");
  verb->add_option("--kind", flags.kind, "tags, april-grid or chessboard")
      ->check(CLI::IsMember({"tags", "april-grid", "chessboard"}));
  verb->add_option("--paper", flags.paper, "a4, a3 or letter")
      ->check(CLI::IsMember({"a4", "a3", "letter"}));
  verb->add_option("--family", flags.sheet.family, "of tags");
  verb->add_option("--first", flags.sheet.first_id, "id of the first tag")
      ->check(CLI::NonNegativeNumber);
  verb->add_option("--count", flags.sheet.count, "tags")->check(CLI::PositiveNumber);
  verb->add_option("--size-mm", flags.sheet.size_mm, "side of a tag's black square, or of a square")
      ->check(CLI::PositiveNumber);
  verb->add_option("--columns", flags.sheet.columns, "tags, or inner corners")
      ->check(CLI::PositiveNumber);
  verb->add_option("--rows", flags.sheet.rows, "tags, or inner corners")
      ->check(CLI::PositiveNumber);
  verb->add_option("--spacing", flags.sheet.spacing,
                   "gap between the tags of a grid, parts of their size")
      ->check(CLI::PositiveNumber);
  verb->add_option("-o,--output", flags.output, "PDF")->required();
  verb->callback([&flags] { runSheet(flags); });
}

void addPictures(CLI::App& verb, CalibrateFlags& flags, const char* what) {
  verb.add_option("pictures", flags.pictures, what)->required();
  verb.add_option("--every", flags.every, "take one picture in so many")
      ->check(CLI::PositiveNumber);
  verb.add_option("-o,--output", flags.output, "YAML")->required();
}

void addBoard(CLI::App& verb, CalibrateFlags& flags) {
  verb.add_option("--board", flags.board, "chessboard or april-grid")
      ->check(CLI::IsMember({"chessboard", "april-grid"}));
  verb.add_option("--columns", flags.columns, "inner corners, or tags")->check(CLI::PositiveNumber);
  verb.add_option("--rows", flags.rows, "inner corners, or tags")->check(CLI::PositiveNumber);
  verb.add_option("--size", flags.size, "side of a square, or of a tag's black square, m")
      ->required()
      ->check(CLI::PositiveNumber);
  verb.add_option("--spacing", flags.spacing,
                  "gap between the tags of a grid, parts of their size");
  verb.add_option("--first", flags.first_id, "id of a grid's first tag");
}

}  // namespace

void addCalibrate(CLI::App& program) {
  const auto flags = std::make_shared<CalibrateFlags>();
  CLI::App* verb = program.add_subcommand(
      "calibrate", "what hmd and monitor need to know: sheets to print, cameras, the room's tags");
  verb->footer(
      "Examples:\n"
      "  slamscope calibrate sheet --kind chessboard --size-mm 25 -o board.pdf\n"
      "  slamscope calibrate camera pictures/ --size 0.025 -o camera.yaml\n"
      "  slamscope calibrate stereo left/ right/ --size 0.025 -o rig.yaml\n"
      "  slamscope calibrate tags walk.mp4 --camera-info camera.yaml --size 0.16 --floor "
      "100,101,102 \\\n"
      "                           -o tags.yaml");
  verb->require_subcommand(1);
  addSheet(*verb, *flags);
  CLI::App* camera = verb->add_subcommand("camera", "intrinsics from pictures of a board");
  addPictures(*camera, *flags, "directories, videos or pictures of one camera");
  addBoard(*camera, *flags);
  camera->callback([flags] { runCamera(*flags); });
  CLI::App* stereo = verb->add_subcommand("stereo", "two cameras and how they stand to each other");
  addPictures(*stereo, *flags, "the left camera's pictures, the right one's");
  addBoard(*stereo, *flags);
  stereo->callback([flags] { runStereo(*flags); });
  CLI::App* tags =
      verb->add_subcommand("tags", "where the room's tags are, from a walk through it");
  addPictures(*tags, *flags, "the walk, a source for each camera");
  tags->add_option("--camera-info", flags->camera_info, "the camera's YAML");
  tags->add_option("--rig", flags->rig, "or the rig's");
  tags->add_option("--family", flags->family, "of the tags");
  tags->add_option("--size", flags->size, "side of the tags' black square, m");
  tags->add_option("--tag-size", flags->sizes, "ID=METRES for tags of another size")
      ->delimiter(',');
  tags->add_option("--gauge", flags->gauge, "tag that fixes the world; default: the one seen most");
  tags->add_option("--floor", flags->floor, "tags that lie on the floor")->delimiter(',');
  tags->callback([flags] { runTags(*flags); });
}

}  // namespace slamscope::apps
