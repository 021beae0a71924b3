// SPDX-License-Identifier: MIT
// Shades what won a pixel, or leaves it as a surface to be shaded later, or as the caster of a shadow map's texel: what
// tiles (cast.comp) and splats (resolve_splats.comp) end with.
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
#include "particles/tiles/winners.glsl"

layout(constant_id = 10) const uint aovs = 0u;           // bits: 1 depth, 2 id, 4 normal
layout(constant_id = 13) const bool one_material = true; // of all batches: StepBlock.material
layout(constant_id = 15) const bool want_depth = false;  // the encoded depth, for passes that draw after this one
layout(constant_id = 8) const uint type_number = 0u;     // phase shadow: the type, as a map of casters says it
layout(constant_id = 18) const int phase = 0;            // 0 opaque, 1 surface, 3 shadow, as in phase/surface.frag and phase/shadow.frag
layout(constant_id = 21) const bool analytic_edges = false; // phase opaque: winners are kept, for edges.comp
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
layout(std430, set = 1, binding = 12) writeonly buffer OutId { uint out_id[]; };      // with analytic_edges: names
layout(std430, set = 1, binding = 13) writeonly buffer OutNormal { uvec4 out_normal[]; }; // surface: and depth; shadow, analytic_edges: payload
layout(std430, set = 1, binding = 15) writeonly buffer OutWinnerColors { PAIR out_winner_colors[]; }; // with analytic_edges: winners.glsl

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

#ifdef HAS_TILE_OUTLINE
// Where a pixel's particle is looked at, relative to the pixel's center, in tangents: at outlines 0.35 pixels within; of one smaller than a
// pixel, at the place that has its mean brightness under a head light (phase/surface.frag).
vec2 inner_place(Particle p, vec2 quick, float focal) {
  float unused_key;
  Outline o = tile_outline(p, quick.x, quick.y, focal, unused_key);
  float far = length(o.offset);
  vec2 moved = o.radius < 0.85 ? o.offset * (1.0 - 0.745 * o.radius / max(far, 1e-6)) : o.inward * max(0.35 - o.inside, 0.0);
  return moved / focal;
}
void keep_winner(uint at, Particle p, vec3 color) {
  vec4 payload[payload_vec4s];
  pack(p, payload);
  out_id[at] = winner_name(payload[0]);
  write_normal(at, payload[0]);
  out_winner_colors[at] = pair(uvec2(packHalf2x16(color.rg), packHalf2x16(vec2(color.b, 1.0))));
}
#endif

// The surface at one pixel, shaded; written where `changed`. `quick`: the ray's x, y to visibility's precision.
void resolve(Taken u, uvec2 pixel, vec2 quick, float pixel_key, bool changed, Winner winner) {
  uint at = pixel.y * u.width + pixel.x;
  Particle particle = winner.particle;
  vec3 own = winner.color;
  Ray ray = orthographic ? Ray(vec3(quick, 0.0), vec3(0.0, 0.0, 1.0)) : Ray(vec3(0.0), vec3(quick, 1.0));
  float t;
  vec3 normal;
#ifdef HAS_TILE_OUTLINE
  vec2 moved = vec2(0.0);
  float surface_key = pixel_key;
  if (analytic_edges) {
    moved = inner_place(particle, quick, u.viewport.z);
    vec2 place = quick + moved;
    tile_outline(particle, place.x, place.y, u.viewport.z, surface_key); // of the particle as it is, not widened
    if (orthographic) ray.origin.xy = place;
    else ray.direction.xy = place;
  }
#else
  float surface_key = pixel_key;
#endif
  bool quickly = display_only;
#ifdef HAS_ALARM
  if (show_depth_violation) quickly = false; // an intersection tells
#endif
  if (quickly) {
    t = surface_key / dot(ray.direction, ray.direction);
    normal = normal_at(ray, particle, t);
  } else {
    ray = ray_through(vec2(pixel), u.sample_near_far.xy, u.viewport.w, u.inverse_rest);
#ifdef HAS_TILE_OUTLINE
    if (orthographic) ray.origin.xy += moved;
    else ray.direction.xy += moved;
#endif
    Interval hit;
    intersect(ray, particle, hit);
    normal = outward_normal(ray, particle, hit, false);
    t = hit.t_in;
  }
  vec4 material = u.material;
  if (!one_material) material = materials[winner.material];
#ifdef HAS_ALARM
  bool alarm = type_alarm;
  if (alarm) own = vec3(1.0, 0.0, 1.0);
#endif
  vec3 color = own;
  if (phase != 0) {
    if (!changed) return;
    nearest[at] = pixel_key;
    if (want_depth) out_encoded[at] = encode_depth(t);
    if (phase == 3 && color_words == 1u) at = tiled_column(pixel.x) + tiled_row(pixel.y, step.tiles_x); // a map that stays in buffers
    if (phase == 1) {
      write_color(at, vec4(own, float(winner.material)));
      out_id[at] = winner.id;
      write_normal(at, vec4(normal, t));
    } else if (casters_by_id) {
      out_id[at] = winner.id;
    } else if (color_words != 0u) {
      vec4 payload[payload_vec4s];
      pack(particle, payload);
      write_normal(at, payload[0]);
      if (color_words == 1u) out_id[at] = winner.id; // a map that stays in buffers
      else out_color_pairs[2u * at] = pair(uvec2(winner.id, type_number));
    }
    return;
  }
  if (head_light_only) {
    vec3 ambient = one_material ? u.ambient : material.x * u.ambient, light = one_material ? u.head_light : material.y * u.head_light;
    color = own * (ambient + max(-normal.z, 0.0) * light);
  } else {
#ifdef SHADOW_SET
    vec3 position = ray.origin + t * ray.direction;
    lit = all_lit();
    if (shadow_maps > 0) ASK_MAP(0, u.map0, position, winner.id, changed && faces(u.map0, position, normal))
    if (shadow_maps > 1) ASK_MAP(1, u.map1, position, winner.id, changed && faces(u.map1, position, normal))
    if (shadow_maps > 2) ASK_MAP(2, u.map2, position, winner.id, changed && faces(u.map2, position, normal))
    if (shadow_maps > 3) ASK_MAP(3, u.map3, position, winner.id, changed && faces(u.map3, position, normal))
#endif
    color = shade(Surface(ray.origin + t * ray.direction, normal, -normalize(ray.direction)), own, material);
  }
#ifdef HAS_ALARM
  if (alarm) color = own;
#endif
  if (!changed) return;
  nearest[at] = pixel_key;
#ifdef HAS_TILE_OUTLINE
  if (analytic_edges) keep_winner(at, particle, color);
#endif
  write_color(at, map_pixel(vec4(color, 1.0)));
  if (want_depth) out_encoded[at] = encode_depth(t);
  if ((aovs & 1u) != 0u) out_depth[at] = t;
  if ((aovs & 2u) != 0u) out_id[at] = winner.id;
  if ((aovs & 4u) != 0u)
    write_normal(at, vec4(normal.x * frame.world_from_view0.xyz + normal.y * frame.world_from_view1.xyz + normal.z * frame.world_from_view2.xyz, 0.0));
}

#endif
