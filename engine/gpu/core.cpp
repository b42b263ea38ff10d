// SPDX-License-Identifier: MIT
#include "engine/gpu/core.hpp"

#include <algorithm>
#include <utility>

#include "engine/gpu/device.hpp"
#include "engine/gpu/instance.hpp"

namespace slamscope::engine::gpu {

Core::Core(const GpuOptions& options)
    : loader_(openLoader()),
      instance_(makeInstance(loader_, options.instance_extensions,
                             options.validation ? &log_ : nullptr)) {
  if (options.validation) messenger_ = {instance_, messengerInfo(log_)};
  Candidate chosen = chooseDevice(enumerateDevices(instance_), options.device);
  physical_ = std::move(chosen.physical);
  info_ = std::move(chosen.info);
  family_ = drawingFamily(physical_);
  memory_ = physical_.getMemoryProperties();
  limits_ = physical_.getProperties().limits;
  const auto lower = [](std::uint32_t& limit, std::uint32_t most) {
    if (most > 0) limit = std::min(limit, most);
  };
  lower(limits_.maxTexelBufferElements, options.most_texels);
  lower(limits_.maxStorageBufferRange, options.most_storage_bytes);
  wide_atomics_ = options.wide_atomics && hasWideAtomics(physical_);
  read_in_place_ = options.read_in_place && info_.type == "cpu";
  device_ = makeDevice(physical_, {.family = family_,
                                   .present = !options.instance_extensions.empty(),
                                   .wide_atomics = wide_atomics_});
  queue_ = device_.getQueue(family_, 0);
}

}  // namespace slamscope::engine::gpu
