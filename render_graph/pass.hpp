// SPDX-License-Identifier: MIT
// The interface of a pass, and what it sees while it records.
//
// Life cycle: a kind's factory makes a Pass; declare() names slots and reads parameters (pure, no
// device, once per load); prepare() builds pipelines once the formats are known (again when they
// change); record() runs every frame. A drawing pass records into the RenderPass that the executor
// has opened on its attachments; a compute pass (no attachment slot) records into the encoder.
//
// A pass never creates, resizes or frees a graph resource, and touches only what it declared: the
// executor compares declared with observed use in tests.
#pragma once

#include "core/gpu/gpu.hpp"
#include "render_graph/params.hpp"
#include "render_graph/slots.hpp"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeindex>
#include <vector>

namespace mote::rg {

// Values that the application hands to all passes of a frame, one per C++ type (the particle scene,
// the color configuration, ...). The render graph knows none of those types.
class FrameInput {
public:
  template <class T> void set(const T* value) { values_[std::type_index(typeid(T))] = value; }
  template <class T> [[nodiscard]] const T* find() const {
    auto it = values_.find(std::type_index(typeid(T)));
    return it == values_.end() ? nullptr : static_cast<const T*>(it->second);
  }
  // The value must be there: the caller documents which types its kinds need. Throws std::logic_error.
  template <class T> [[nodiscard]] const T& get() const {
    if (const T* value = find<T>()) return *value;
    throw std::logic_error(std::string("FrameInput lacks ") + typeid(T).name());
  }

private:
  std::map<std::type_index, const void*> values_;
};

struct ViewSize { std::uint32_t width{}, height{}; bool operator==(const ViewSize&) const = default; };

// What a pass does that maps each pixel of one texture to the same pixel of another and nothing else (a display
// transform): the pass that makes the first texture may apply it at once, and then neither the texture nor the pass is
// needed in that frame.
struct PixelMap {
  static constexpr std::uint32_t set = 2; // of its bindings
  std::string glsl{};                     // declares vec4 map_pixel(vec4) and those bindings, for a compute stage
  std::string id{};                       // changes with the text and the tables
  gpu::BindGroupLayout layout{};          // invalid: no bindings
  gpu::BindGroup group{};
  std::function<gpu::Color(gpu::Color)> apply{}; // the same on the CPU
};
// The pass that reads an output, if it is a pixel map and nothing else needs that output.
struct Successor {
  const PixelMap* map{};
  gpu::Texture target{}; // what the successor would write; it may be copied to
};

// What the executor gives to prepare(): formats of attachments in slot order, and views of resources.
// A slot that is optional and unconnected (or culled) has no texture.
class PassContext {
public:
  virtual ~PassContext() = default;
  [[nodiscard]] virtual gpu::Device device() const = 0;
  [[nodiscard]] virtual ViewSize view_size() const = 0;
  [[nodiscard]] virtual bool connected(std::string_view slot) const = 0;
  // Sampled slots: all mips and layers; attachments and storage textures: the base mip (attachments: its
  // first layer). Invalid if unconnected. Where an input and an output share a name it is the input.
  [[nodiscard]] virtual gpu::TextureView texture(std::string_view slot) const = 0;
  [[nodiscard]] virtual gpu::Texture whole_texture(std::string_view slot) const = 0; // for views of one's own
  // Format that the plan gives the slot; of the output where an input and an output share a name.
  [[nodiscard]] virtual gpu::TextureFormat format(std::string_view slot) const = 0;
  [[nodiscard]] virtual gpu::Buffer buffer(std::string_view slot) const = 0;
  // Attachment order of the opened RenderPass: color slots that are connected, as declared.
  [[nodiscard]] virtual const std::vector<std::string>& color_slots() const = 0;
  // Changes whenever textures or buffers were made anew (first frame, resize) or an input went or came
  // because its pass was idle: bind groups made for an older number are stale.
  [[nodiscard]] virtual std::uint64_t generation() const = 0;
  // A state slot that holds no earlier frame (it is all zero): first frame, camera cut, reload, resize.
  [[nodiscard]] virtual bool fresh(std::string_view slot) const = 0;
  // While recording:
  [[nodiscard]] virtual const FrameInput& frame() const = 0;
  [[nodiscard]] virtual gpu::RenderPass& render_pass() = 0;   // drawing passes
  [[nodiscard]] virtual gpu::CommandEncoder& encoder() = 0;   // compute passes, update(), opens_attachments()
  // For passes that open their attachments themselves: all attachment slots, cleared or loaded as planned; with
  // `loaded` what the pass has copied into them stays. To be ended before encoder() is used again.
  [[nodiscard]] virtual gpu::RenderPass begin_attachments(bool loaded) = 0;
  // Ends a stage of the pass for whoever asked for stage times; encoder() must be free. Cheap otherwise.
  virtual void mark(std::string_view stage) = 0;
  // While recording, for passes that open their attachments: see Successor. Whoever writes the target instead of its
  // output calls take_over(), which leaves the successor out of this frame.
  [[nodiscard]] virtual std::optional<Successor> successor(std::string_view slot) = 0;
  virtual void take_over(std::string_view slot) = 0;
  // Is this output read, and by passes of this kind only, as a texture to sample? Then nothing else ever looks at it.
  [[nodiscard]] virtual bool only_sampled_by(std::string_view slot, std::string_view kind) const = 0;
  // Does anything read this output after the pass?
  [[nodiscard]] virtual bool kept(std::string_view slot) const = 0;
};

class Pass {
public:
  virtual ~Pass() = default;
  virtual void declare(std::vector<Slot>& slots, Params& params) = 0;
  virtual void prepare(PassContext& context) = 0;
  // Clear value of a written attachment for this frame; asked before the pass is opened. Default: 0 (color),
  // 0 = infinitely far (depth, reverse-Z).
  virtual gpu::Color clear_value(std::string_view slot, const FrameInput& frame) { (void)slot; (void)frame; return {0, 0, 0, 0}; }
  // Uploads and other work outside the RenderPass (drawing passes only): called just before it opens.
  virtual void update(PassContext& context) { (void)context; }
  virtual void record(PassContext& context) = 0;
  // For passes that are a pixel map from their one input to their one output; valid until the next call. Called while
  // recording, with frame() there.
  virtual const PixelMap* pixel_map(PassContext& context) { (void)context; return nullptr; }
  // What the frames so far turned out to lack (memory that overflowed, ...). Only after the device has finished them.
  virtual void report(Diagnostics& out) { (void)out; }
  // True: the pass begins its RenderPasses itself, on encoder() (one per layer or mip of an attachment, say).
  [[nodiscard]] virtual bool opens_attachments() const { return false; }
  // Reason why this frame needs nothing from the pass ("no light casts shadows"), or empty. Pure: reads only
  // the frame input. The pass is then left out if every output is read-write (its source passes through) or
  // optional for whoever reads it; otherwise it runs all the same. Readers see connected() == false.
  [[nodiscard]] virtual std::string idle_reason(const FrameInput& frame) const { (void)frame; return {}; }
};

struct PassKind {
  std::string name{};    // "opaque_impostors"
  std::string summary{}; // one line
  std::function<std::unique_ptr<Pass>()> make{};
};

} // namespace mote::rg
