// SPDX-License-Identifier: MIT
// How a format joins: one file reader_NAME.cpp that defines NAME_reader(), and one line in the list of
// registry.cpp. open() asks every reader how sure it is of the first bytes; the surest one reads. The
// extension of the name decides only between equally sure readers.
#pragma once

#include "core/data/bytes.hpp"
#include "core/data/source.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace mote::data {

// What a reader sees when it is asked whether a file is its own.
struct Probe {
  std::string_view head{};      // at most the first 64 KiB, gzip looked through
  std::string_view extension{}; // lower case, without dot and without .gz
};

enum class Sureness : std::uint8_t {
  No,      // cannot be
  ByName,  // only if the extension is one of the format's
  Likely,  // looks like it
  Certain, // a magic word
};

struct Reader {
  Format format{};
  Sureness (*probe)(const Probe&){};
  std::unique_ptr<Source> (*make)(std::shared_ptr<Bytes>){};
};

// The source for bytes that are there already; `extension` as in Probe. D005 if no reader wants them.
std::unique_ptr<Source> open_bytes(std::shared_ptr<Bytes> bytes, std::string_view extension);

} // namespace mote::data
