// SPDX-License-Identifier: MIT
#include "engine/gpu/gpu.hpp"

#include "engine/gpu/core.hpp"
#include "engine/gpu/device.hpp"
#include "engine/gpu/instance.hpp"

namespace slamscope::engine {

Gpu::Gpu(const GpuOptions& options) : core_(std::make_unique<gpu::Core>(options)) {}
Gpu::~Gpu() = default;

const DeviceInfo& Gpu::device() const {
  return core_->info();
}
std::vector<std::string> Gpu::validationMessages() const {
  return core_->log().messages();
}
gpu::Core& Gpu::core() const {
  return *core_;
}

std::vector<DeviceInfo> listDevices() {
  const vk::raii::Context loader = gpu::openLoader();
  const vk::raii::Instance instance = gpu::makeInstance(loader, {}, nullptr);
  std::vector<DeviceInfo> infos;
  for (const gpu::Candidate& candidate : gpu::enumerateDevices(instance)) {
    infos.push_back(candidate.info);
  }
  return infos;
}

}  // namespace slamscope::engine
