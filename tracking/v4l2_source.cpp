// SPDX-License-Identifier: MIT
#include "tracking/v4l2_source.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <span>
#include <stdexcept>
#include <utility>

#include "tracking/codecs.hpp"
#include "tracking/frame_source.hpp"

namespace slamscope::tracking {
namespace {

constexpr std::uint32_t kBuffers = 4;
constexpr int kDamagedInARow = 20;

std::string nameOf(std::uint32_t fourcc) {
  std::string name;
  for (int i = 0; i < 4; ++i) name += static_cast<char>((fourcc >> (8 * i)) & 0xff);
  return name;
}

/// An open device: says its name in every error.
class Device {
 public:
  explicit Device(std::string name)
      : name_(std::move(name)), file_(::open(name_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {
    if (file_ >= 0) return;
    if (errno == ENOENT || errno == ENXIO || errno == ENODEV) fail("no such device");
    fail(std::string("can't be opened: ") + std::strerror(errno));
  }
  ~Device() { ::close(file_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(name_ + ": " + what);
  }
  /// 0, or the error number.
  template <typename T>
  [[nodiscard]] int ask(unsigned long request, T& argument) const {
    int result = 0;
    do result = ::ioctl(file_, request, &argument);
    while (result < 0 && errno == EINTR);
    return result < 0 ? errno : 0;
  }
  template <typename T>
  void require(unsigned long request, T& argument, const std::string& what) const {
    if (const int error = ask(request, argument)) {
      if (error == ENODEV) fail("unplugged");
      fail(what + ": " + std::strerror(error));
    }
  }
  void setControl(std::uint32_t id, int value, const std::string& what) const {
    v4l2_control control{.id = id, .value = value};
    require(VIDIOC_S_CTRL, control, "can't set " + what + " to " + std::to_string(value));
  }
  [[nodiscard]] int file() const { return file_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
  int file_;
};

/// A driver's buffer, mapped.
class Mapping {
 public:
  Mapping(const Device& device, std::uint32_t index) {
    v4l2_buffer buffer{};
    buffer.index = index;
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    device.require(VIDIOC_QUERYBUF, buffer, "can't ask for a buffer");
    void* start = ::mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED, device.file(),
                         buffer.m.offset);
    if (start == MAP_FAILED) device.fail("can't map a buffer");
    bytes_ = {static_cast<std::uint8_t*>(start), buffer.length};
  }
  ~Mapping() {
    if (!bytes_.empty()) ::munmap(bytes_.data(), bytes_.size());
  }
  Mapping(Mapping&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}
  Mapping& operator=(Mapping&&) = delete;

  [[nodiscard]] std::span<std::uint8_t> bytes() const { return bytes_; }

 private:
  std::span<std::uint8_t> bytes_;
};

class V4l2Source final : public FrameSource {
 public:
  V4l2Source(const std::string& name, const V4l2Options& options)
      : device_(name), options_(options) {
    v4l2_capability capability{};
    if (device_.ask(VIDIOC_QUERYCAP, capability) != 0) device_.fail("not a capture device");
    const std::uint32_t can = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0
                                  ? capability.device_caps
                                  : capability.capabilities;
    if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0 || (can & V4L2_CAP_STREAMING) == 0)
      device_.fail("not a capture device");
    setFormat();
    setRate();
    setControls();
    start();
  }
  ~V4l2Source() override {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    (void)device_.ask(VIDIOC_STREAMOFF, type);
  }

  std::optional<Frame> next() override {
    // A camera that starts up may send broken pictures: they are passed over, a few.
    for (int damaged = 0; damaged < kDamagedInARow; ++damaged) {
      v4l2_buffer buffer = newest();
      std::optional<Frame> frame = decode(buffer);
      enqueue(buffer);
      if (frame) return frame;
    }
    device_.fail("frames are damaged");
  }
  bool live() const override { return true; }

 private:
  void setFormat();
  void setRate() const;
  void setControls() const;
  void start();
  void waitForFrame() const;
  [[nodiscard]] v4l2_buffer newest() const;
  [[nodiscard]] std::optional<v4l2_buffer> dequeue() const;
  void enqueue(v4l2_buffer& buffer) const {
    device_.require(VIDIOC_QBUF, buffer, "can't queue a buffer");
  }
  [[nodiscard]] std::optional<Frame> decode(const v4l2_buffer& buffer) const;
  [[nodiscard]] std::optional<BgrPicture> toBgr(std::span<std::uint8_t> bytes) const;
  [[nodiscard]] std::chrono::nanoseconds stamp(const v4l2_buffer& buffer) const;

  Device device_;
  V4l2Options options_;
  v4l2_pix_format format_{};
  std::vector<Mapping> mappings_;
};

void V4l2Source::setFormat() {
  constexpr std::array<std::uint32_t, 3> kReadable = {V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_MJPEG,
                                                      V4L2_PIX_FMT_GREY};
  std::string offered;
  for (const std::uint32_t readable : kReadable) {
    if (!options_.pixel_format.empty() && options_.pixel_format != nameOf(readable)) continue;
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    format.fmt.pix.width = static_cast<std::uint32_t>(options_.width);
    format.fmt.pix.height = static_cast<std::uint32_t>(options_.height);
    format.fmt.pix.pixelformat = readable;
    format.fmt.pix.field = V4L2_FIELD_ANY;
    device_.require(VIDIOC_S_FMT, format, "can't set size and pixel format");
    format_ = format.fmt.pix;
    const bool fits = format_.width == static_cast<std::uint32_t>(options_.width) &&
                      format_.height == static_cast<std::uint32_t>(options_.height);
    if (format_.pixelformat == readable && fits) return;
    offered += (offered.empty() ? "" : ", ") + std::to_string(format_.width) + " x " +
               std::to_string(format_.height) + " " + nameOf(format_.pixelformat);
  }
  if (offered.empty())
    device_.fail("pixel format '" + options_.pixel_format + "', expected YUYV, MJPG or GREY");
  device_.fail("has no " + std::to_string(options_.width) + " x " +
               std::to_string(options_.height) +
               (options_.pixel_format.empty() ? "" : " " + options_.pixel_format) + "; it offers " +
               offered);
}

void V4l2Source::setRate() const {
  if (options_.fps <= 0) return;
  v4l2_streamparm rate{};
  rate.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  rate.parm.capture.timeperframe = {
      .numerator = 1000,
      .denominator = static_cast<std::uint32_t>(std::lround(1000 * options_.fps))};
  (void)device_.ask(VIDIOC_S_PARM, rate);  // taken as granted: a driver may know one rate only
}

void V4l2Source::setControls() const {
  if (options_.focus) {
    v4l2_control automatic{.id = V4L2_CID_FOCUS_AUTO, .value = 0};
    (void)device_.ask(VIDIOC_S_CTRL, automatic);  // some lenses have no automatic to switch off
    device_.setControl(V4L2_CID_FOCUS_ABSOLUTE, *options_.focus, "focus");
  }
  if (!options_.exposure) return;
  device_.setControl(V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL, "exposure mode");
  const auto hundred_us =
      static_cast<int>(std::lround(static_cast<double>(options_.exposure->count()) / 100));
  device_.setControl(V4L2_CID_EXPOSURE_ABSOLUTE, hundred_us, "exposure (in 0.1 ms)");
}

void V4l2Source::start() {
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  device_.require(VIDIOC_REQBUFS, request, "no buffers (is another program using it?)");
  for (std::uint32_t i = 0; i < request.count; ++i) {
    mappings_.emplace_back(device_, i);
    v4l2_buffer buffer{};
    buffer.index = i;
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    enqueue(buffer);
  }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  device_.require(VIDIOC_STREAMON, type, "can't start");
}

void V4l2Source::waitForFrame() const {
  pollfd wait{.fd = device_.file(), .events = POLLIN, .revents = 0};
  int ready = 0;
  do ready = ::poll(&wait, 1, static_cast<int>(options_.timeout.count()));
  while (ready < 0 && errno == EINTR);
  if (ready == 0) device_.fail("no frame for " + std::to_string(options_.timeout.count()) + " ms");
  if ((wait.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) device_.fail("unplugged");
}

std::optional<v4l2_buffer> V4l2Source::dequeue() const {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  const int error = device_.ask(VIDIOC_DQBUF, buffer);
  if (error == EAGAIN) return std::nullopt;
  if (error == ENODEV) device_.fail("unplugged");
  if (error != 0) device_.fail(std::string("can't read a frame: ") + std::strerror(error));
  return buffer;
}

v4l2_buffer V4l2Source::newest() const {
  std::optional<v4l2_buffer> newest;
  while (!newest) {
    waitForFrame();
    while (std::optional<v4l2_buffer> buffer = dequeue()) {
      if (newest) enqueue(*newest);
      newest = buffer;
    }
  }
  return *newest;
}

std::optional<BgrPicture> V4l2Source::toBgr(std::span<std::uint8_t> bytes) const {
  if (format_.pixelformat == V4L2_PIX_FMT_MJPEG) return codecs().decode(bytes);
  if (bytes.size() < static_cast<std::size_t>(format_.bytesperline) * format_.height)
    return std::nullopt;
  const auto width = static_cast<int>(format_.width), height = static_cast<int>(format_.height);
  BgrPicture picture{.width = width, .height = height, .bgr = {}};
  picture.bgr.resize(std::size_t{3} * format_.width * format_.height);
  cv::Mat bgr(height, width, CV_8UC3, picture.bgr.data());
  const bool grey = format_.pixelformat == V4L2_PIX_FMT_GREY;
  const cv::Mat raw(height, width, grey ? CV_8UC1 : CV_8UC2, bytes.data(), format_.bytesperline);
  cv::cvtColor(raw, bgr, grey ? cv::COLOR_GRAY2BGR : cv::COLOR_YUV2BGR_YUYV);
  return picture;
}

std::chrono::nanoseconds V4l2Source::stamp(const v4l2_buffer& buffer) const {
  const bool start = (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  return midExposure(std::chrono::seconds(buffer.timestamp.tv_sec) +
                         std::chrono::microseconds(buffer.timestamp.tv_usec),
                     start ? StampPoint::start_of_exposure : StampPoint::end_of_frame,
                     options_.exposure.value_or(std::chrono::microseconds(0)), options_.readout);
}

std::optional<Frame> V4l2Source::decode(const v4l2_buffer& buffer) const {
  if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0) return std::nullopt;  // as the driver knows
  const std::span<std::uint8_t> bytes = mappings_.at(buffer.index).bytes();
  std::optional<BgrPicture> picture =
      toBgr(bytes.first(std::min<std::size_t>(buffer.bytesused, bytes.size())));
  if (!picture || picture->width != options_.width || picture->height != options_.height)
    return std::nullopt;
  return Frame{.time = stamp(buffer),
               .sequence = buffer.sequence,
               .source = device_.name(),
               .width = picture->width,
               .height = picture->height,
               .bgr = std::move(picture->bgr)};
}

}  // namespace

std::chrono::nanoseconds midExposure(std::chrono::nanoseconds stamp, StampPoint point,
                                     std::chrono::nanoseconds exposure,
                                     std::chrono::nanoseconds readout) {
  const std::chrono::nanoseconds half = (exposure + readout) / 2;
  return point == StampPoint::start_of_exposure ? stamp + half : stamp - half;
}

std::unique_ptr<FrameSource> openV4l2(const std::string& device, const V4l2Options& options) {
  return std::make_unique<V4l2Source>(device, options);
}

}  // namespace slamscope::tracking
