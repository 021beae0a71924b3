// SPDX-License-Identifier: MIT
#include "core/data/npy_header.hpp"

#include "core/data/codes.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <bit>

namespace mote::data {
namespace {

std::uint64_t little(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    value |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  return value;
}

// A reader of the few Python literals that headers have: strings, True, False, numbers, tuples, lists.
class Literals {
public:
  Literals(const Bytes& bytes, std::string_view text, std::uint64_t begin)
      : bytes_(bytes), text_(text), begin_(begin) {}

  [[noreturn]] void refuse(std::string text) const {
    fail(Exit::BadInput, code::npy_header, byte_place(bytes_, begin_ + at_),
         fmt::format("the .npy header is malformed: {}", text));
  }
  [[noreturn]] void refuse_type(std::string_view descr) const {
    fail(Exit::BadInput, code::npy_type, byte_place(bytes_, begin_ + at_),
         fmt::format("the element type {} cannot be read", shown(descr)),
         {"readable: f2 f4 f8, i1 i2 i4 i8, u1 u2 u4 u8, b1, and structures of these"});
  }
  char peek() {
    while (at_ < text_.size() && (is_space(text_[at_]) || text_[at_] == '\n')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) refuse(fmt::format("'{}' is missing", c));
  }
  std::string string() {
    const char mark = peek();
    if (mark != '\'' && mark != '"') refuse("a text in quotes is missing");
    const std::size_t end = text_.find(mark, ++at_);
    if (end == std::string_view::npos) refuse("a text is not closed");
    std::string out(text_.substr(at_, end - at_));
    at_ = end + 1;
    return out;
  }
  bool truth() {
    (void)peek();
    for (const std::string_view word : {"True", "False"})
      if (text_.substr(at_).starts_with(word)) {
        at_ += word.size();
        return word == "True";
      }
    refuse("True or False is missing");
  }
  std::uint64_t number() {
    (void)peek();
    std::size_t end = at_;
    while (end < text_.size() && text_[end] >= '0' && text_[end] <= '9') ++end;
    std::uint64_t value = 0;
    const std::string_view digits = text_.substr(at_, end - at_);
    if (!parse_count(digits, value)) refuse(fmt::format("{} is no size", shown(text_.substr(at_, 24))));
    at_ = end;
    if (at_ < text_.size() && text_[at_] == 'L') ++at_; // Python 2
    return value;
  }
  std::vector<std::uint64_t> tuple() {
    std::vector<std::uint64_t> out;
    expect('(');
    while (!accept(')')) {
      out.push_back(number());
      if (out.size() > 32) refuse("there are too many dimensions");
      if (!accept(',') && peek() != ')') refuse("',' or ')' is missing");
    }
    return out;
  }

private:
  const Bytes& bytes_;
  std::string_view text_;
  std::uint64_t begin_;
  std::size_t at_{};
};

NpyScalar scalar_of(Literals& in, const std::string& descr) {
  std::string_view rest = descr;
  NpyScalar out;
  out.big_endian = std::endian::native == std::endian::big;
  if (!rest.empty() && std::string_view("<>|=").find(rest[0]) != std::string_view::npos) {
    if (rest[0] != '|' && rest[0] != '=') out.big_endian = rest[0] == '>';
    rest.remove_prefix(1);
  }
  std::uint64_t size = 0;
  if (rest == "?") rest = "b1";
  if (rest.size() < 2 || !parse_count(rest.substr(1), size)) in.refuse_type(descr);
  const bool known = rest[0] == 'f'                     ? size == 2 || size == 4 || size == 8
                     : rest[0] == 'i' || rest[0] == 'u' ? size == 1 || size == 2 || size == 4 || size == 8
                                                        : rest[0] == 'b' && size == 1;
  if (!known) in.refuse_type(descr);
  out.kind = rest[0];
  out.size = static_cast<std::uint32_t>(size);
  return out;
}

// 'f4', or [('x', '<f4'), ('vel', '<f4', (3,)), ...]
void read_descr(Literals& in, NpyHeader& header) {
  if (!in.accept('[')) {
    header.fields.push_back({"", scalar_of(in, in.string()), 1, 0});
    header.item_size = header.fields.back().scalar.size;
    return;
  }
  header.structured = true;
  while (!in.accept(']')) {
    NpyField field;
    in.expect('(');
    field.name = in.string();
    in.expect(',');
    if (in.peek() == '[') in.refuse_type("a structure in a structure");
    const std::string descr = in.string();
    std::uint64_t components = 1;
    if (in.accept(',') && in.peek() == '(')
      for (const std::uint64_t size : in.tuple()) {
        if (size == 0 || size > max_fields || components * size > max_fields)
          in.refuse_type("a structure with an array of that size");
        components *= size;
      }
    in.expect(')');
    if (!in.accept(',') && in.peek() != ']') in.refuse("',' or ']' is missing");
    field.components = static_cast<std::uint32_t>(components);
    field.offset = header.item_size;
    std::uint64_t padding = 0;
    if (field.name.empty() && descr.starts_with("|V") &&
        parse_count(std::string_view(descr).substr(2), padding) && padding < (1u << 20)) {
      header.item_size += padding * components;
      continue;
    }
    field.scalar = scalar_of(in, descr);
    header.item_size += field.scalar.size * components;
    header.fields.push_back(std::move(field));
    if (header.fields.size() > max_fields) in.refuse_type("a structure with too many parts");
  }
}

} // namespace

NpyHeader parse_npy_header(const Bytes& bytes) {
  const std::string_view all = bytes.view();
  auto refuse = [&](std::uint64_t at, const std::string& text) {
    fail(Exit::BadInput, code::npy_header, byte_place(bytes, at), text);
  };
  if (all.size() < 10) refuse(all.size(), "the .npy header is cut off");
  const int version = static_cast<unsigned char>(all[6]);
  if (version < 1 || version > 3)
    refuse(6, fmt::format("the .npy version is '{}'; 1, 2 and 3 are known", version));
  const std::size_t width = version == 1 ? 2 : 4;
  if (all.size() < 8 + width) refuse(all.size(), "the .npy header is cut off");
  const std::uint64_t length = little(all.substr(8, width));
  const std::uint64_t begin = 8 + width;
  if (length > all.size() - begin)
    refuse(all.size(),
           fmt::format("the .npy header is cut off: it has {} bytes of {}", all.size() - begin, length));
  NpyHeader header;
  header.data_begin = begin + length;
  Literals in(bytes, all.substr(begin, length), begin);
  bool has_descr = false, has_order = false, has_shape = false;
  in.expect('{');
  while (!in.accept('}')) {
    const std::string key = in.string();
    in.expect(':');
    if (key == "descr" && !has_descr) {
      read_descr(in, header);
      has_descr = true;
    } else if (key == "fortran_order" && !has_order) {
      header.fortran_order = in.truth();
      has_order = true;
    } else if (key == "shape" && !has_shape) {
      header.shape = in.tuple();
      has_shape = true;
    } else {
      in.refuse(fmt::format("the key {} is unknown or there twice", shown(key)));
    }
    if (!in.accept(',') && in.peek() != '}') in.refuse("',' or '}' is missing");
  }
  if (!has_descr || !has_order || !has_shape) in.refuse("descr, fortran_order or shape is missing");
  return header;
}

} // namespace mote::data
