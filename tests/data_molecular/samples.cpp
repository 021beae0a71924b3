// SPDX-License-Identifier: MIT
#include "tests/data_molecular/samples.hpp"

#include <cmath>

namespace mote::data::test {
namespace {

// Bits, the most significant one first.
class Bits {
public:
  void put(std::uint64_t value, unsigned count) {
    for (unsigned k = count; k-- > 0;) {
      if (used_ % 8 == 0) bytes.push_back('\0');
      if ((value >> k) & 1) bytes.back() = static_cast<char>(bytes.back() | (1 << (7 - used_ % 8)));
      ++used_;
    }
  }
  void little(std::uint64_t value, unsigned count) { // bytes from the least significant on
    for (; count >= 8; count -= 8, value >>= 8) put(value & 0xff, 8);
    if (count) put(value, count);
  }
  std::string bytes{};

private:
  unsigned used_{};
};

// Positions in units of 1/1000, three of each kind in turn: alone, alone, with a run of two differences
// of at most 2^12 (index 39: size 8192); the second atom of such a group is written first.
std::string pack(const std::vector<std::int64_t>& whole, const std::int64_t low[3],
                 const std::int64_t size[3]) {
  Bits bits;
  unsigned width = 0;
  while ((std::uint64_t{1} << width) <= static_cast<std::uint64_t>(size[0] * size[1] * size[2])) ++width;
  auto full = [&](std::size_t atom) {
    std::int64_t digit[3];
    for (int k = 0; k < 3; ++k) digit[k] = whole[3 * atom + static_cast<std::size_t>(k)] - low[k];
    bits.little(static_cast<std::uint64_t>((digit[0] * size[1] + digit[1]) * size[2] + digit[2]), width);
  };
  auto difference = [&](std::size_t atom, std::size_t before) {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < 3; ++k)
      value = value * 8192 + static_cast<std::uint64_t>(whole[3 * atom + k] - whole[3 * before + k] + 4096);
    bits.little(value, 39);
  };
  const std::size_t atoms = whole.size() / 3;
  for (std::size_t a = 0; a < atoms;) {
    const bool group = a % 5 == 2 && a + 2 < atoms;
    full(group ? a + 1 : a);
    bits.put(1, 1);
    bits.put(group ? 6 + 1 : 0 + 1, 5); // run of values, index unchanged
    if (group) {
      difference(a, a + 1);
      difference(a + 2, a);
    }
    a += group ? 3 : 1;
  }
  return bits.bytes;
}

void put_packed(Maker& out, std::uint64_t frame, std::uint64_t atoms, bool long_size) {
  std::vector<std::int64_t> whole;
  for (std::uint64_t a = 0; a < atoms; ++a)
    for (int k = 0; k < 3; ++k) whole.push_back(std::llround(position(frame, a, k) * 1000));
  std::int64_t low[3], high[3], size[3];
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = high[k] = whole[k];
    for (std::size_t i = k; i < whole.size(); i += 3) {
      low[k] = std::min(low[k], whole[i]);
      high[k] = std::max(high[k], whole[i]);
    }
    size[k] = high[k] - low[k] + 1;
  }
  out.put<float>(1000.0f);
  for (const std::int64_t v : low) out.put(static_cast<std::int32_t>(v));
  for (const std::int64_t v : high) out.put(static_cast<std::int32_t>(v));
  out.put<std::int32_t>(39);
  const std::string bytes = pack(whole, low, size);
  if (long_size)
    out.put(static_cast<std::int64_t>(bytes.size()));
  else
    out.put(static_cast<std::int32_t>(bytes.size()));
  out.text(bytes, (bytes.size() + 3) / 4 * 4);
}

constexpr float box_edges[9]{64, 0, 0, 1, 65, 0, 2, 3, 66};

} // namespace

std::string make_xtc(std::uint64_t frames, std::uint64_t atoms, bool long_size) {
  Maker out(Order::Big);
  for (std::uint64_t f = 0; f < frames; ++f) {
    out.put<std::int32_t>(long_size ? 2023 : 1995).put(static_cast<std::int32_t>(atoms));
    out.put(static_cast<std::int32_t>(10 * f)).put(0.5f * static_cast<float>(f));
    for (const float v : box_edges) out.put(v);
    out.put(static_cast<std::int32_t>(atoms));
    if (atoms > 9) {
      put_packed(out, f, atoms, long_size);
      continue;
    }
    for (std::uint64_t a = 0; a < atoms; ++a)
      for (int k = 0; k < 3; ++k) out.put(static_cast<float>(position(f, a, k)));
  }
  return out.bytes;
}

std::string make_trr(std::uint64_t frames, std::uint64_t atoms, bool doubles, std::uint64_t without) {
  Maker out(Order::Big);
  const std::int32_t width = doubles ? 8 : 4, vectors = 3 * static_cast<std::int32_t>(atoms) * width;
  auto real = [&](double value) {
    doubles ? (void)out.put(value) : (void)out.put(static_cast<float>(value));
  };
  for (std::uint64_t f = 0; f < frames; ++f) {
    const bool positions = ((without >> f) & 1) == 0;
    out.put<std::int32_t>(1993).put<std::int32_t>(13).put<std::int32_t>(12).text("GMX_trn_file");
    for (const std::int32_t v : {0, 0, 9 * width, 0, 0, 0, 0, positions ? vectors : 0, vectors, 0})
      out.put(v);
    out.put(static_cast<std::int32_t>(atoms)).put(static_cast<std::int32_t>(10 * f)).put<std::int32_t>(0);
    real(0.5 * static_cast<double>(f));
    real(0);
    for (const float v : box_edges) real(static_cast<double>(v));
    for (int part = positions ? 0 : 1; part < 2; ++part)
      for (std::uint64_t a = 0; a < atoms; ++a)
        for (int k = 0; k < 3; ++k) real(part == 0 ? position(f, a, k) : -position(f, a, k));
  }
  return out.bytes;
}

std::string make_dcd(std::uint64_t frames, std::uint64_t atoms, const DcdKind& kind) {
  Maker out(kind.order);
  auto mark = [&](std::size_t length) {
    kind.width == 8 ? (void)out.put(static_cast<std::uint64_t>(length))
                    : (void)out.put(static_cast<std::uint32_t>(length));
  };
  auto record = [&](const Maker& content) {
    mark(content.bytes.size());
    out.text(content.bytes);
    mark(content.bytes.size());
  };
  Maker head(kind.order);
  head.text("CORD");
  for (int k = 0; k < 20; ++k) {
    std::int32_t value = 0;
    if (k == 0) value = static_cast<std::int32_t>(frames);
    if (k == 1) value = 100;
    if (k == 2) value = 10;
    if (k == 8 && !kind.free.empty()) value = static_cast<std::int32_t>(atoms - kind.free.size());
    if (k == 10) value = kind.cell;
    if (k == 19) value = 24;
    head.put(value);
  }
  record(head);
  Maker titles(kind.order), count(kind.order), free(kind.order);
  record(titles.put<std::int32_t>(1).text("made for the tests", 80));
  record(count.put(static_cast<std::int32_t>(atoms)));
  for (const std::int32_t number : kind.free) free.put(number);
  if (!kind.free.empty()) record(free);
  for (std::uint64_t f = 0; f < frames; ++f) {
    if (kind.cell) {
      Maker cell(kind.order);
      for (const double v : {10.0, 0.5, 20.0, 0.0, 0.0, 30.0}) cell.put(v); // gamma: cos 60 degrees
      record(cell);
    }
    for (int k = 0; k < 3; ++k) {
      Maker axis(kind.order);
      for (std::uint64_t a = 0; a < atoms; ++a) {
        bool moves = f == 0 || kind.free.empty();
        for (const std::int32_t number : kind.free)
          moves = moves || static_cast<std::uint64_t>(number - 1) == a;
        if (moves) axis.put(static_cast<float>(position(f, a, k)));
      }
      record(axis);
    }
  }
  return out.bytes;
}

std::string make_gsd(std::uint64_t frames, std::uint64_t atoms, std::uint32_t version) {
  const std::vector<std::string> names{
      "configuration/step", "configuration/box", "particles/N",       "particles/position",
      "particles/types",    "particles/typeid",  "bonds/N",           "bonds/group",
      "particles/diameter", "log/energy",        "log/particles/heat"};
  Maker out(Order::Little), index(Order::Little), chunks(Order::Little);
  const std::uint64_t names_at = 256, chunks_at = names_at + 64 * 16;
  std::uint64_t entries = 0;
  auto entry = [&](std::uint64_t frame, std::uint64_t rows, std::uint32_t columns, std::uint16_t name,
                   std::uint8_t type) {
    index.put(frame)
        .put(rows)
        .put(chunks_at + chunks.bytes.size())
        .put(columns)
        .put(name)
        .put(type)
        .put<std::uint8_t>(0);
    ++entries;
  };
  const auto count = static_cast<std::uint32_t>(atoms);
  for (std::uint64_t f = 0; f < frames; ++f) {
    entry(f, 1, 1, 0, 4), chunks.put(10 * f);
    if (f == 0) {
      entry(f, 6, 1, 1, 9);
      for (const float v : {10.0f, 20.0f, 30.0f, 0.5f, 0.0f, 0.25f}) chunks.put(v);
      entry(f, 1, 1, 2, 3), chunks.put(count);
    }
    entry(f, atoms, 3, 3, 9);
    for (std::uint64_t a = 0; a < atoms; ++a)
      for (int k = 0; k < 3; ++k) chunks.put(static_cast<float>(position(f, a, k)));
    if (f == 0) {
      entry(f, 2, 3, 4, 11), chunks.text("A", 3).text("Bb", 3);
      entry(f, atoms, 1, 5, 3);
      for (std::uint64_t a = 0; a < atoms; ++a) chunks.put(static_cast<std::uint32_t>(a % 2));
      entry(f, 1, 1, 6, 3), chunks.put<std::uint32_t>(1);
      entry(f, 1, 2, 7, 3), chunks.put<std::uint32_t>(1).put<std::uint32_t>(0);
      entry(f, atoms, 1, 8, 9);
      for (std::uint64_t a = 0; a < atoms; ++a) chunks.put(static_cast<float>(a) + 1.0f);
    }
    entry(f, 1, 1, 9, 10), chunks.put(1.5 * static_cast<double>(f));
    entry(f, atoms, 1, 10, 10);
    for (std::uint64_t a = 0; a < atoms; ++a) chunks.put(static_cast<double>(a + f));
  }
  out.put<std::uint64_t>(0x65DF65DF65DF65DF)
      .put(chunks_at + chunks.bytes.size())
      .put(entries + 2)
      .put(names_at);
  out.put<std::uint64_t>(16)
      .put<std::uint32_t>(0x10004)
      .put(version)
      .text("made for the tests", 64)
      .text("hoomd", 64)
      .text("", 80);
  Maker list(Order::Little);
  for (const std::string& name : names) list.text(name, (version >> 16) < 2 ? 64 : name.size() + 1);
  return out.text(list.bytes, 64 * 16).text(chunks.bytes).text(index.bytes).text("", 64).bytes;
}

std::string make_netcdf(std::uint64_t frames, std::uint64_t atoms, std::uint8_t version) {
  Maker out(Order::Big);
  auto size = [&](std::uint64_t value) {
    version == 5 ? (void)out.put(value) : (void)out.put(static_cast<std::uint32_t>(value));
  };
  auto name = [&](std::string_view text) {
    size(text.size());
    out.text(text, (text.size() + 3) / 4 * 4);
  };
  auto list = [&](std::uint32_t tag, std::uint64_t count) {
    out.put(tag);
    size(count);
  };
  out.text("CDF").put(version);
  size(frames);
  list(10, 4);
  const std::pair<const char*, std::uint64_t> dimensions[]{
      {"frame", 0}, {"atom", atoms}, {"spatial", 3}, {"cell_spatial", 3}};
  for (const auto& [label, length] : dimensions) {
    name(label);
    size(length);
  }
  list(12, 1);
  name("program");
  out.put<std::uint32_t>(2);
  name("tests");
  struct Variable {
    const char* label;
    std::vector<std::uint64_t> dimensions;
    std::uint32_t type;
    std::uint64_t bytes;
  };
  const std::vector<Variable> variables{{"time", {0}, 5, 4},
                                        {"coordinates", {0, 1, 2}, 5, 12 * atoms},
                                        {"cell_lengths", {0, 3}, 6, 24},
                                        {"mol", {0, 1}, 3, 2 * atoms}};
  // the header's length: everything so far, and the list of variables
  auto header = [&](std::uint64_t data_at) {
    Maker kept = out;
    list(11, variables.size());
    std::uint64_t at = data_at;
    for (const Variable& v : variables) {
      name(v.label);
      size(v.dimensions.size());
      for (const std::uint64_t d : v.dimensions) size(d);
      if (v.type == 5) {
        list(12, 2);
        name("units");
        out.put<std::uint32_t>(2);
        name(v.dimensions.size() == 1 ? "picosecond" : "angstrom");
        name("scale_factor");
        out.put<std::uint32_t>(6);
        size(1);
        out.put(v.dimensions.size() == 1 ? 1.0 : 2.0);
      } else {
        list(0, 0);
      }
      out.put(v.type);
      size((v.bytes + 3) / 4 * 4);
      version == 1 ? (void)out.put(static_cast<std::uint32_t>(at)) : (void)out.put(at);
      at += (v.bytes + 3) / 4 * 4;
    }
    std::string made = std::exchange(out, kept).bytes;
    return made;
  };
  const std::uint64_t length = header(0).size();
  Maker all(Order::Big);
  all.text(header(length));
  for (std::uint64_t f = 0; f < frames; ++f) {
    all.put(0.5f * static_cast<float>(f));
    for (std::uint64_t a = 0; a < atoms; ++a)
      for (int k = 0; k < 3; ++k) all.put(static_cast<float>(position(f, a, k) / 2));
    for (const double v : {10.0, 20.0, 30.0}) all.put(v);
    for (std::uint64_t a = 0; a < atoms; ++a) all.put(static_cast<std::int16_t>(a + 1));
    if (atoms % 2) all.put<std::int16_t>(0);
  }
  return all.bytes;
}

} // namespace mote::data::test
