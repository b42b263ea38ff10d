// SPDX-License-Identifier: MIT
#include "apps/lib/freed_memory.hpp"

#include <malloc.h>

namespace slamscope::apps {

void keepFreedMemory() {
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 128 << 20);
}

void shareOneArena() {
  mallopt(M_ARENA_MAX, 1);
}

}  // namespace slamscope::apps
