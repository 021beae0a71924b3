// SPDX-License-Identifier: MIT
// SpirvCache. An entry's name is the hash of the source as given; since includes decide the result as
// well, the entry lists each include with the hash of its text, and is used only if all still match.
#include "core/gpu/cache_file.hpp"
#include "core/gpu/shader_compiler.hpp"

#include <fmt/format.h>
#include <glslang/build_info.h>

#include <algorithm>
#include <cstring>

namespace mote::gpu {
namespace {

constexpr std::uint32_t entry_version = 1; // of this file's format and of the compiler options
constexpr std::uint32_t magic = 0x4D535056; // "VPSM"

struct UsedInclude {
  std::string name{}, from{};
  std::uint64_t hash{};
};

std::uint64_t source_hash(ShaderStage stage, const GlslSource& source, std::span<const ShaderDefine> defines) {
  std::uint64_t hash = hash_text(fmt::format("{}.{}.{} {} {}", GLSLANG_VERSION_MAJOR, GLSLANG_VERSION_MINOR, GLSLANG_VERSION_PATCH,
                                             entry_version, to_string(stage)));
  hash = hash_text(source.name, hash);
  hash = hash_text(source.text, hash);
  for (const ShaderDefine& d : defines) hash = hash_text(d.value, hash_text(d.name, hash));
  return hash;
}

void put(std::vector<std::byte>& out, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::byte*>(data);
  out.insert(out.end(), bytes, bytes + size);
}
void put_text(std::vector<std::byte>& out, std::string_view text) {
  const auto size = static_cast<std::uint32_t>(text.size());
  put(out, &size, sizeof size);
  put(out, text.data(), text.size());
}

std::vector<std::byte> pack(std::uint64_t key, std::span<const UsedInclude> includes, std::span<const std::uint32_t> spirv) {
  std::vector<std::byte> body;
  put(body, &key, sizeof key);
  const auto count = static_cast<std::uint32_t>(includes.size());
  put(body, &count, sizeof count);
  for (const UsedInclude& i : includes) {
    put_text(body, i.name);
    put_text(body, i.from);
    put(body, &i.hash, sizeof i.hash);
  }
  const auto words = static_cast<std::uint32_t>(spirv.size());
  put(body, &words, sizeof words);
  put(body, spirv.data(), spirv.size_bytes());
  std::vector<std::byte> file;
  const std::uint64_t checksum = hash_bytes(body);
  put(file, &magic, sizeof magic);
  put(file, &checksum, sizeof checksum);
  put(file, body.data(), body.size());
  return file;
}

// Reads front to back; anything that does not fit turns it bad.
class Reader {
public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  bool get(void* out, std::size_t size) {
    if (size > bytes_.size()) return false;
    std::memcpy(out, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
    return true;
  }
  bool get_text(std::string& out) {
    std::uint32_t size = 0;
    if (!get(&size, sizeof size) || size > bytes_.size()) return false;
    out.resize(size);
    return get(out.data(), size);
  }
  [[nodiscard]] std::span<const std::byte> rest() const { return bytes_; }

private:
  std::span<const std::byte> bytes_;
};

// The SPIR-V of an entry whose checksum, key and includes are right.
std::vector<std::uint32_t> unpack(std::uint64_t key, std::span<const std::byte> file, const IncludeCallback& include) {
  Reader in(file);
  std::uint32_t found_magic = 0, count = 0, words = 0;
  std::uint64_t checksum = 0, found_key = 0;
  if (!in.get(&found_magic, sizeof found_magic) || !in.get(&checksum, sizeof checksum) || found_magic != magic ||
      checksum != hash_bytes(in.rest()) || !in.get(&found_key, sizeof found_key) || found_key != key || !in.get(&count, sizeof count)) {
    return {};
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    UsedInclude used;
    if (!in.get_text(used.name) || !in.get_text(used.from) || !in.get(&used.hash, sizeof used.hash)) return {};
    const auto now = include ? include(used.name, used.from) : std::nullopt;
    if (!now || hash_text(now->text, hash_text(now->name)) != used.hash) return {};
  }
  if (!in.get(&words, sizeof words) || in.rest().size() != std::size_t{words} * 4) return {};
  std::vector<std::uint32_t> spirv(words);
  in.get(spirv.data(), in.rest().size());
  return spirv;
}

} // namespace

CompiledShader SpirvCache::compile(ShaderStage stage, const GlslSource& source, std::span<const ShaderDefine> defines, const IncludeCallback& include) {
  if (directory_.empty()) return compile_glsl(stage, source, defines, include);
  const std::uint64_t key = source_hash(stage, source, defines);
  const std::string path = fmt::format("{}/{:016x}.spv", directory_, key);
  if (const auto file = read_cache_file(path)) {
    CompiledShader cached;
    cached.spirv = unpack(key, *file, include);
    cached.from_cache = true;
    if (cached) {
      ++hits_;
      return cached;
    }
  }
  ++misses_;
  std::vector<UsedInclude> used;
  const IncludeCallback spy = [&](const std::string& name, const std::string& from) -> std::optional<GlslSource> {
    auto found = include ? include(name, from) : std::nullopt;
    if (found) used.push_back({name, from, hash_text(found->text, hash_text(found->name))});
    return found;
  };
  CompiledShader compiled = compile_glsl(stage, source, defines, spy);
  if (compiled && compiled.messages.empty()) write_cache_file(path, pack(key, used, compiled.spirv)); // warnings must not get lost
  return compiled;
}

} // namespace mote::gpu
