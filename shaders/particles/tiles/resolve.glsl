// SPDX-License-Identifier: MIT
// Shades what won a pixel, or leaves it as a surface to be shaded later, or as the caster of a shadow map's texel: what
// tiles (cast.comp) and splats (resolve_splats.comp) end with. With ANALYTIC_EDGES, layers.glsl writes instead.
#ifndef MOTE_TILES_RESOLVE_GLSL
#define MOTE_TILES_RESOLVE_GLSL

#ifdef SHADOW_SET
#include "shadow/lit.glsl"
Lit lit = all_lit(); // at the surface that is being shaded
#define LIGHT_VISIBILITY(i) lit_by(lit, i)
#endif
// A CPU device gathers uniform values lane by lane at every use: what every pixel needs is taken once (take()).
Light first_light;
vec3 ambient_light;
Light light_of_frame(int i) { return Light(frame.lights[i].position, frame.lights[i].axis, frame.lights[i].strength, frame.lights[i].attenuation, frame.lights[i].cone); }
Light light_here(int i) {
  if (light_count == 1) return first_light;
  return light_of_frame(i);
}
#define FRAME_LIGHT(i) light_here(i)
#define FRAME_AMBIENT ambient_light
#include "common/shading.glsl"

#define COLOR_BINDING 9
#define COLOR_PAIRS_BINDING 14
#include "particles/tiles/color_out.glsl"

layout(constant_id = 10) const uint aovs = 0u;           // bits: 1 depth, 2 id, 4 normal
layout(constant_id = 13) const bool one_material = true; // of all batches: StepBlock.material
layout(constant_id = 15) const bool want_depth = false;  // the encoded depth, for passes that draw after this one
layout(constant_id = 8) const uint type_number = 0u;     // phase shadow: the type, as a map of casters says it
layout(constant_id = 18) const int phase = 0;            // 0 opaque, 1 surface, 3 shadow, as in phase/surface.frag and phase/shadow.frag
layout(constant_id = 22) const bool casters_by_id = false;  // phase shadow: an id says all, casters are kept by it (place.comp)
layout(constant_id = 16) const bool display_only = false; // colors of 8 bits are all that is asked for: normals may err by 1e-4

bool want_id() {
#ifdef SHADOW_SET
  return true; // no particle shadows itself
#else
  if (phase == 1) return true; // one || of all three: glslang makes a constant of what is none
  if (phase == 3) return color_words != 0u;
  return (aovs & 2u) != 0u;
#endif
}

layout(std430, set = 1, binding = 0) readonly buffer Materials { vec4 materials[]; };
layout(std430, set = 1, binding = 8) buffer Keys { float nearest[]; };       // per pixel: view depth times |ray|^2
layout(std430, set = 1, binding = 10) writeonly buffer OutEncoded { float out_encoded[]; };
layout(std430, set = 1, binding = 11) writeonly buffer OutDepth { float out_depth[]; };
layout(std430, set = 1, binding = 12) writeonly buffer OutId { uint out_id[]; };
layout(std430, set = 1, binding = 13) buffer OutNormal { uvec4 out_normal[]; }; // surface: and depth; shadow: payload; layers.glsl

void write_normal(uint at, vec4 v) { out_normal[at] = floatBitsToUint(v); }

// Uniform values that every pixel needs, taken once.
struct Taken {
  uint width;
  vec4 viewport, sample_near_far, material;
  float inverse_rest;
  vec3 ambient, head_light; // times the material, with one_material
#ifdef SHADOW_SET
  LightMap map0, map1, map2, map3;
#endif
};
Taken take() {
  Taken u;
  u.width = step.width;
  u.viewport = frame.viewport;
  u.sample_near_far = frame.sample_near_far;
  u.inverse_rest = frame.depth_near.y;
  u.material = step.material;
  u.ambient = (one_material ? u.material.x : 1.0) * frame.ambient.rgb;
  ambient_light = frame.ambient.rgb;
  if (light_count == 1) first_light = light_of_frame(0);
  u.head_light = (one_material ? u.material.y : 1.0) * frame.lights[0].strength.rgb;
#ifdef SHADOW_SET
  if (shadow_maps > 0) u.map0 = take_map(0, light_of_map0);
  if (shadow_maps > 1) u.map1 = take_map(1, light_of_map1);
  if (shadow_maps > 2) u.map2 = take_map(2, light_of_map2);
  if (shadow_maps > 3) u.map3 = take_map(3, light_of_map3);
#endif
  return u;
}

// What a pixel shows.
struct Winner {
  Particle particle;
  vec3 color;
  uint material, id; // id: with want_id() only
};

// What a pixel sees of its particle: shaded in phase opaque, else the particle's own color.
struct Seen {
  vec3 color, normal;
  float t;
};

// Along the ray through `quick` (x, y to visibility's precision), which lies `moved` from the pixel's center. `asked`: shadow maps are.
Seen look_along(Taken u, uvec2 pixel, vec2 quick, vec2 moved, float key, bool asked, Winner winner) {
  Particle particle = winner.particle;
  Seen seen;
  seen.color = winner.color;
  Ray ray = orthographic ? Ray(vec3(quick, 0.0), vec3(0.0, 0.0, 1.0)) : Ray(vec3(0.0), vec3(quick, 1.0));
  bool quickly = display_only;
#ifdef HAS_ALARM
  if (show_depth_violation) quickly = false; // an intersection tells
#endif
  if (quickly) {
    seen.t = key / dot(ray.direction, ray.direction);
    seen.normal = normal_at(ray, particle, seen.t);
  } else {
    ray = ray_through(vec2(pixel), u.sample_near_far.xy, u.viewport.w, u.inverse_rest);
    if (orthographic) ray.origin.xy += moved;
    else ray.direction.xy += moved;
    Interval hit;
    intersect(ray, particle, hit);
    seen.normal = outward_normal(ray, particle, hit, false);
    seen.t = hit.t_in;
  }
#ifdef HAS_ALARM
  bool alarm = type_alarm;
  if (alarm) seen.color = vec3(1.0, 0.0, 1.0);
#endif
  if (phase != 0) return seen;
  vec3 own = seen.color;
  vec4 material = u.material;
  if (!one_material) material = materials[winner.material];
  if (head_light_only) {
    vec3 ambient = one_material ? u.ambient : material.x * u.ambient, light = one_material ? u.head_light : material.y * u.head_light;
    seen.color = own * (ambient + max(-seen.normal.z, 0.0) * light);
  } else {
    vec3 position = ray.origin + seen.t * ray.direction;
#ifdef SHADOW_SET
    lit = all_lit();
    if (shadow_maps > 0) ASK_MAP(0, u.map0, position, winner.id, asked && faces(u.map0, position, seen.normal))
    if (shadow_maps > 1) ASK_MAP(1, u.map1, position, winner.id, asked && faces(u.map1, position, seen.normal))
    if (shadow_maps > 2) ASK_MAP(2, u.map2, position, winner.id, asked && faces(u.map2, position, seen.normal))
    if (shadow_maps > 3) ASK_MAP(3, u.map3, position, winner.id, asked && faces(u.map3, position, seen.normal))
#endif
    seen.color = shade(Surface(position, seen.normal, -normalize(ray.direction)), own, material);
  }
#ifdef HAS_ALARM
  if (alarm) seen.color = own;
#endif
  return seen;
}

Seen look_at(Taken u, uvec2 pixel, vec2 quick, float key, bool asked, Winner winner) {
  return look_along(u, pixel, quick, vec2(0.0), key, asked, winner);
}

// The texel of a shadow map: its caster.
void write_caster(uint at, Winner winner) {
  if (casters_by_id) {
    out_id[at] = winner.id;
  } else if (color_words != 0u) {
    vec4 payload[payload_vec4s];
    pack(winner.particle, payload);
    write_normal(at, payload[0]);
    if (color_words == 1u) out_id[at] = winner.id; // a map that stays in buffers
    else out_color_pairs[2u * at] = pair(uvec2(winner.id, type_number));
  }
}

// What won a pixel, written where `changed`.
void resolve(Taken u, uvec2 pixel, vec2 quick, float pixel_key, bool changed, Winner winner) {
  uint at = pixel.y * u.width + pixel.x;
  Seen seen = look_at(u, pixel, quick, pixel_key, changed, winner);
  if (!changed) return;
  nearest[at] = pixel_key;
  if (phase == 0) write_color(at, map_pixel(vec4(seen.color, 1.0)));
  if (want_depth) out_encoded[at] = encode_depth(seen.t);
  if (phase == 3) write_caster(color_words == 1u ? tiled_column(pixel.x) + tiled_row(pixel.y, step.tiles_x) : at, winner);
  if (phase == 1) {
    write_color(at, vec4(seen.color, float(winner.material)));
    out_id[at] = winner.id;
    write_normal(at, vec4(seen.normal, seen.t));
  }
  if (phase != 0) return;
  if ((aovs & 1u) != 0u) out_depth[at] = seen.t;
  if ((aovs & 2u) != 0u) out_id[at] = winner.id;
  vec3 n = seen.normal;
  if ((aovs & 4u) != 0u) write_normal(at, vec4(n.x * frame.world_from_view0.xyz + n.y * frame.world_from_view1.xyz + n.z * frame.world_from_view2.xyz, 0.0));
}

#endif
