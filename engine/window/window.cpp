// SPDX-License-Identifier: MIT
#include "engine/window/window.hpp"

#include <chrono>
#include <deque>
#include <stdexcept>
#include <utility>

#include "engine/gpu/core.hpp"
#include "engine/render/frame.hpp"
#include "engine/window/glfw_window.hpp"
#include "engine/window/picture_upload.hpp"
#include "engine/window/presenter.hpp"

namespace slamscope::engine {

using Clock = std::chrono::steady_clock;

// Destroyed from the last to the first: the presenter, which waits until the device has read the
// last picture, then the pictures, the window, the device.
struct Window::Parts {
  Parts(std::shared_ptr<Gpu> the_gpu, const WindowOptions& options)
      : gpu(std::move(the_gpu)),
        window(options),
        upload(gpu->core()),
        presenter(gpu->core(), window, options.low_latency) {}

  std::shared_ptr<Gpu> gpu;
  GlfwWindow window;
  PictureUpload upload;
  std::unique_ptr<Frame> frame;
  Presenter presenter;
  Eigen::Vector2i picture_px = Eigen::Vector2i::Zero();
  int views = 0;
  std::deque<Clock::time_point> shown;
  FrameStats stats;

  /// The frame of the views' size and number.
  Frame& frameFor(std::span<const View> views_now) {
    if (views_now.empty()) throw std::invalid_argument("there is no view to show");
    const Pinhole& camera = views_now.front().camera;
    if (frame) {
      const gpu::DeviceImage& colour = frame->colour();
      if (colour.extent() == vk::Extent2D{static_cast<std::uint32_t>(camera.width),
                                          static_cast<std::uint32_t>(camera.height)} &&
          colour.layers() == views_now.size()) {
        return *frame;
      }
    }
    frame.reset();
    frame = std::make_unique<Frame>(gpu->core(), camera.width, camera.height,
                                    static_cast<int>(views_now.size()));
    return *frame;
  }

  void present(const gpu::DeviceImage& picture) {
    picture_px = {static_cast<int>(picture.extent().width),
                  static_cast<int>(picture.extent().height)};
    views = static_cast<int>(picture.layers());
    if (presenter.present(picture)) shown.push_back(Clock::now());
  }

  void addClick(const RawClick& raw, std::vector<Click>& clicks) const {
    if (views == 0) return;  // nothing was shown yet
    const Eigen::Vector2d point = raw.point.cwiseProduct(window.pxPerPoint());
    if (const auto place = pictureAt(presenter.box(), picture_px, views, point)) {
      clicks.push_back(
          {.picture_px = place->px, .view = place->view, .button = raw.button, .shift = raw.shift});
    }
  }
};

std::vector<std::string> windowInstanceExtensions() {
  return GlfwLibrary::get().instanceExtensions();
}

Window::Window(std::shared_ptr<Gpu> gpu, const WindowOptions& options)
    : parts_(std::make_unique<Parts>(std::move(gpu), options)) {}

Window::~Window() = default;

bool Window::open() const {
  return !parts_->window.closed();
}

Input Window::poll() {
  GlfwWindow::Events events = parts_->window.poll();
  Input input{.keys = std::move(events.keys), .clicks = {}};
  for (const RawClick& raw : events.clicks) parts_->addClick(raw, input.clicks);
  return input;
}

void Window::show(std::span<const View> views, const Scene& scene, const RenderOptions& options) {
  if (parts_->window.minimised()) return;
  parts_->presenter.wait();
  Frame& frame = parts_->frameFor(views);
  (void)frame.record(views, scene, options);
  frame.submit();
  parts_->present(frame.colour());
  frame.wait();
  parts_->stats = frame.stats();
}

void Window::show(std::span<const Image> pictures) {
  if (parts_->window.minimised()) return;
  parts_->presenter.wait();
  parts_->present(parts_->upload.upload(pictures));
}

const FrameStats& Window::lastStats() const {
  return parts_->stats;
}

double Window::framesPerSecond() const {
  auto& shown = parts_->shown;
  const auto now = Clock::now();
  while (!shown.empty() && now - shown.front() > std::chrono::seconds(1)) shown.pop_front();
  if (shown.size() < 2) return static_cast<double>(shown.size());
  const std::chrono::duration<double> span = shown.back() - shown.front();
  return static_cast<double>(shown.size() - 1) / span.count();
}

void Window::setTitle(const std::string& title) {
  parts_->window.setTitle(title);
}
void Window::resize(int width, int height) {
  parts_->window.resize(width, height);
}
void Window::rebuild() {
  parts_->presenter.rebuild();
}

}  // namespace slamscope::engine
