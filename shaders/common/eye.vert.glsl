// SPDX-License-Identifier: MIT
// One draw goes into all eyes: each glyph is drawn once for each of them, in neighbouring instances,
// and the vertices choose the layer. (A view mask would say the same; lavapipe 22.3.6 draws triangles
// into the first view only.)
#define SLAMSCOPE_VERTEX
layout(location = 15) flat out int eye;
