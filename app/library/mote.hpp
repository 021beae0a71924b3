// SPDX-License-Identifier: MIT
// The library: particle files to pictures in memory. Needs no header but the standard library's.
//
//   #include <mote/mote.hpp>
//   mote::Renderer renderer;                                  // opens a Vulkan device, once
//   mote::LoadedScene scene = mote::load({"md.xyz"});         // or {"scene.toml"}, or {"spheres:1e5:fill"}
//   mote::Image image = renderer.render(scene, {.width = 1920, .height = 1080, .depth = true});
//   mote::write_png("out.png", image);
//
// Objects are handles: moving is cheap, copying a LoadedScene shares it. One renderer, one thread; several
// renderers may live at once. Everything that goes wrong is thrown as mote::Error.
// Link with find_package(mote) and mote::mote.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#if defined(__GNUC__)
#define MOTE_API __attribute__((visibility("default")))
#else
#define MOTE_API
#endif

namespace mote {

MOTE_API const char* version() noexcept; // "0.1.0"

// what() holds every problem, one or more lines each, as the command line prints them.
class MOTE_API Error : public std::runtime_error {
public:
  Error(const std::string& what, std::string code, int exit_status);
  ~Error() override;
  [[nodiscard]] const std::string& code() const noexcept { return code_; }     // of the first problem, like "S021"
  [[nodiscard]] int exit_status() const noexcept { return exit_status_; }      // that the command line ends with

private:
  std::string code_;
  int exit_status_;
};

// A scene with its particles read, ready to be drawn again and again.
class MOTE_API LoadedScene {
public:
  struct Data;
  explicit LoadedScene(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  [[nodiscard]] std::uint64_t particle_count() const; // rows of all data sets, those left out included
  [[nodiscard]] const std::vector<std::string>& warnings() const;
  [[nodiscard]] const Data& data() const { return *data_; }

private:
  std::shared_ptr<const Data> data_;
};

// One scene file, one generated name, or particle files. `settings`: "path=value" as with --set, of the scene.
MOTE_API LoadedScene load(const std::vector<std::string>& names, const std::vector<std::string>& settings = {});

struct RendererOptions {
  std::string device{};       // part of a device's name; empty: the fastest kind there is
  std::string color_config{}; // OpenColorIO config; empty: $OCIO, else the shipped one
  bool validation{};          // Vulkan's validation layer
};

struct RenderOptions {
  std::uint32_t width{1280}, height{720};
  std::string graph{};                 // shipped graph or graph file; empty: the scene's, else "default"
  std::vector<std::string> settings{}; // "pass.parameter=value" of the graph
  std::string expansion{"auto"};
  std::string view{};                  // view transform; empty: the config's default
  bool transparent{};                  // background of alpha 0
  bool legend{true};                   // legend, scale bar, time and cells, as far as the scene has them
  bool linear{}, depth{}, id{}, normal{}; // what else is wanted
};

// Row 0 is on top; arrays that were not asked for are empty.
struct Image {
  std::uint32_t width{}, height{};
  std::vector<std::uint8_t> rgba{};  // display values, straight alpha
  std::vector<float> linear{};       // scene-linear RGBA, straight alpha
  std::vector<float> depth{};        // along the view axis; +inf where nothing is
  std::vector<std::uint32_t> id{};   // 0xFFFFFFFF where nothing is
  std::vector<float> normal{};       // x y z, world space, unit, turned to the eye; 0 where nothing is
};

class MOTE_API Renderer {
public:
  explicit Renderer(const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  Image render(const LoadedScene& scene, const RenderOptions& options = {});
  [[nodiscard]] std::string device_name() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

MOTE_API void write_png(const std::string& path, const Image& image, bool keep_alpha = false); // "-": standard output

} // namespace mote
