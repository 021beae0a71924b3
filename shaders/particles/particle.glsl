// SPDX-License-Identifier: MIT
// What the raster expansions (vertex, geometry) and their phases share: a particle loaded from the buffers of
// its batch, and its proxy as a rectangle in clip space.
//
// With NEAR_EYE the particle's center was placed in double on the CPU (passes/particles/placement.hpp): for chunks so near to
// the eye that float32 placement would show.
#ifndef MOTE_PARTICLE_GLSL
#define MOTE_PARTICLE_GLSL

// Mirrors BatchBlock of passes/particles/particle_store.hpp.
//   linear0..2_scale: columns of Placement.linear; w of the first: scale; with AFFINE (a placement that is no
//                     similarity) the three w: lengths of the half axes that the unit sphere gets, negative where it mirrors
//   color:            working space, straight alpha or, below 0, the negative density; rgb used where particles have no color of their own
//   material:         ambient, diffuse, specular, exponent
//   id_base:          id of row 0 of this instance
//   first_near:       NEAR_EYE: place of the draw's first particle among the near payloads
//   axes, turn:       AFFINE: directions of the first two half axes, view space, and how records are turned (own_space.glsl)
#define BATCH_FIELDS \
  vec4 linear0_scale; \
  vec4 linear1; \
  vec4 linear2; \
  vec4 color; \
  vec4 material; \
  uint id_base; \
  uint first_placement; \
  uint first_near; \
  float axes[6]; \
  float turn[3];

#ifdef ORDERED
// Particles of any batch in one draw (passes/particles/ordered_store.hpp): `batch` is a row of a table, chosen by
// batch_index, which load_particle() sets and the fragment stage gets flat.
struct BatchRow { BATCH_FIELDS };
layout(std430, set = 1, binding = 5) readonly buffer Order { uint order[]; };    // 64 placement + slot
layout(std430, set = 1, binding = 6) readonly buffer Owners { uint owners[]; };  // per placement
layout(std430, set = 1, binding = 7) readonly buffer Batches { BatchRow batches[]; };
uint batch_index = 0u;
#define batch batches[batch_index]
#else
layout(push_constant) uniform BatchBlock { BATCH_FIELDS } batch;
#endif

#include "particles/interface.glsl"

layout(std430, set = 1, binding = 0) readonly buffer Records { vec4 records[]; };
layout(std430, set = 1, binding = 1) readonly buffer Rows { uint rows[]; };
#define COLORS_BINDING 2
#ifndef ORDERED
#define COLOR_INDICES_BINDING 5
#endif
#include "particles/own_color.glsl"
// One per chunk that may be visible: xyz the chunk's origin in view space (float bits), w the chunk's index.
layout(std430, set = 1, binding = 3) readonly buffer Placements { uvec4 placements[]; };

#ifdef NEAR_EYE
layout(std430, set = 1, binding = 4) readonly buffer NearCenters { vec4 near_centers[]; }; // 4 a particle: NearPayload
#endif

const uint chunk_capacity = 64u;

// States of the pass (passes/states.hpp, passes/particles/selection.hpp).
layout(constant_id = 20) const bool opaque_only = false; // particles of alpha below 1 draw as nothing
layout(constant_id = 21) const bool blended = false;     // the fragment's alpha is the particle's, else 1
layout(constant_id = 8) const uint type_number = 0u;     // phase shadow: the type, as a map of casters says it
layout(constant_id = 22) const int cull = 0;             // surfaces left out: 0 none, 1 front, 2 back

bool selected(float alpha) { return !opaque_only || alpha >= 1.0; }

struct Loaded {
  Particle particle;
  vec4 color; // with head_light_only: color times ambient light
  vec3 lit;   // with head_light_only: color times the head light, to be multiplied by its cosine
  uint id;
};

// `index` counts the places of all placed chunks: 64 a chunk.
Loaded load_particle(uint index) {
#ifdef ORDERED
  index = order[index];
  batch_index = owners[index / chunk_capacity];
#endif
  uvec4 placed = placements[batch.first_placement + index / chunk_capacity];
  uint slot = placed.w * chunk_capacity + index % chunk_capacity;
  Loaded loaded;
  vec4 record[record_vec4s];
  for (int i = 0; i < record_vec4s; ++i) record[i] = records[slot * uint(record_vec4s) + uint(i)];
  Placement at = Placement(mat3(batch.linear0_scale.xyz, batch.linear1.xyz, batch.linear2.xyz),
                           uintBitsToFloat(placed.xyz), batch.linear0_scale.w);
#ifdef NEAR_EYE
  vec4 near[4];
  for (int i = 0; i < 4; ++i) near[i] = near_centers[(batch.first_near + index) * 4u + uint(i)];
  loaded.particle = place_near(record, at, near);
#else
  loaded.particle = place(record, at);
#endif
  loaded.color = batch.color;
  if (per_particle_color) {
    vec4 own = own_color(slot);
#ifdef ORDERED
    own.rgb *= batch.color.rgb; // white for batches that have one color, whose row has white otherwise
#endif
    loaded.color = vec4(own.rgb, own.a * batch.color.a);
  }
  loaded.lit = vec3(0.0);
  if (head_light_only) { // uniforms read in every hidden fragment are costly on a CPU device
    loaded.lit = batch.material.y * frame.lights[0].strength.rgb * loaded.color.rgb;
    loaded.color.rgb *= batch.material.x * frame.ambient.rgb;
  }
  loaded.id = batch.id_base + rows[slot];
  return loaded;
}

// Growth of a proxy on each side: pixels for the snapping of corners and rounding near the center, and a
// fraction of its extent for the rounding of large ones.
const float proxy_margin = 0.04; // Vulkan lets a rasterizer snap to 1/16 of a pixel: 1/32 off
const float proxy_growth = 2e-6;

// Corner i (0..3, strip order) of the proxy in clip space, with w = 1 so that nothing is near-clipped. The depth is
// that of z_min, moved a little to the eye: the written depth n / z never exceeds it (depth_less, FC-29).
vec4 proxy_corner(Proxy p, int i) {
  vec2 margin = (proxy_margin + proxy_slack) / frame.viewport.zz + proxy_growth * (p.hi - p.lo);
  vec2 corner = vec2((i & 1) == 0 ? p.lo.x - margin.x : p.hi.x + margin.x,
                     (i & 2) == 0 ? p.lo.y - margin.y : p.hi.y + margin.y);
  // The rasterizer samples pixel centers, the rays pass at the sample offset: shift by the difference.
  vec2 shift = 0.5 - (frame.sample_near_far.xy + 0.5 * frame.viewport.xy);
  vec2 ndc = 2.0 * (corner * frame.viewport.zz + shift) / frame.viewport.xy;
  return vec4(clamp(ndc, vec2(-2.0), vec2(2.0)), encode_depth(p.z_min * (1.0 - 1e-5)), 1.0);
}
vec4 outside() { return vec4(2.0, 2.0, 0.0, 1.0); }

#endif
