// SPDX-License-Identifier: MIT
// HDF5 files through the HDF5 library: groups, attributes and datasets as plain numbers and texts. A plain file is opened
// by its name, an unpacked one as an image in memory. Only built with MOTE_HDF5. No HDF5 type leaves this header's
// implementation; the library's own messages are silenced, and what it refuses becomes D041 or D006.
#pragma once

#include "core/data/bytes.hpp"
#include "core/data/dataset.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mote::data {

class Hdf5File {
public:
  explicit Hdf5File(std::shared_ptr<Bytes> bytes); // D041
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  [[nodiscard]] const std::string& name() const { return bytes_->name(); }
  [[nodiscard]] bool has(const std::string& path) const; // a group or dataset
  [[nodiscard]] std::vector<std::string> members(const std::string& group) const; // in alphabetical order
  [[nodiscard]] bool is_group(const std::string& path) const;

  // Lengths of a dataset's axes; empty for a single value or none at all.
  [[nodiscard]] std::vector<std::uint64_t> shape(const std::string& dataset) const;
  enum class Type : std::uint8_t { Real, Whole, Text, Other };
  [[nodiscard]] Type type(const std::string& dataset) const;
  // All values, or index `first` of the first axis only. D004 before memory is asked for, D041 when reading fails.
  [[nodiscard]] std::vector<double> reals(const std::string& dataset, std::optional<std::uint64_t> first = {}) const;
  [[nodiscard]] std::vector<std::int64_t> wholes(const std::string& dataset, std::optional<std::uint64_t> first = {}) const;
  // Values as a column of `components` a row; texts are not read.
  [[nodiscard]] Column column(const std::string& name, std::uint32_t components, const std::string& dataset, std::optional<std::uint64_t> first = {}) const;

  // Attributes of a group or dataset; nothing when there is none or it is of another kind.
  [[nodiscard]] std::vector<double> attribute_numbers(const std::string& path, const std::string& name) const;
  [[nodiscard]] std::vector<std::string> attribute_texts(const std::string& path, const std::string& name) const;

  [[noreturn]] void refuse(std::string_view code, const std::string& text, std::vector<std::string> hints = {}) const;

private:
  // D043 when the dataset `open` cannot have `count` values in a file of this size.
  void check_size(const std::string& dataset, std::int64_t open, std::uint64_t count) const;
  template <class T> std::vector<T> values(const std::string& dataset, std::optional<std::uint64_t> first, std::int64_t memory_type) const;
  std::shared_ptr<Bytes> bytes_;
  std::int64_t file_{-1};
};

} // namespace mote::data
