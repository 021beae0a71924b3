// SPDX-License-Identifier: MIT
// Outlines from ids: a pixel is on a line if a neighbor shows another particle that lies farther away.
// pass.toml beside this file declares what is used here.

uint id_at(ivec2 p) { return texelFetch(id, p, 0).r; }
float depth_at(ivec2 p) { return min(texelFetch(depth, p, 0).r, 1e30); }

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), last = ivec2(view_size) - 1;
  uint own = id_at(here);
  float near = depth_at(here), hits = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 step = ivec2((k & 1) * 2 - 1, 0) * radius;
    ivec2 there = clamp(here + (k < 2 ? step : step.yx), ivec2(0), last);
    float far = depth_at(there);
    hits += id_at(there) != own && far - near > jump * near ? 1.0 : 0.0;
  }
  vec4 c = texelFetch(color, here, 0);
  o_color = mix(c, vec4(ink.rgb, 1.0), hits > 0.0 ? strength * ink.a : 0.0);
}
