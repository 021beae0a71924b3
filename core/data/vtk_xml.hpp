// SPDX-License-Identifier: MIT
// The XML of VTK files as a tree, and the values of its DataArray elements: ascii, base64, appended base64
// or raw; whole or in compressed blocks (zlib, LZ4, LZMA); little and big endian; 32- and 64-bit headers.
// Raw appended data are no XML: they are cut off at the '_' before the parser sees the text.
//
// Errors: D061 (XML), D062 (a part is missing), D063 (base64), D060 (a block), D064 (another length), D065.
#pragma once

#include "core/data/fields.hpp"

#include <pugixml.hpp>

#include <string>
#include <string_view>

namespace mote::data {

class VtkXml {
public:
  explicit VtkXml(Bytes& bytes);

  [[nodiscard]] pugi::xml_node root() const { return root_; } // <VTKFile>
  [[nodiscard]] SourceLoc place(pugi::xml_node node) const;
  [[noreturn]] void refuse(pugi::xml_node node, std::string_view code, std::string text,
                           std::vector<std::string> hints = {}) const;

  // Attributes. A missing one is D062; so is one that is no number. `count` numbers in one attribute.
  [[nodiscard]] std::uint64_t count(pugi::xml_node node, const char* attribute) const;
  [[nodiscard]] std::vector<double> numbers(pugi::xml_node node, const char* attribute,
                                            std::size_t count) const;

  // The values of a DataArray of `rows` rows; texts (type String) give a Text column.
  [[nodiscard]] Column read(pugi::xml_node array, std::uint64_t rows) const;

private:
  enum class Compressor : std::uint8_t { None, Zlib, Lz4, Lzma };
  struct Feed; // the encoded text of one array
  void cut_appended();
  void read_head();
  [[nodiscard]] Feed feed_of(pugi::xml_node array) const;
  [[nodiscard]] std::uint64_t header_word(Feed& feed) const;
  [[nodiscard]] std::string whole(Feed& feed, std::uint64_t wanted, bool exact) const;
  [[nodiscard]] std::string blocks(Feed& feed, std::uint64_t wanted, bool exact) const;
  [[nodiscard]] Column ascii(pugi::xml_node array, const std::string& name, std::uint64_t rows,
                             std::uint32_t components, bool real) const;
  [[nodiscard]] Column texts(pugi::xml_node array, const std::string& name, std::uint64_t rows) const;

  const Bytes& bytes_;
  std::string xml_{}; // what pugixml reads; offsets in it are offsets in the file
  pugi::xml_document document_{};
  pugi::xml_node root_{};
  std::string_view appended_{};
  std::uint64_t appended_at_{}; // where in the file
  bool appended_base64_{};
  Order order_{Order::Little};
  std::uint32_t header_size_{4};
  Compressor compressor_{};
};

} // namespace mote::data
