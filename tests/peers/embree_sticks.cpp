// SPDX-License-Identifier: MIT
// A peer for `tests/performance.sh --embree`: flat-ended cylinders of a `cylinders_N.bin` scene, traced on the processor by Embree 3 with
// an exact intersection of our own (a user geometry), because Embree 3.13's own cones are not exact: they differ from the double-precision
// reference in one pixel of seventy. Rays in packets of 16, tiles of 16x16 pixels, two threads, one head light, as its neighbor
// `embree_spheres.cpp` has them. Not a part of mote and not built with it.
//
//   embree_sticks SCENE.bin CAMERAS.txt WIDTH HEIGHT OUT.png [FRAMES [IDS]]
//
// Writes the picture of the first camera, and its ids to the file IDS (int32, rows from the top, -1 where nothing is), then draws
// FRAMES further ones and prints `RESULT {"ms": median, ...}`. Needs ../shared/bench on its include path.
#include "common/scene.hpp"

#include <embree3/rtcore.h>
#include <tbb/blocked_range2d.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>

namespace {

constexpr int lanes = 16; // of a packet
constexpr int threads = 2;

struct Stick { // a + s * axis, 0 <= s <= length
  float a[3], axis[3], length, radius;
};

void bounds(const RTCBoundsFunctionArguments* args) {
  const Stick& s = static_cast<const Stick*>(args->geometryUserPtr)[args->primID];
  float low[3], high[3];
  for (int k = 0; k < 3; ++k) { // discs at both ends
    const float b = s.a[k] + s.length * s.axis[k], reach = s.radius * std::sqrt(std::max(0.0f, 1.0f - s.axis[k] * s.axis[k])) * 1.0001f + 1e-5f;
    low[k] = std::min(s.a[k], b) - reach;
    high[k] = std::max(s.a[k], b) + reach;
  }
  *args->bounds_o = {low[0], low[1], low[2], 0.0f, high[0], high[1], high[2], 0.0f};
}

// The interval of the ray in the solid is that between the end planes and that within the infinite cylinder; its entry is the hit.
// The ray starts anew near the stick, so that a distant eye costs no digits.
void intersect(const RTCIntersectFunctionNArguments* args) {
  const Stick& s = static_cast<const Stick*>(args->geometryUserPtr)[args->primID];
  auto* packet = reinterpret_cast<RTCRayHit16*>(args->rayhit);
  RTCRay16& ray = packet->ray;
  RTCHit16& hit = packet->hit;
  const float mx = s.a[0] + 0.5f * s.length * s.axis[0], my = s.a[1] + 0.5f * s.length * s.axis[1], mz = s.a[2] + 0.5f * s.length * s.axis[2];
  const float ux = s.axis[0], uy = s.axis[1], uz = s.axis[2], half = 0.5f * s.length, r2 = s.radius * s.radius;
  for (int i = 0; i < lanes; ++i) {
    const float dx = ray.dir_x[i], dy = ray.dir_y[i], dz = ray.dir_z[i];
    const float ox = ray.org_x[i] - mx, oy = ray.org_y[i] - my, oz = ray.org_z[i] - mz;
    const float shift = -(ox * dx + oy * dy + oz * dz) / (dx * dx + dy * dy + dz * dz);
    const float px = ox + shift * dx, py = oy + shift * dy, pz = oz + shift * dz;
    const float du = dx * ux + dy * uy + dz * uz, pu = px * ux + py * uy + pz * uz;
    const float ex = dx - du * ux, ey = dy - du * uy, ez = dz - du * uz; // across the axis
    const float qx = px - pu * ux, qy = py - pu * uy, qz = pz - pu * uz;
    const float a = ex * ex + ey * ey + ez * ez, b = qx * ex + qy * ey + qz * ez;
    const float nearest = -b / a; // of the ray to the axis
    const float wx = qx + nearest * ex, wy = qy + nearest * ey, wz = qz + nearest * ez;
    const float room = r2 - (wx * wx + wy * wy + wz * wz);
    const float reach = std::sqrt(std::max(room, 0.0f) / a);
    const float to_planes = -pu / du, between = std::abs(half / du);
    const float side = nearest - reach, cap = to_planes - between;
    const float enter = std::max(side, cap), leave = std::min(nearest + reach, to_planes + between);
    const float t = enter + shift;
    const bool meets = args->valid[i] != 0 && room > 0.0f && enter < leave && t > ray.tnear[i] && t < ray.tfar[i];
    const float sign = du > 0.0f ? -1.0f : 1.0f;
    const bool end = cap > side;
    if (!meets) continue;
    ray.tfar[i] = t;
    hit.Ng_x[i] = end ? sign * ux : wx - reach * ex;
    hit.Ng_y[i] = end ? sign * uy : wy - reach * ey;
    hit.Ng_z[i] = end ? sign * uz : wz - reach * ez;
    hit.u[i] = hit.v[i] = 0.0f;
    hit.primID[i] = args->primID;
    hit.geomID[i] = args->geomID;
    hit.instID[0][i] = args->context->instID[0];
  }
}

std::vector<Stick> sticks_of(const Scene& scene) {
  std::vector<Stick> out(scene.n);
  for (std::uint64_t i = 0; i < scene.n; ++i) {
    const float* p = &scene.d[i * 7];
    double way[3], length = 0.0;
    for (int k = 0; k < 3; ++k) {
      way[k] = double{p[3 + k]} - double{p[k]};
      length += way[k] * way[k];
    }
    length = std::sqrt(length);
    for (int k = 0; k < 3; ++k) {
      out[i].a[k] = p[k];
      out[i].axis[k] = static_cast<float>(way[k] / length);
    }
    out[i].length = static_cast<float>(length);
    out[i].radius = p[6];
  }
  return out;
}

struct Picture {
  int width, height;
  std::vector<std::uint8_t> rgb;
  std::vector<std::int32_t> id;
};

struct Eye {
  float at[3], right[3], up[3], forward[3], half_width, half_height;
  Eye(const Camera& c, const Picture& p) {
    for (int k = 0; k < 3; ++k) {
      at[k] = static_cast<float>(c.eye[k]);
      right[k] = static_cast<float>(c.right[k]);
      up[k] = static_cast<float>(c.up[k]);
      forward[k] = static_cast<float>(c.fwd[k]);
    }
    half_height = static_cast<float>(std::tan(c.fovy * M_PI / 360));
    half_width = half_height * static_cast<float>(p.width) / static_cast<float>(p.height);
  }
};

void trace_packet(RTCScene scene, RTCIntersectContext& context, const Eye& eye, Picture& p, int x, int y) {
  alignas(64) RTCRayHit16 packet;
  alignas(64) int valid[lanes];
  for (int i = 0; i < lanes; ++i) {
    const int px = x + (i & 3), py = y + (i >> 2);
    const float u = (2 * (static_cast<float>(px) + .5f) / static_cast<float>(p.width) - 1) * eye.half_width;
    const float v = (1 - 2 * (static_cast<float>(py) + .5f) / static_cast<float>(p.height)) * eye.half_height;
    valid[i] = px < p.width && py < p.height ? -1 : 0;
    RTCRay16& r = packet.ray;
    r.org_x[i] = eye.at[0]; r.org_y[i] = eye.at[1]; r.org_z[i] = eye.at[2];
    r.dir_x[i] = eye.forward[0] + u * eye.right[0] + v * eye.up[0];
    r.dir_y[i] = eye.forward[1] + u * eye.right[1] + v * eye.up[1];
    r.dir_z[i] = eye.forward[2] + u * eye.right[2] + v * eye.up[2];
    r.tnear[i] = r.time[i] = 0.0f;
    r.tfar[i] = INFINITY;
    r.mask[i] = ~0u;
    r.id[i] = r.flags[i] = 0;
    packet.hit.geomID[i] = packet.hit.primID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect16(valid, scene, &context, &packet);
  for (int i = 0; i < lanes; ++i) {
    if (!valid[i]) continue;
    const std::size_t at = static_cast<std::size_t>(y + (i >> 2)) * static_cast<std::size_t>(p.width) + static_cast<std::size_t>(x + (i & 3));
    const unsigned prim = packet.hit.primID[i];
    p.id[at] = prim == RTC_INVALID_GEOMETRY_ID ? -1 : static_cast<int>(prim);
    float light = 1.0f;
    if (p.id[at] >= 0) {
      const float n[3] = {packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]};
      const float toward = -(n[0] * eye.forward[0] + n[1] * eye.forward[1] + n[2] * eye.forward[2]);
      light = .2f + .8f * std::max(0.0f, toward / std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const float base = p.id[at] < 0 ? 1.0f : static_cast<float>(PALETTE[prim % 8][k]);
      p.rgb[at * 3 + k] = static_cast<std::uint8_t>(255 * std::min(1.0f, base * light) + .5f);
    }
  }
}

void draw(RTCScene scene, const Camera& camera, Picture& p) {
  const Eye eye(camera, p);
  tbb::parallel_for(tbb::blocked_range2d<int>(0, (p.height + 15) / 16, 1, 0, (p.width + 15) / 16, 4), [&](const auto& tiles) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (int ty = tiles.rows().begin(); ty < tiles.rows().end(); ++ty)
      for (int tx = tiles.cols().begin(); tx < tiles.cols().end(); ++tx)
        for (int y = ty * 16; y < std::min(p.height, ty * 16 + 16); y += 4)
          for (int x = tx * 16; x < std::min(p.width, tx * 16 + 16); x += 4) trace_packet(scene, context, eye, p, x, y);
  });
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 6) {
    std::fprintf(stderr, "usage: embree_sticks SCENE.bin CAMERAS.txt WIDTH HEIGHT OUT.png [FRAMES [IDS]]\n");
    return 2;
  }
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const Scene file = load_scene(argv[1]);
  const std::vector<Camera> cameras = load_cameras(argv[2]);
  if (file.width != 7 || cameras.empty()) {
    std::fprintf(stderr, "%s has no cylinders, or %s no cameras\n", argv[1], argv[2]);
    return 1;
  }
  Picture picture{std::atoi(argv[3]), std::atoi(argv[4]), {}, {}};
  picture.id.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  picture.rgb.resize(picture.id.size() * 3);
  double start = now();
  std::vector<Stick> sticks = sticks_of(file);
  RTCDevice device = rtcNewDevice("threads=2");
  RTCScene scene = rtcNewScene(device);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(sticks.size()));
  rtcSetGeometryUserData(geometry, sticks.data());
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  const double build = now() - start;
  draw(scene, cameras[0], picture);
  write_png(argv[5], picture.width, picture.height, picture.rgb.data());
  if (argc > 7) std::ofstream(argv[7], std::ios::binary).write(reinterpret_cast<const char*>(picture.id.data()), static_cast<std::streamsize>(picture.id.size() * 4));
  std::vector<double> ms;
  for (int frame = 1; frame <= (argc > 6 ? std::atoi(argv[6]) : 7); ++frame) {
    start = now();
    draw(scene, cameras[static_cast<std::size_t>(frame) % cameras.size()], picture);
    ms.push_back((now() - start) * 1e3);
  }
  std::sort(ms.begin(), ms.end());
  std::printf("RESULT {\"n\":%llu,\"build_s\":%.4f,\"ms\":%.2f}\n", static_cast<unsigned long long>(file.n), build, ms.empty() ? 0.0 : ms[ms.size() / 2]);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
  return 0;
}
