// SPDX-License-Identifier: MIT
#include "core/image/deflate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <queue>

namespace mote {

namespace {
constexpr std::size_t block_bytes = 1u << 17; // input of one block: its codes fit its statistics
constexpr std::uint32_t end_of_block = 256, literal_codes = 286, shortest_run = 8, longest_run = 258;

// A token: a literal byte, or 256 + length - 3 for a run of the byte before it.
using Tokens = std::vector<std::uint16_t>;

struct LengthCode {
  std::uint32_t symbol{}, extra_bits{}, extra{};
};
// RFC 1951, 3.2.5: symbols 257..285 for lengths 3..258.
LengthCode length_code(std::uint32_t length) {
  if (length == 258) return {285, 0, 0};
  const std::uint32_t v = length - 3;
  if (v < 8) return {257 + v, 0, 0};
  const auto extra_bits = static_cast<std::uint32_t>(std::bit_width(v)) - 3;
  return {257 + 4 * extra_bits + (v >> extra_bits), extra_bits, v & ((1u << extra_bits) - 1u)};
}

class BitWriter {
public:
  explicit BitWriter(std::vector<std::byte>& out) : out_(out), at_(out.size()) {}
  // At most 32 bits a call.
  void put(std::uint64_t bits, std::uint32_t count) {
    held_ |= bits << used_;
    used_ += count;
    if (used_ >= 32) flush();
  }
  // Every token's bits, at most 21 each: two fit beside seven left over. Locals, because stores of
  // bytes may alias members and would force them to memory.
  void put_all(const std::vector<std::uint16_t>& tokens, const std::array<std::uint32_t, 512>& bits,
               const std::array<std::uint32_t, 512>& sizes) {
    flush();
    std::byte* to = out_.data() + at_;
    std::uint64_t held = held_;
    std::uint32_t used = used_;
    auto put_pair = [&](std::uint32_t a, std::uint32_t b) {
      held |= std::uint64_t{bits[a]} << used;
      used += sizes[a];
      held |= std::uint64_t{bits[b]} << used;
      used += sizes[b];
      std::memcpy(to, &held, 8);
      to += used / 8;
      held >>= used & ~7u;
      used &= 7u;
    };
    std::size_t i = 0;
    for (; i + 1 < tokens.size(); i += 2) put_pair(tokens[i], tokens[i + 1]);
    at_ = static_cast<std::size_t>(to - out_.data());
    held_ = held;
    used_ = used;
    if (i < tokens.size()) put(bits[tokens[i]], sizes[tokens[i]]);
  }
  void reserve(std::size_t bytes) { out_.resize(at_ + bytes + 16); }
  void finish() { // pads the last byte with zeros
    used_ = (used_ + 7) & ~7u;
    flush();
    out_.resize(at_);
  }

private:
  void flush() {
    std::memcpy(out_.data() + at_, &held_, 8);
    const std::uint32_t whole = used_ / 8;
    at_ += whole;
    held_ = whole == 8 ? 0 : held_ >> (8 * whole);
    used_ -= 8 * whole;
  }
  std::vector<std::byte>& out_;
  std::size_t at_;
  std::uint64_t held_{};
  std::uint32_t used_{};
};

// Huffman code lengths of at most `limit` bits. When the tree is deeper the counts are flattened.
std::vector<std::uint8_t> code_lengths(std::vector<std::uint32_t> counts, std::uint32_t limit) {
  const std::size_t n = counts.size();
  for (;;) {
    using Node = std::pair<std::uint64_t, std::uint32_t>; // weight, index: ties fall the same way everywhere
    std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
    for (std::uint32_t i = 0; i < n; ++i)
      if (counts[i] > 0) open.emplace(counts[i], i);
    std::vector<std::uint8_t> lengths(n, 0);
    if (open.size() == 1) {
      lengths[open.top().second] = 1;
      return lengths;
    }
    std::vector<std::uint32_t> parent(n);
    while (open.size() > 1) {
      const Node a = open.top();
      open.pop();
      const Node b = open.top();
      open.pop();
      const auto joined = static_cast<std::uint32_t>(parent.size());
      parent.push_back(0);
      parent[a.second] = parent[b.second] = joined;
      open.emplace(a.first + b.first, joined);
    }
    std::vector<std::uint32_t> depth(parent.size(), 0); // parents have larger indices than children
    std::uint32_t deepest = 0;
    for (std::size_t i = parent.size() - 1; i-- > 0;)
      if (i >= n || counts[i] > 0) {
        depth[i] = depth[parent[i]] + 1;
        deepest = std::max(deepest, depth[i]);
      }
    for (std::size_t i = 0; i < n; ++i) lengths[i] = static_cast<std::uint8_t>(depth[i]);
    if (deepest <= limit) return lengths;
    for (std::uint32_t& c : counts)
      if (c > 0) c = c / 2 + 1;
  }
}

// Canonical codes (RFC 1951, 3.2.2), bit-reversed as the stream wants them.
std::vector<std::uint32_t> codes_of(const std::vector<std::uint8_t>& lengths) {
  std::array<std::uint32_t, 17> next{};
  for (const std::uint8_t l : lengths) ++next[l + 1u];
  next[1] = 0; // unused symbols have no code
  for (std::size_t l = 2; l < next.size(); ++l) next[l] = (next[l - 1] + next[l]) << 1;
  std::vector<std::uint32_t> codes(lengths.size());
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    std::uint32_t code = lengths[i] > 0 ? next[lengths[i]]++ : 0;
    for (std::uint32_t k = 0; k < lengths[i]; ++k, code >>= 1) codes[i] = (codes[i] << 1) | (code & 1u);
  }
  return codes;
}

Tokens find_runs(std::span<const std::uint8_t> in) {
  Tokens tokens(in.size());
  std::size_t count = 0, i = 0;
  const std::uint8_t* p = in.data();
  auto eight_alike = [&](std::size_t at) { // the eight bytes from `at` equal the byte before
    std::uint64_t a, b;
    std::memcpy(&a, p + at, 8);
    std::memcpy(&b, p + at - 1, 8);
    return a == b;
  };
  while (i < in.size()) {
    if (i > 0 && i + shortest_run <= in.size() && eight_alike(i)) {
      std::size_t end = i + shortest_run;
      while (end + 8 <= in.size() && end + 8 - i <= longest_run && eight_alike(end)) end += 8;
      tokens[count++] = static_cast<std::uint16_t>(256 + (end - i) - 3);
      i = end;
    } else {
      tokens[count++] = p[i++];
    }
  }
  tokens.resize(count);
  return tokens;
}

// The code lengths in the header, with 16 (repeat the last), 17 and 18 (zeros); RFC 1951, 3.2.7.
struct LengthItem {
  std::uint8_t symbol{}, extra_bits{};
  std::uint32_t extra{};
};
std::vector<LengthItem> pack_lengths(const std::vector<std::uint8_t>& lengths) {
  std::vector<LengthItem> items;
  for (std::size_t i = 0; i < lengths.size();) {
    std::size_t run = 1;
    while (i + run < lengths.size() && lengths[i + run] == lengths[i]) ++run;
    const auto u = [](std::size_t v) { return static_cast<std::uint32_t>(v); };
    if (lengths[i] == 0 && run >= 11) {
      run = std::min<std::size_t>(run, 138);
      items.push_back({18, 7, u(run - 11)});
    } else if (lengths[i] == 0 && run >= 3) {
      items.push_back({17, 3, u(run - 3)});
    } else if (i > 0 && lengths[i] == lengths[i - 1] && run >= 3) {
      run = std::min<std::size_t>(run, 6);
      items.push_back({16, 2, u(run - 3)});
    } else {
      run = 1;
      items.push_back({lengths[i], 0, 0});
    }
    i += run;
  }
  return items;
}

void put_header(BitWriter& out, const std::vector<std::uint8_t>& lengths, bool final) {
  constexpr std::array<std::uint8_t, 19> order{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                               11, 4,  12, 3, 13, 2, 14, 1, 15};
  std::vector<std::uint8_t> all = lengths;
  all.push_back(1); // one distance code: distance 1, one bit
  const std::vector<LengthItem> items = pack_lengths(all);
  std::vector<std::uint32_t> counts(19);
  for (const LengthItem& item : items) ++counts[item.symbol];
  const auto item_lengths = code_lengths(counts, 7);
  const auto item_codes = codes_of(item_lengths);
  out.put(final ? 1 : 0, 1);
  out.put(2, 2); // dynamic codes
  out.put(literal_codes - 257, 5);
  out.put(0, 5);
  out.put(19 - 4, 4);
  for (const std::uint8_t symbol : order) out.put(item_lengths[symbol], 3);
  for (const LengthItem& item : items) {
    out.put(item_codes[item.symbol], item_lengths[item.symbol]);
    out.put(item.extra, item.extra_bits);
  }
}

void put_block(BitWriter& out, std::span<const std::uint8_t> input, bool final) {
  const Tokens tokens = find_runs(input);
  std::array<std::uint32_t, 512> used{};
  for (const std::uint16_t token : tokens) ++used[token];
  std::vector<std::uint32_t> counts(literal_codes);
  std::copy_n(used.begin(), 256, counts.begin());
  for (std::uint32_t length = 3; length <= longest_run; ++length)
    counts[length_code(length).symbol] += used[253 + length];
  counts[end_of_block] = 1;
  const auto lengths = code_lengths(counts, 15);
  const auto codes = codes_of(lengths);
  std::array<std::uint32_t, 512> bits{},
      sizes{}; // of whole tokens: code, extra bits, one zero for the distance
  for (std::uint32_t i = 0; i < 256; ++i) bits[i] = codes[i], sizes[i] = lengths[i];
  for (std::uint32_t length = 3; length <= longest_run; ++length) {
    const LengthCode c = length_code(length);
    bits[253 + length] = codes[c.symbol] | (c.extra << lengths[c.symbol]);
    sizes[253 + length] = lengths[c.symbol] + c.extra_bits + 1;
  }
  put_header(out, lengths, final);
  out.put_all(tokens, bits, sizes);
  out.put(codes[end_of_block], lengths[end_of_block]);
}
} // namespace

void deflate_runs(std::span<const std::uint8_t> input, bool last, std::vector<std::byte>& out) {
  BitWriter writer(out);
  const std::size_t blocks = (input.size() + block_bytes - 1) / block_bytes;
  writer.reserve(input.size() * 2 + (blocks + 1) * 512); // no literal code is longer than 15 bits
  for (std::size_t b = 0; b < blocks; ++b)
    put_block(writer, input.subspan(b * block_bytes, std::min(block_bytes, input.size() - b * block_bytes)),
              last && b + 1 == blocks);
  if (!last || blocks == 0) { // an empty stored block
    writer.put(last ? 1 : 0, 3);
    writer.finish();
    for (const int byte : {0x00, 0x00, 0xff, 0xff}) out.push_back(static_cast<std::byte>(byte));
  } else {
    writer.finish();
  }
}

} // namespace mote
