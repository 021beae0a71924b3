// SPDX-License-Identifier: MIT
// Analytic edges by tiles: a cast keeps three layers of each pixel. The back is the nearest particle that covers the pixel's center. Before
// it lie the two nearest whose outline runs through the pixel, which cover a part of it in closed form (common/coverage.glsl) and are
// blended as if they did so independently (method book, 8.4: coverages that overlap are correlated). Outlines beyond the second count
// as covered or not, by the pixel's center. Colors are blended in scene-linear light.
//
// Where a frame casts a tile several times with different particles (keep_layers), layers are kept between casts: the back's key (Keys)
// and color, and of each of the other two four words: key, color and coverage as half floats, whether it covers the center. A layer that
// becomes the back then keeps the color of where it was looked at, 0.35 pixels within its outline.
#ifndef MOTE_TILES_LAYERS_GLSL
#define MOTE_TILES_LAYERS_GLSL

#include "common/coverage.glsl"

layout(constant_id = 21) const bool keep_layers = false;
layout(std430, set = 1, binding = 15) buffer BackColors { PAIR back_colors[]; };

// A layer: the place of a particle, or none, or what an earlier cast has left; and whether it covers the pixel's center.
const uint covers_center = 0x80000000u, no_layer = 0x7FFFFFFFu, kept_front = 0x7FFFFFFEu, kept_next = 0x7FFFFFFDu, kept_back = 0x7FFFFFFCu;
bool is_fresh(uint layer) { return (layer & ~covers_center) < 1u << place_bits; }
bool is_layer(uint layer) { return (layer & ~covers_center) != no_layer; }

// Beside `key` and `won`, the back: the two before it, and what an earlier cast has left of their colors.
float front_key[pixels], next_key[pixels];
uint front[pixels], next[pixels];
uvec2 kept_front_color[pixels], kept_next_color[pixels];

// Takes in a particle that meets a pixel so: what it displaces moves on.
#define SWAP_IF(condition, at_key, at_layer) { \
  bool swaps = condition; \
  float left_key = swaps ? at_key : own_key; \
  uint left = swaps ? at_layer : own; \
  at_key = swaps ? own_key : at_key; \
  at_layer = swaps ? own : at_layer; \
  own_key = left_key; \
  own = left; }
#define TEST_PIXEL(k) { \
  Meeting meeting = tile_meets(test, ray_x[k], ray_y[k]); \
  float own_key = meeting.key; \
  uint own = who | (meeting.covers ? covers_center : 0u); \
  SWAP_IF(meeting.at_outline && own_key < front_key[k], front_key[k], front[k]) \
  SWAP_IF(meeting.at_outline && own_key < next_key[k], next_key[k], next[k]) \
  bool nearer = own >= covers_center && own_key < key[k]; \
  key[k] = nearer ? own_key : key[k]; \
  won[k] = nearer ? own : won[k]; }

#define START_PIXEL(k, inside, again, at) { \
  key[k] = front_key[k] = next_key[k] = inside ? infinitely_far : -1.0; \
  won[k] = front[k] = next[k] = no_layer; \
  if (keep_layers && inside && again) { \
    uvec4 kept0 = out_normal[2u * at], kept1 = out_normal[2u * at + 1u]; \
    key[k] = nearest[at]; front_key[k] = uintBitsToFloat(kept0.x); next_key[k] = uintBitsToFloat(kept1.x); \
    won[k] = key[k] < infinitely_far ? kept_back : no_layer; \
    front[k] = front_key[k] < infinitely_far ? kept_front | kept0.w : no_layer; \
    next[k] = next_key[k] < infinitely_far ? kept_next | kept1.w : no_layer; \
    kept_front_color[k] = kept0.yz; kept_next_color[k] = kept1.yz; } }

uvec2 packed(vec4 color) { return uvec2(packHalf2x16(color.rg), packHalf2x16(color.ba)); }
vec4 unpacked(uvec2 color) { return vec4(unpackHalf2x16(color.x), unpackHalf2x16(color.y)); }

// What a pixel sees of a layer: color and, of one `at_outline`, coverage. Such a one is looked at 0.35 pixels within its outline; if it is
// smaller than a pixel, at the place that has its mean brightness under a head light (phase/surface.frag). A back is looked at where
// the pixel's center is, as by look_at(), whatever the pixels beside it need.
vec4 look_at_layer(Taken u, uvec2 pixel, vec2 quick, float key, bool at_outline, bool asked, Winner winner) {
  float focal = u.viewport.z;
  Outline o = tile_outline(winner.particle, quick.x, quick.y, focal);
  vec2 moved = o.radius < 0.85 ? o.offset * (1.0 - 0.745 * o.radius / max(length(o.offset), 1e-6)) : o.inward * max(0.35 - o.inside, 0.0);
  moved = at_outline ? moved / focal : vec2(0.0);
  vec2 place = quick + moved;
  float entry = tile_entry(winner.particle, place.x, place.y);
  Seen seen = look_along(u, pixel, place, moved, at_outline ? entry : key, asked, winner);
  return vec4(seen.color, at_outline ? disc_coverage(o.offset, o.radius, o.inside, o.inward) : 1.0);
}

// `before`: the color of what lies before (times its coverage), and what it lets through; `behind` is straight.
void write_pixel(uint at, vec4 before, vec4 behind) {
  float rest = before.a * behind.a, alpha = 1.0 - before.a + rest;
  write_color(at, map_pixel(vec4((before.rgb + rest * behind.rgb) / max(alpha, 1e-6), alpha)));
}

// Of an invocation's pixels, a bit each: layers that are still to be looked at, and the colors of what was looked at, as write_pixel().
struct Open {
  uint front, next, back;
};
uvec2 before_color[pixels];

// The layers of a row of pixels.
struct Row {
  vec2 ray;
  float key, front_key, next_key;
  uint back, front, next;
  uvec2 before, kept_front, kept_next;
};
Row row_of(int row) {
  Row r = Row(vec2(ray_x[0], 0.0), 0.0, 0.0, 0.0, no_layer, no_layer, no_layer, uvec2(0u), uvec2(0u), uvec2(0u));
#define SELECT(k) { bool me = row == (k); \
  r.ray = me ? vec2(ray_x[k], ray_y[k]) : r.ray; \
  r.key = me ? key[k] : r.key; r.back = me ? won[k] : r.back; \
  r.front = me ? front[k] : r.front; r.next = me ? next[k] : r.next; r.before = me ? before_color[k] : r.before; \
  if (keep_layers) { \
    r.front_key = me ? front_key[k] : r.front_key; r.next_key = me ? next_key[k] : r.next_key; \
    r.kept_front = me ? kept_front_color[k] : r.kept_front; r.kept_next = me ? kept_next_color[k] : r.kept_next; } }
  FOR_PIXELS(SELECT)
  return r;
}

// A layer's color, of this cast or an earlier one.
vec4 color_of(Row r, uint at, uint layer, vec4 looked) {
  uint kept = layer & ~covers_center;
  vec4 color = looked;
  if (kept == kept_front) color = unpacked(r.kept_front);
  if (kept == kept_next) color = unpacked(r.kept_next);
  if (kept == kept_back) color = unpacked(words(back_colors[at]));
  return color;
}

// Of each pixel the nearest layer that is open, in rows that have one at an outline.
void blend_outlines(Taken u, uvec2 base, vec4 background, inout Open open) {
  uint rows = subgroupOr(open.front | open.next);
  do {
    int row = findLSB(rows);
    uint mine = row < 0 ? 0u : 1u << row;
    Row r = row_of(row);
    uvec2 pixel = base + pixel_of(row);
    uint at = pixel.y * u.width + pixel.x;
    bool is_front = (open.front & mine) != 0u, is_next = !is_front && (open.next & mine) != 0u, is_back = !is_front && !is_next && (open.back & mine) != 0u;
    bool wanted = is_front || is_next || is_back;
    uint layer = is_front ? r.front : is_next ? r.next : r.back;
    bool looks = wanted && is_fresh(layer);
    vec4 color = look_at_layer(u, pixel, r.ray, r.key, !is_back, looks, winner_at(looks ? layer & ~covers_center : 0u));
    if (keep_layers && wanted) {
      color = color_of(r, at, layer, color);
      uvec2 words = packed(color);
      if (is_front) out_normal[2u * at] = uvec4(floatBitsToUint(r.front_key), words, layer & covers_center);
      if (is_next) out_normal[2u * at + 1u] = uvec4(floatBitsToUint(r.next_key), words, layer & covers_center);
      if (is_back) back_colors[at] = pair(words);
      nearest[at] = r.key;
    }
    vec4 before = unpacked(r.before);
    float cover = is_back ? 1.0 : color.a;
    before = vec4(before.rgb + before.a * cover * color.rgb, before.a * (1.0 - cover));
    open.front &= is_front ? ~mine : 0xFFFFFFFFu;
    open.next &= is_next ? ~mine : 0xFFFFFFFFu;
    open.back &= is_back ? ~mine : 0xFFFFFFFFu;
    if (wanted && ((open.front | open.next | open.back) & mine) == 0u) write_pixel(at, before, background);
    uvec2 packed_before = packed(before);
#define PUT(k) before_color[k] = row == (k) && wanted ? packed_before : before_color[k];
    FOR_PIXELS(PUT)
    rows &= subgroupAny(((open.front | open.next) & mine) != 0u) ? 0xFFFFFFFFu : rows - 1u;
  } while (rows != 0u);
}

// The backs that are left.
void blend_backs(Taken u, uvec2 base, Open open) {
  uint rows = subgroupOr(open.back);
  do {
    int row = findLSB(rows);
    bool wanted = row >= 0 && (open.back >> row & 1u) != 0u;
    Row r = row_of(row);
    uvec2 pixel = base + pixel_of(row);
    uint at = pixel.y * u.width + pixel.x;
    bool looks = wanted && is_fresh(r.back);
    vec4 color = vec4(look_at(u, pixel, r.ray, r.key, looks, winner_at(looks ? r.back & ~covers_center : 0u)).color, 1.0);
    if (keep_layers && wanted) {
      color = color_of(r, at, r.back, color);
      back_colors[at] = pair(packed(color));
      nearest[at] = r.key;
    }
    if (wanted) write_pixel(at, unpacked(r.before), vec4(color.rgb, 1.0));
    rows &= rows - 1u;
  } while (rows != 0u);
}

void resolve_pixels(Taken u, uvec2 base) {
  Open open = Open(0u, 0u, 0u);
#define OPEN(k) { \
  bool front_seen = is_layer(front[k]) && front_key[k] < key[k], next_seen = is_layer(next[k]) && next_key[k] < key[k]; \
  bool changed = is_fresh(won[k]) || (front_seen && is_fresh(front[k])) || (next_seen && is_fresh(next[k])); \
  before_color[k] = uvec2(0u, 0x3C000000u); \
  open.front |= changed && front_seen ? 1u << (k) : 0u; \
  open.next |= changed && next_seen ? 1u << (k) : 0u; \
  open.back |= changed && is_layer(won[k]) ? 1u << (k) : 0u; }
  FOR_PIXELS(OPEN)
  blend_outlines(u, base, step.background, open);
  blend_backs(u, base, open);
}

#endif
