// SPDX-License-Identifier: MIT
#include "core/data/zip.hpp"

#include "core/data/binary.hpp"
#include "core/data/blocks.hpp"
#include "core/data/codes_fields.hpp"
#include "core/data/fields.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>

namespace mote::data {
namespace {

constexpr std::uint32_t top32 = 0xffffffff;

void expect_mark(ByteReader& in, std::uint32_t wanted, std::string_view what) {
  const std::uint64_t at = in.at();
  if (in.number<std::uint32_t>(what) != wanted)
    in.refuse_at(at, field_code::packed, fmt::format("the archive is damaged: {} does not begin here", what));
}

// Where the central directory begins and how many members it has.
struct Directory {
  std::uint64_t begin{}, count{};
};
Directory find_directory(const Bytes& archive) {
  const std::string_view all = archive.view();
  const std::size_t end = all.rfind(std::string_view("PK\5\6", 4));
  if (end == std::string_view::npos || all.size() - end < 22)
    fail(Exit::BadInput, code::ends_early, byte_place(archive, all.size()),
         "the archive ends early: its directory is missing");
  ByteReader in(archive, Order::Little, end + 10);
  Directory out;
  out.count = in.number<std::uint16_t>("the number of members");
  in.skip(4, "the directory");
  out.begin = in.number<std::uint32_t>("the place of the directory");
  if (out.begin != top32 && out.count != 0xffff) return out;
  if (end < 20) in.refuse_at(end, field_code::packed, "the archive is damaged: the zip64 locator is missing");
  in.seek(end - 20);
  expect_mark(in, 0x07064b50, "the zip64 locator");
  in.skip(4, "the zip64 locator");
  in.seek(in.number<std::uint64_t>("the zip64 locator"));
  expect_mark(in, 0x06064b50, "the zip64 directory end");
  in.skip(28, "the zip64 directory end");
  out.count = in.number<std::uint64_t>("the number of members");
  in.skip(8, "the zip64 directory end");
  out.begin = in.number<std::uint64_t>("the place of the directory");
  return out;
}

// 64-bit sizes stand in the extra field 1, those of them that do not fit 32 bits.
void read_extra(ByteReader& in, std::uint64_t end, ZipMember& member) {
  while (in.at() + 4 <= end) {
    const auto id = in.number<std::uint16_t>("an extra field");
    const auto size = in.number<std::uint16_t>("an extra field");
    const std::uint64_t next = in.at() + size;
    if (id == 1)
      for (std::uint64_t* value : {&member.size, &member.packed, &member.header})
        if (*value == top32 && in.at() + 8 <= next) *value = in.number<std::uint64_t>("a zip64 size");
    in.seek(next);
  }
}

} // namespace

std::vector<ZipMember> zip_members(const Bytes& archive) {
  const Directory directory = find_directory(archive);
  ByteReader in(archive, Order::Little, directory.begin);
  if (directory.count > in.left() / 46)
    in.refuse(code::ends_early,
              fmt::format("the archive ends early: {} members are announced, but {} bytes are left",
                          directory.count, in.left()));
  std::vector<ZipMember> out(directory.count);
  for (ZipMember& member : out) {
    expect_mark(in, 0x02014b50, "an entry of the directory");
    in.skip(4, "an entry of the directory");
    member.flags = in.number<std::uint16_t>("an entry of the directory");
    member.method = in.number<std::uint16_t>("an entry of the directory");
    in.skip(4, "an entry of the directory");
    member.check = in.number<std::uint32_t>("an entry of the directory");
    member.packed = in.number<std::uint32_t>("an entry of the directory");
    member.size = in.number<std::uint32_t>("an entry of the directory");
    const auto name = in.number<std::uint16_t>("an entry of the directory");
    const auto extra = in.number<std::uint16_t>("an entry of the directory");
    const auto comment = in.number<std::uint16_t>("an entry of the directory");
    in.skip(8, "an entry of the directory");
    member.header = in.number<std::uint32_t>("an entry of the directory");
    member.name = in.take(name, "the name of a member");
    const std::uint64_t end = in.at() + extra;
    read_extra(in, end, member);
    in.seek(end);
    in.skip(comment, "the comment of a member");
  }
  return out;
}

std::string unzip(const Bytes& archive, const ZipMember& member) {
  ByteReader in(archive, Order::Little, member.header);
  expect_mark(in, 0x04034b50, fmt::format("the member {}", shown(member.name)));
  if (member.flags & 1)
    in.refuse_at(member.header, field_code::variant,
                 fmt::format("the member {} is encrypted", shown(member.name)));
  in.skip(22, "the header of a member");
  const auto name = in.number<std::uint16_t>("the header of a member");
  const auto extra = in.number<std::uint16_t>("the header of a member");
  in.skip(std::uint64_t{name} + extra, "the header of a member");
  const std::uint64_t begin = in.at();
  const std::string_view packed = in.take(member.packed, fmt::format("the member {}", shown(member.name)));
  if (member.method != 0 && member.method != 8)
    in.refuse_at(begin, field_code::variant,
                 fmt::format("the member {} is packed by method '{}', which cannot be read",
                             shown(member.name), member.method),
                 {"readable: 0 (stored), 8 (deflated)"});
  const bool possible = member.method == 0 ? member.size == member.packed
                                           : member.size / 1040 <= member.packed; // deflate: at most 1032 : 1
  if (!possible)
    in.refuse_at(begin, field_code::packed,
                 fmt::format("the member {} has {} bytes packed as {}, which is impossible",
                             shown(member.name), member.size, member.packed));
  need_memory(member.size, byte_place(archive, begin), fmt::format("the values of {}", shown(member.name)));
  std::string out(packed);
  if (member.method == 8) {
    out.assign(member.size, '\0');
    if (!unpack_deflate(packed, out))
      in.refuse_at(begin, field_code::packed, fmt::format("the member {} is damaged", shown(member.name)));
  }
  uLong check = ::crc32(0, nullptr, 0);
  for (std::size_t at = 0; at < out.size(); at += 1u << 30)
    check = ::crc32(check, reinterpret_cast<const Bytef*>(out.data() + at),
                    static_cast<uInt>(std::min<std::size_t>(1u << 30, out.size() - at)));
  if (check != member.check)
    in.refuse_at(begin, field_code::packed,
                 fmt::format("the member {} is damaged: its check sum differs", shown(member.name)));
  return out;
}

} // namespace mote::data
