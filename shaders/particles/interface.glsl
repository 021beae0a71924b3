// SPDX-License-Identifier: MIT
// What a particle type gives, whatever the expansion. The expansion includes this; this includes "type.glsl",
// which the include path resolves to the folder of the particle type:
//
//   const int record_vec4s, payload_vec4s
//   #define CASTER_VEC4S                             payload_vec4s without NEAR_EYE, whose payload starts with the same: what a
//                                                    texel of a shadow map keeps of a caster; at most 4
//   struct Particle                                  view-space values of one particle
//   Particle place(vec4 record[], Placement)         record (chunk-relative) to view space; not with NEAR_EYE
//   Particle place_near(vec4 record[], Placement, vec4 near[4])   NEAR_EYE: the center comes placed: near[0] = (center, radius of
//                                                    the bounding ball), near[1].xyz = center - float32(center); near[1].w and
//                                                    near[2].x: |center|^2 - radius^2 as a sum of two floats; near[3] = record[1],
//                                                    (vector, size), in own space, near[2].yzw what rounding took from the vector
//   void pack(Particle, out vec4 payload[]), Particle unpack(vec4 payload[])
//   bool drawable(Particle)                          false: radius 0 and the like, drawn as nothing
//   Proxy proxy(Particle)                            bounds on the image
//   bool intersect(Ray, Particle, out Interval)      where the ray is inside; on a miss the interval is one point
//   bool passes_thin(Ray, Particle, Interval, float radius)   thinner than that and passed nearer than that; after a miss, too
//   #define HAS_CASTER, void pack_caster(Particle, out vec4 caster[CASTER_VEC4S])   with AFFINE: what a map keeps of it, as another
//                                                    type's payload (affine_caster.glsl); of types that have none such, maps keep nothing
//   Outline outline(Ray, Particle, Interval)         where the ray's pixel lies to the outline; for analytic edges
//   vec3 outward_normal(Ray, Particle, Interval, bool exit)   at one end of the interval; unit
//   with HAS_INNER_ENDS: bool inner_end(Interval, bool exit)   that end lies within a neighbor of one body: no surface
//
// own_space.glsl has a particle's own space, in which all but the sphere say these, bounds.glsl the proxies of balls, discs
// and hulls, axial.glsl what types with an axis share.
//
// and for the tiles of the compute expansion (TILES), where one particle is tested against many pixels:
//
//   Proxy tile_proxy(Particle)                       as proxy(), of particles wholly before the eye and the near plane
//   struct TileTest { vec4 a, b, c; }                what the test needs, formed once a particle and tile
//   TileTest tile_test(Particle, bool alive)         not alive: no ray meets it
//   bool tile_nearer(TileTest, float x, float y, inout float key)   does the entry at the ray (x, y, 1) lie before
//                                                    the key (depth times |ray|^2)? then the key is replaced
//   with ANALYTIC_EDGES, of types in `types_with_edges` (shaders/CMakeLists.txt):
//   float tile_band                                  outline_reach in tangents, set before tile_test()
//   Meeting tile_meets(TileTest, float x, float y)   how the pixel of the ray (x, y, 1) meets the particle
//   Outline tile_outline(Particle, float x, float y, float focal)   as outline() at that ray
//   float tile_entry(Particle, float x, float y)     the key of the entry there; on a miss of the ray's middle
//   #define TILE_LOOP                                where tile_nearer() is long: it is compiled once, not for each pixel
//   vec3 normal_at(Ray, Particle, float t)           unit, outward, at a point of the surface; to 1e-4 rad where a
//                                                    particle covers a pixel or more
#ifndef MOTE_INTERFACE_GLSL
#define MOTE_INTERFACE_GLSL

#include "common/frame.glsl"
#include "common/exact.glsl"
#include "common/color.glsl"

// Places a chunk of one instance: view = linear * relative + origin. The origin was formed in double.
struct Placement {
  mat3 linear;
  vec3 origin;
  float scale; // of lengths, where linear is a similarity; not with AFFINE
};

// A rectangle in tangents x/z, y/z (orthographic: in x, y), and the least visible z of the particle.
struct Proxy {
  vec2 lo, hi;
  float z_min;
};
Proxy empty_proxy() { return Proxy(vec2(1e30), vec2(-1e30), 1.0); }

// Where a ray runs inside a solid, as view depths, and what the type wants to remember for the normals. Of a solid that is
// not convex (arrow): from where it is first entered to where it is left for good.
struct Interval {
  float t_in, t_out;
  vec4 local, ends;
};

// A pixel's place to a particle's outline on the image; everything in pixels.
struct Outline {
  float inside; // from the pixel's center to the outline, positive within
  vec2 inward;  // unit, at right angles to the outline
  float radius; // of curvature
  vec2 offset;  // from the pixel's center to the particle's
};

#ifdef ANALYTIC_EDGES
// Pixels from a pixel's center within which an outline is looked for: what one farther away cuts off is less than 0.005 of the pixel.
const float outline_reach = 0.64;
struct Meeting {
  float key;                 // of the entry; on a miss of the ray's middle
  bool covers, at_outline;   // the pixel's center; the outline may run through the pixel
};
#endif

#include "type.glsl"

#ifndef HAS_INNER_ENDS
bool inner_end(Interval hit, bool exit) { return false; }
#endif

#endif
