// SPDX-License-Identifier: MIT
// Biological assemblies of an mmCIF file, from the categories pdbx_struct_assembly_gen and
// pdbx_struct_oper_list. reader_mmcif.cpp calls it. Errors D045.
#pragma once

#include "core/data/cif.hpp"
#include "core/data/dataset.hpp"

#include <vector>

namespace mote::data {

// `generators`: assembly_id, oper_expression, asym_id_list; `operators`: id, matrix[i][j], vector[i].
// Chains are those of the column chain_label.
std::vector<Assembly> read_cif_assemblies(const std::string& file, const CifTable& generators,
                                          const CifTable& operators);

// The identifiers of "(1-3,X0)(7)": groups whose operators multiply, the last one acts first.
// At most `limit` in one group; an empty result is a malformed expression.
[[nodiscard]] std::vector<std::vector<std::string>> parse_oper_expression(std::string_view expression,
                                                                          std::uint64_t limit);

} // namespace mote::data
