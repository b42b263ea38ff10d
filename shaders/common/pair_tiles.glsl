// SPDX-License-Identifier: MIT
// The picture of each view in square tiles, row by row.
const uint kTile = 32u;  // px

uvec2 tileCounts() { return (uvec2(VIEW(size)) + kTile - 1u) / kTile; }
