// SPDX-License-Identifier: MIT
// Files to start from, by format: those of the tests, and binary samples made in memory.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace mote::fuzz {

struct Input {
  std::string name{}, extension{}, content{};
};

// Small files under tests/ and the samples, by the format that reads them; larger ones than `most` bytes are left out.
// The working directory becomes that of the files, because a heading of raw numbers (`raw`) names its file beside it.
std::map<std::string, std::vector<Input>> inputs_by_format(std::size_t most = 40000);

// All readers but HDF5's, which has a library and tests of its own; and a name as one of a test.
std::vector<std::string> reader_names();
std::string word_of(std::string name);

} // namespace mote::fuzz
