// SPDX-License-Identifier: MIT
// Writes each field of each shared struct in the order of its declaration; a test compares them
// with what C++ put there, so that both languages are seen to agree on every offset.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/frame.h"
#include "interop/glyphs.h"
#include "interop/groups.h"
#include "interop/pairs.h"

layout(local_size_x = 1) in;

struct Everything {
  FrameData frame;
  GroupPairData groups;
  EllipsoidGlyph ellipsoid;
  ConeGlyph cone;
  ArrowGlyph arrow;
  SegmentGlyph segment;
  RectGlyph rect;
  LetterGlyph letter;
  PairsData pairs;
  PairsCounts counts;
};

// Two of them: the second is only found where sizes agree as well.
layout(set = 0, binding = 0, scalar) readonly buffer In { Everything values[2]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { float fields[]; };

int next = 0;
void echo(float x) { fields[next++] = x; }
void echo(uint x) { echo(float(x)); }
void echo(vec2 x) { echo(x.x), echo(x.y); }
void echo(vec3 x) { echo(x.xy), echo(x.z); }
void echo(vec4 x) { echo(x.xy), echo(x.zw); }
void echo(mat3 x) { echo(x[0]), echo(x[1]), echo(x[2]); }

void echo(ViewData v) {
  echo(v.R_eye_shared), echo(v.t_eye_shared), echo(v.up_eye), echo(v.focal), echo(v.principal);
  echo(v.skew), echo(v.size), echo(v.background);
}

void main() {
  for (int i = 0; i < 2; ++i) {
    echo(values[i].frame.views[0]), echo(values[i].frame.views[1]), echo(values[i].frame.near), echo(values[i].frame.border_px);
    const GroupPairData g = values[i].groups;
    echo(g.least_i), echo(g.least_j), echo(g.greatest_i), echo(g.greatest_j), echo(g.mean);
    const EllipsoidGlyph e = values[i].ellipsoid;
    echo(e.centre), echo(e.axis0), echo(e.axis1), echo(e.axis2), echo(e.colour);
    const ConeGlyph c = values[i].cone;
    echo(c.tip), echo(c.axis), echo(c.height), echo(c.radius), echo(c.colour);
    const ArrowGlyph a = values[i].arrow;
    echo(a.origin), echo(a.along), echo(a.across), echo(a.colour);
    const SegmentGlyph s = values[i].segment;
    echo(s.previous), echo(s.from), echo(s.to), echo(s.next), echo(s.width_px), echo(s.colour);
    const RectGlyph r = values[i].rect;
    echo(r.min_px), echo(r.max_px), echo(r.colour);
    const LetterGlyph l = values[i].letter;
    echo(l.anchor), echo(l.offset_px), echo(l.min_px), echo(l.max_px), echo(l.uv), echo(l.colour);
    echo(l.anchored), echo(l.halo);
    const PairsData p = values[i].pairs;
    echo(p.points), echo(p.pairs), echo(p.views), echo(p.law), echo(p.gain), echo(p.unit);
    echo(p.origin), echo(p.ex), echo(p.ey), echo(p.ez), echo(p.scale), echo(p.colour);
    echo(p.conditions), echo(p.least_area), echo(p.most), echo(p.run), echo(p.most_by);
    const PairsCounts n = values[i].counts;
    echo(n.chosen), echo(n.drawn), echo(n.not_finite), echo(n.large), echo(n.vertices);
    echo(n.instances), echo(n.first_vertex), echo(n.first_instance), echo(n.least_key), echo(n.rank);
    echo(n.greatest_key);
  }
}
