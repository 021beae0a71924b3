// SPDX-License-Identifier: MIT
#include "core/data/cif_assembly.hpp"

#include "core/data/codes_molecular.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace mote::data {
namespace {

constexpr std::uint64_t most_transforms = 1000000; // of one part; the largest capsids have thousands

using Operators = std::map<std::string, glm::dmat4, std::less<>>;

Operators read_operators(const std::string& file, const CifTable& table) {
  Operators out;
  for (std::uint64_t row = 0; row < table.rows(); ++row) {
    const CifToken* id = table.value(row, "id");
    if (!id) continue;
    glm::dmat4 matrix(1.0);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) {
        const std::string item =
            c < 3 ? fmt::format("matrix[{}][{}]", r + 1, c + 1) : fmt::format("vector[{}]", r + 1);
        const CifToken* value = table.value(row, item);
        if (!value || !cif_real(*value, matrix[c][r]))
          fail(Exit::BadInput, molecule_code::assembly, {file, id->line, id->column},
               fmt::format("operator {} has no number for {}{}", shown(id->text), item,
                           value ? ": " + shown(value->text) : ""));
      }
    out[std::string(id->text)] = matrix;
  }
  return out;
}

// "a-b" with two numbers is a range.
bool add_item(std::string_view item, std::uint64_t limit, std::vector<std::string>& out) {
  const std::size_t dash = item.find('-');
  std::uint64_t first = 0, last = 0;
  if (dash != std::string_view::npos && parse_count(trim(item.substr(0, dash)), first) &&
      parse_count(trim(item.substr(dash + 1)), last)) {
    if (last < first || last - first >= limit) return false;
    for (std::uint64_t id = first; id <= last; ++id) out.push_back(fmt::format("{}", id));
  } else if (!trim(item).empty()) {
    out.emplace_back(trim(item));
  }
  return out.size() <= limit;
}

std::vector<glm::dmat4> expand(const std::string& file, const CifToken& expression,
                               const Operators& operators) {
  const auto groups = parse_oper_expression(expression.text, most_transforms);
  const SourceLoc loc{file, expression.line, expression.column};
  if (groups.empty())
    fail(Exit::BadInput, molecule_code::assembly, loc,
         fmt::format("the operators {} of an assembly are malformed", shown(expression.text)));
  std::vector<glm::dmat4> out{glm::dmat4(1.0)};
  for (const auto& group : groups) {
    if (out.size() * group.size() > most_transforms)
      fail(Exit::BadInput, molecule_code::assembly, loc,
           fmt::format("the operators {} of an assembly are more than {}", shown(expression.text),
                       most_transforms));
    std::vector<glm::dmat4> product;
    product.reserve(out.size() * group.size());
    for (const glm::dmat4& left : out)
      for (const std::string& id : group) {
        const auto found = operators.find(id);
        if (found == operators.end()) {
          std::vector<std::string> known;
          for (const auto& [name, matrix] : operators) known.size() < 20 ? known.push_back(name) : void();
          fail(Exit::BadInput, molecule_code::assembly, loc,
               fmt::format("an assembly names operator '{}', which is not there", id),
               {"operators: " + list_of(known)});
        }
        product.push_back(left * found->second);
      }
    out = std::move(product);
  }
  return out;
}

} // namespace

std::vector<std::vector<std::string>> parse_oper_expression(std::string_view expression,
                                                            std::uint64_t limit) {
  std::vector<std::vector<std::string>> groups;
  std::string_view rest = trim(expression);
  while (!rest.empty()) {
    const bool inside = rest.front() == '(';
    if (inside) rest.remove_prefix(1);
    const std::size_t end = std::min(rest.find(inside ? ')' : '('), rest.size());
    if (inside && end == rest.size()) return {};
    std::string_view list = rest.substr(0, end);
    rest = trim(rest.substr(std::min(end + (inside ? 1 : 0), rest.size())));
    std::vector<std::string> group;
    while (!list.empty()) {
      const std::size_t comma = std::min(list.find(','), list.size());
      if (list.substr(0, comma).find_first_of("()") != std::string_view::npos ||
          !add_item(list.substr(0, comma), limit, group))
        return {};
      list.remove_prefix(std::min(comma + 1, list.size()));
    }
    if (group.empty()) return {};
    groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<Assembly> read_cif_assemblies(const std::string& file, const CifTable& generators,
                                          const CifTable& operator_table) {
  std::vector<Assembly> out;
  const Operators operators = read_operators(file, operator_table);
  for (std::uint64_t row = 0; row < generators.rows(); ++row) {
    const CifToken* id = generators.value(row, "assembly_id");
    const CifToken* expression = generators.value(row, "oper_expression");
    const CifToken* chains = generators.value(row, "asym_id_list");
    if (!id || !expression) continue;
    auto assembly =
        std::find_if(out.begin(), out.end(), [&](const Assembly& a) { return a.name == id->text; });
    if (assembly == out.end()) assembly = out.insert(out.end(), {std::string(id->text), "chain_label", {}});
    AssemblyPart part;
    part.transforms = expand(file, *expression, operators);
    std::string_view list = chains ? chains->text : std::string_view{};
    while (!list.empty()) {
      const std::size_t comma = std::min(list.find(','), list.size());
      if (const std::string_view chain = trim(list.substr(0, comma)); !chain.empty())
        part.chains.emplace_back(chain);
      list.remove_prefix(std::min(comma + 1, list.size()));
    }
    assembly->parts.push_back(std::move(part));
  }
  return out;
}

} // namespace mote::data
