// SPDX-License-Identifier: MIT
// Draws a generated scene through the installed library and checks what comes back.
#include <mote/mote.hpp>

#include <cmath>
#include <cstdio>

int main(int argc, char** argv) {
  try {
    const mote::LoadedScene scene = mote::load({"spheres:1e3:fit"});
    mote::Renderer renderer;
    const mote::Image image = renderer.render(scene, {.width = 320, .height = 180, .linear = true, .depth = true, .id = true, .normal = true});
    std::size_t hits = 0;
    for (std::size_t i = 0; i < image.id.size(); ++i) {
      const bool hit = image.id[i] != 0xFFFFFFFFu;
      if (hit != static_cast<bool>(std::isfinite(image.depth[i]))) return std::puts("id and depth disagree"), 1;
      hits += hit;
    }
    const std::size_t pixels = std::size_t{320} * 180;
    if (image.rgba.size() != pixels * 4 || image.linear.size() != pixels * 4 || image.normal.size() != pixels * 3) return std::puts("sizes"), 1;
    if (hits < pixels / 10 || hits > pixels / 2) return std::printf("%zu pixels are hit\n", hits), 1;
    if (argc > 1) mote::write_png(argv[1], image);
    try {
      (void)mote::load({"no_such_file.xyz"});
      return std::puts("a missing file was accepted"), 1;
    } catch (const mote::Error& error) {
      if (error.exit_status() != 3 || error.code().empty()) return std::printf("wrong error: %s\n", error.what()), 1;
    }
    std::printf("mote %s on %s: %llu particles\n", mote::version(), renderer.device_name().c_str(),
                static_cast<unsigned long long>(scene.particle_count()));
  } catch (const mote::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_status();
  }
  return 0;
}
