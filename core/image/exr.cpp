// SPDX-License-Identifier: MIT
#include "core/image/exr.hpp"

#include "core/base/atomic_file.hpp"
#include "core/base/diagnostic.hpp"
#include "core/image/read_file.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <span>
#include <thread>

namespace mote {

namespace {
void start_threads() {
  static std::once_flag once;
  std::call_once(once, [] {
    Imf::setGlobalThreadCount(static_cast<int>(std::min(4u, std::thread::hardware_concurrency())));
  });
}

class MemoryOut : public Imf::OStream {
public:
  explicit MemoryOut(const char* name) : OStream(name) {}
  void write(const char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (at_ + count > bytes.size()) bytes.resize(at_ + count);
    std::memcpy(bytes.data() + at_, c, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }
  std::vector<std::byte> bytes{};

private:
  std::size_t at_{};
};

class MemoryIn : public Imf::IStream {
public:
  MemoryIn(const char* name, std::span<const std::byte> bytes) : IStream(name), bytes_(bytes) {}
  bool read(char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (count > bytes_.size() - at_) throw std::runtime_error("the file ends too early");
    std::memcpy(c, bytes_.data() + at_, count);
    at_ += count;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = std::min<std::uint64_t>(at, bytes_.size()); }

private:
  std::span<const std::byte> bytes_;
  std::size_t at_{};
};

half to_half(float v) {
  constexpr float most = 65504.0f;
  return half(std::isfinite(v) ? std::clamp(v, -most, most) : v);
}

Imf::PixelType pixel_type(ExrType type) {
  return type == ExrType::Half ? Imf::HALF : type == ExrType::Float ? Imf::FLOAT : Imf::UINT;
}

void check_planes(const std::string& path, std::uint32_t width, std::uint32_t height,
                  const std::vector<ExrPlane>& planes) {
  constexpr std::uint32_t most = std::numeric_limits<std::int32_t>::max() / 2;
  if (width == 0 || height == 0 || width > most || height > most || planes.empty())
    fail(Exit::Failed, "I008", {path},
         fmt::format("a picture of {} x {} pixels and {} channels cannot be stored as EXR", width, height,
                     planes.size()));
  std::set<std::string> names;
  for (const ExrPlane& plane : planes) {
    const bool filled = plane.type == ExrType::Uint ? plane.uints != nullptr : plane.floats != nullptr;
    if (plane.name.empty() || !names.insert(plane.name).second || !filled)
      fail(Exit::Failed, "I008", {path},
           fmt::format("the EXR channel '{}' has no name of its own or no values", plane.name));
  }
}

// The picture as it goes into the file; `halves` keeps converted planes alive.
Imf::FrameBuffer frame_of(std::uint32_t width, std::size_t count, const std::vector<ExrPlane>& planes,
                          std::vector<std::vector<half>>& halves) {
  Imf::FrameBuffer frame;
  for (const ExrPlane& plane : planes) {
    const char* base = nullptr;
    std::size_t step = 4 * plane.stride;
    if (plane.type == ExrType::Half) {
      std::vector<half>& converted = halves.emplace_back(count);
      for (std::size_t i = 0; i < count; ++i) converted[i] = to_half(plane.floats[i * plane.stride]);
      base = reinterpret_cast<const char*>(converted.data());
      step = sizeof(half);
    } else {
      base = plane.type == ExrType::Float ? reinterpret_cast<const char*>(plane.floats)
                                          : reinterpret_cast<const char*>(plane.uints);
    }
    frame.insert(plane.name,
                 Imf::Slice(pixel_type(plane.type), const_cast<char*>(base), step, step * width)); // NOLINT
  }
  return frame;
}

ExrPicture read_stream(MemoryIn& stream) {
  Imf::InputFile file(stream);
  const auto window = file.header().dataWindow();
  ExrPicture out;
  out.width = static_cast<std::uint32_t>(window.max.x - window.min.x + 1);
  out.height = static_cast<std::uint32_t>(window.max.y - window.min.y + 1);
  const std::size_t count = std::size_t{out.width} * out.height, row = std::size_t{out.width} * 4;
  if (count > (std::size_t{1} << 28)) throw std::runtime_error("the picture has more than 2^28 pixels");
  const Imf::ChannelList& list = file.header().channels();
  for (auto it = list.begin(); it != list.end(); ++it) {
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
      throw std::runtime_error(fmt::format("the channel '{}' is subsampled", it.name()));
    const Imf::PixelType type = it.channel().type;
    ExrChannel channel{it.name(), type == Imf::UINT   ? ExrType::Uint
                                  : type == Imf::HALF ? ExrType::Half
                                                      : ExrType::Float};
    (type == Imf::UINT) ? channel.uints.resize(count) : channel.floats.resize(count);
    out.channels.push_back(std::move(channel));
  }
  Imf::FrameBuffer frame;
  for (ExrChannel& c : out.channels) {
    const bool is_uint = c.type == ExrType::Uint;
    char* base = is_uint ? reinterpret_cast<char*>(c.uints.data()) : reinterpret_cast<char*>(c.floats.data());
    // a slice's base is the address of pixel (0, 0), which may lie outside the window
    const std::ptrdiff_t shift =
        window.min.x * std::ptrdiff_t{4} + window.min.y * static_cast<std::ptrdiff_t>(row);
    frame.insert(c.name, Imf::Slice(is_uint ? Imf::UINT : Imf::FLOAT, base - shift, 4, row));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  for (auto it = file.header().begin(); it != file.header().end(); ++it)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
      out.attributes.emplace_back(it.name(), text->value());
  return out;
}
} // namespace

void write_exr(const std::string& path, std::uint32_t width, std::uint32_t height,
               const std::vector<ExrPlane>& planes, const ExrAttributes& attributes) {
  check_planes(path, width, height, planes);
  start_threads();
  Imf::Header header(static_cast<int>(width), static_cast<int>(height));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = 1;
  for (const auto& [name, value] : attributes) header.insert(name, Imf::StringAttribute(value));
  for (const ExrPlane& plane : planes)
    header.channels().insert(plane.name, Imf::Channel(pixel_type(plane.type)));
  MemoryOut stream(path.c_str());
  std::vector<std::vector<half>> halves;
  const Imf::FrameBuffer frame = frame_of(width, std::size_t{width} * height, planes, halves);
  try {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(static_cast<int>(height));
  } catch (const std::exception& e) {
    fail(Exit::Failed, "I008", {path}, fmt::format("the picture cannot be stored as EXR: {}", e.what()));
  }
  write_file(path, stream.bytes);
}

const ExrChannel* ExrPicture::find(const std::string& name) const {
  const auto it =
      std::find_if(channels.begin(), channels.end(), [&](const ExrChannel& c) { return c.name == name; });
  return it == channels.end() ? nullptr : &*it;
}

ExrPicture read_exr(const std::string& path) {
  const std::vector<std::byte> bytes = read_whole_file(path);
  MemoryIn stream(path.c_str(), bytes);
  try {
    return read_stream(stream);
  } catch (const std::exception& e) {
    fail(Exit::BadInput, "I006", {path}, fmt::format("the file is no readable EXR picture: {}", e.what()));
  }
}

} // namespace mote
