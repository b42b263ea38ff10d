// SPDX-License-Identifier: MIT
// The calls that this program's own definitions take before the C library's.
#include "tests/v4l2/fake_camera.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <deque>
#include <mutex>

namespace slamscope::testing {
namespace {

/// One open file of a camera: what the driver keeps of it.
struct Handle {
  FakeCamera* camera;
  std::uint32_t format = 0;
  std::size_t buffer_bytes = 0;
  std::uint32_t buffers = 0;
  bool streams = false;
  bool was_unplugged = false;  ///< stays so when the camera comes back
  std::deque<std::uint32_t> queued, filled;
  std::map<std::uint32_t, v4l2_buffer> content;  ///< of filled ones
};

std::recursive_mutex mutex;  // NOLINT: the device tree of this process
std::map<std::string, FakeCamera> cameras;
std::map<int, Handle> handles;

template <typename Function>
Function theirs(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

int failWith(int error) {
  errno = error;
  return -1;
}

int openCamera(FakeCamera& camera) {
  if (!camera.plugged) return failWith(ENODEV);
  const int file = memfd_create("fake camera", MFD_CLOEXEC);
  handles[file] = Handle{.camera = &camera, .queued = {}, .filled = {}, .content = {}};
  ++camera.opened;
  return file;
}

int capability(const Handle& handle, v4l2_capability& answer) {
  std::strcpy(reinterpret_cast<char*>(answer.driver), "uvcvideo");
  answer.device_caps = V4L2_CAP_STREAMING |
                       (handle.camera->captures ? V4L2_CAP_VIDEO_CAPTURE : V4L2_CAP_VIDEO_OUTPUT);
  answer.capabilities = answer.device_caps | V4L2_CAP_DEVICE_CAPS;
  return 0;
}

/// As drivers do: what it can't do it changes.
int setFormat(Handle& handle, v4l2_format& format) {
  const FakeCamera& camera = *handle.camera;
  v4l2_pix_format& pix = format.fmt.pix;
  const auto& offered = camera.formats;
  if (std::find(offered.begin(), offered.end(), pix.pixelformat) == offered.end()) {
    pix.pixelformat = offered.front();
  }
  pix.width = static_cast<std::uint32_t>(camera.width);
  pix.height = static_cast<std::uint32_t>(camera.height);
  pix.bytesperline = pix.pixelformat == V4L2_PIX_FMT_YUYV   ? 2 * pix.width
                     : pix.pixelformat == V4L2_PIX_FMT_GREY ? pix.width
                                                            : 0;
  pix.sizeimage = 2 * pix.width * pix.height;
  handle.format = pix.pixelformat;
  handle.buffer_bytes = (pix.sizeimage + 4095) / 4096 * 4096;  // as mmap's offsets must be
  return 0;
}

int requestBuffers(int file, Handle& handle, v4l2_requestbuffers& request) {
  if (handle.camera->busy) return failWith(EBUSY);
  handle.buffers = request.count;
  return ftruncate(file, static_cast<off_t>(request.count * handle.buffer_bytes));
}

int queryBuffer(const Handle& handle, v4l2_buffer& buffer) {
  if (buffer.index >= handle.buffers) return failWith(EINVAL);
  buffer.length = static_cast<std::uint32_t>(handle.buffer_bytes);
  buffer.m.offset = static_cast<std::uint32_t>(buffer.index * handle.buffer_bytes);
  return 0;
}

int setControl(Handle& handle, const v4l2_control& control) {
  const auto known = handle.camera->controls.find(control.id);
  if (known == handle.camera->controls.end()) return failWith(EINVAL);
  known->second = control.value;
  return 0;
}

/// The sensor sends a frame into the buffer that waited longest.
void fill(int file, Handle& handle) {
  FakeCamera& camera = *handle.camera;
  const std::uint32_t index = handle.queued.front();
  handle.queued.pop_front();
  const FakeCamera::Bytes bytes = camera.picture(camera.next_sequence, handle.format);
  const auto offset = static_cast<off_t>(index * handle.buffer_bytes);
  const ssize_t written =
      pwrite(file, bytes.data(), std::min(bytes.size(), handle.buffer_bytes), offset);
  const std::int64_t stamp_us = camera.next_sequence * camera.interval_us;
  v4l2_buffer buffer{};
  buffer.index = index;
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.bytesused = static_cast<std::uint32_t>(written);
  buffer.sequence = camera.next_sequence++;
  buffer.timestamp = {.tv_sec = stamp_us / 1'000'000, .tv_usec = stamp_us % 1'000'000};
  buffer.flags =
      V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC |
      (camera.stamps_start ? V4L2_BUF_FLAG_TSTAMP_SRC_SOE : V4L2_BUF_FLAG_TSTAMP_SRC_EOF);
  if (camera.damaged > 0) {
    --camera.damaged;
    buffer.flags |= V4L2_BUF_FLAG_ERROR;
  }
  handle.filled.push_back(index);
  handle.content[index] = buffer;
}

int dequeue(Handle& handle, v4l2_buffer& buffer) {
  if (handle.filled.empty()) return failWith(EAGAIN);
  buffer = handle.content[handle.filled.front()];
  handle.filled.pop_front();
  return 0;
}

int answer(int file, Handle& handle, unsigned long request, void* argument) {
  if (!handle.camera->plugged || handle.was_unplugged) {
    handle.was_unplugged = true;
    return failWith(ENODEV);
  }
  switch (request) {
    case VIDIOC_QUERYCAP:
      return capability(handle, *static_cast<v4l2_capability*>(argument));
    case VIDIOC_S_FMT:
      return setFormat(handle, *static_cast<v4l2_format*>(argument));
    case VIDIOC_S_PARM:
      return 0;
    case VIDIOC_S_CTRL:
      return setControl(handle, *static_cast<v4l2_control*>(argument));
    case VIDIOC_REQBUFS:
      return requestBuffers(file, handle, *static_cast<v4l2_requestbuffers*>(argument));
    case VIDIOC_QUERYBUF:
      return queryBuffer(handle, *static_cast<v4l2_buffer*>(argument));
    case VIDIOC_QBUF:
      handle.queued.push_back(static_cast<v4l2_buffer*>(argument)->index);
      return 0;
    case VIDIOC_DQBUF:
      return dequeue(handle, *static_cast<v4l2_buffer*>(argument));
    case VIDIOC_STREAMON:
    case VIDIOC_STREAMOFF:
      handle.streams = request == VIDIOC_STREAMON;
      return 0;
    default:
      return failWith(ENOTTY);
  }
}

int wait(int file, Handle& handle, pollfd& waiting) {
  FakeCamera& camera = *handle.camera;
  if (!camera.plugged || handle.was_unplugged) {
    handle.was_unplugged = true;
    waiting.revents = POLLERR | POLLHUP;
    return 1;
  }
  if (camera.silent || !handle.streams) return 0;  // the time is over at once
  for (int i = 0; i < camera.ready_at_once && !handle.queued.empty(); ++i) fill(file, handle);
  waiting.revents = POLLIN;
  return 1;
}

}  // namespace

FakeCamera& fakeCamera(const std::string& path) {
  const std::lock_guard guard(mutex);
  return cameras[path];
}

void unplugFakeCameras() {
  const std::lock_guard guard(mutex);
  cameras.clear();
}

}  // namespace slamscope::testing

using namespace slamscope::testing;  // NOLINT

extern "C" int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  {
    const std::lock_guard guard(mutex);
    const auto camera = cameras.find(path);
    if (camera != cameras.end()) return openCamera(camera->second);
  }
  return slamscope::testing::theirs<int (*)(const char*, int, ...)>("open")(path, flags, mode);
}

extern "C" int ioctl(int file, unsigned long request, ...) noexcept {
  va_list rest;
  va_start(rest, request);
  void* argument = va_arg(rest, void*);
  va_end(rest);
  {
    const std::lock_guard guard(mutex);
    const auto handle = handles.find(file);
    if (handle != handles.end()) return answer(file, handle->second, request, argument);
  }
  return slamscope::testing::theirs<int (*)(int, unsigned long, ...)>("ioctl")(file, request,
                                                                               argument);
}

extern "C" int poll(pollfd* waiting, nfds_t count, int timeout) {
  if (count == 1) {
    const std::lock_guard guard(mutex);
    const auto handle = handles.find(waiting->fd);
    if (handle != handles.end()) return wait(waiting->fd, handle->second, *waiting);
  }
  return slamscope::testing::theirs<int (*)(pollfd*, nfds_t, int)>("poll")(waiting, count, timeout);
}

extern "C" int close(int file) {
  {
    const std::lock_guard guard(mutex);
    handles.erase(file);
  }
  return slamscope::testing::theirs<int (*)(int)>("close")(file);
}
