// SPDX-License-Identifier: MIT
#pragma once

namespace slamscope::apps {

/// Pictures and covariances come and go with every frame. To fetch their pages from the kernel each
/// time is half of a frame's time and more, so that what was freed is kept for the next one. (The
/// memory of a view of a thousand features is 14 % larger than if all above 1 MB were given back at
/// once.) To be called before anything large is allocated.
void keepFreedMemory();

/// Frames are fetched ahead by a thread each. Were each given an arena of its own too, all of them
/// would in the end hold what one frame needs. Not for what computes on many threads.
void shareOneArena();

}  // namespace slamscope::apps
