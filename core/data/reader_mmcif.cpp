// SPDX-License-Identifier: MIT
// mmCIF (PDBx), the Protein Data Bank's own format (mmcif.wwpdb.org). Read: atom_site with its models
// as frames, atom_site_anisotrop, cell, assemblies, title. Categories may stand in any order, so that
// the whole file is looked through once, before the first frame; of the atoms only the place of each
// model is kept. Chains: `chain` is the author's name, `chain_label` that of the assemblies. Lengths in A.
#include "core/data/cif.hpp"
#include "core/data/cif_assembly.hpp"
#include "core/data/cif_atoms.hpp"
#include "core/data/codes_molecular.hpp"
#include "core/data/molecule.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace mote::data {
namespace {

// Rows of one model that stand behind each other.
struct Stretch {
  CifScanner begin;
  std::uint64_t rows{};
};
struct Model {
  std::string number{};
  std::vector<Stretch> stretches{};
};

constexpr std::array<std::string_view, 7> small_categories{"cell",
                                                           "symmetry",
                                                           "struct",
                                                           "entry",
                                                           "pdbx_struct_assembly_gen",
                                                           "pdbx_struct_oper_list",
                                                           "atom_site_anisotrop"};

class MmcifSource : public Source {
public:
  explicit MmcifSource(std::shared_ptr<Bytes> bytes) : bytes_(std::move(bytes)) {
    warnings_.append(bytes_->warnings());
  }
  std::string_view format() const override { return "mmcif"; }
  std::uint64_t frame_count() override {
    look_through();
    return models_.size();
  }
  Frame read(std::uint64_t frame) override {
    look_through();
    if (frame >= models_.size())
      fail(Exit::BadInput, code::no_frame, {bytes_->name()},
           fmt::format("there is no frame {}: the file has {} (0 to {})", frame, models_.size(),
                       models_.size() - 1));
    return read_model(models_[frame]);
  }

private:
  void look_through() {
    if (!models_.empty()) return;
    CifScanner scanner(bytes_->name(), bytes_->text());
    CifToken token = scanner.next();
    bool ended = false;
    while (token.kind != CifToken::Kind::End && !ended) {
      switch (token.kind) {
      case CifToken::Kind::Loop: token = read_loop(scanner); break;
      case CifToken::Kind::Tag: token = read_pair(scanner, token); break;
      case CifToken::Kind::Data:
        ended = !models_.empty();
        if (ended)
          warnings_.warning(code::trailing, scanner.place(token),
                            fmt::format("data behind the first structure ({}) are ignored", token.text));
        token = scanner.next();
        break;
      case CifToken::Kind::Save: token = scanner.next(); break;
      case CifToken::Kind::Value:
      case CifToken::Kind::End:
        fail(Exit::BadInput, molecule_code::cif_syntax, scanner.place(token),
             fmt::format("the value {} belongs to no tag", shown(token.text)));
      }
    }
    if (scanner.touches_end())
      warnings_.warning(molecule_code::last_line, scanner.place(token),
                        "the last line has no line end and may be cut off");
    finish();
  }

  void finish() {
    if (models_.empty() && !single_atom_.values.empty()) {
      atom_items_ = single_atom_.items;
      check_atom_items({bytes_->name()});
      models_.push_back({"1", {}});
    }
    if (models_.empty())
      fail(Exit::BadInput, code::no_position, {bytes_->name()},
           core_cif_ ? "the file is a CIF of small molecules (_atom_site_fract_x); mmCIF "
                       "(_atom_site.Cartn_x) is read"
                     : "there is no category _atom_site");
    assemblies_ = read_cif_assemblies(bytes_->name(), tables_["pdbx_struct_assembly_gen"],
                                      tables_["pdbx_struct_oper_list"]);
    read_cell();
  }

  // "_cell.length_a" -> cell, length_a. Tags of other dictionaries have no dot.
  static std::pair<std::string, std::string_view> split(std::string_view tag) {
    const std::size_t dot = std::min(tag.find('.'), tag.size());
    return {lower(tag.substr(1, std::max<std::size_t>(dot, 1) - 1)),
            tag.substr(std::min(dot + 1, tag.size()))};
  }
  CifTable* kept(const std::string& category) {
    if (category == "atom_site") return &single_atom_;
    const bool small =
        std::find(small_categories.begin(), small_categories.end(), category) != small_categories.end();
    return small ? &tables_[category] : nullptr;
  }

  CifToken read_pair(CifScanner& scanner, const CifToken& tag) {
    const CifToken value = scanner.next();
    if (value.kind != CifToken::Kind::Value)
      fail(Exit::BadInput, value.kind == CifToken::Kind::End ? code::ends_early : molecule_code::cif_syntax,
           scanner.place(tag), fmt::format("the tag {} has no value", shown(tag.text)));
    const auto [category, item] = split(tag.text);
    core_cif_ = core_cif_ || begins(tag.text, "_atom_site_");
    CifTable* table = kept(category);
    if (table && (table->items.empty() || table->rows() == 1) && table->item(item) < 0) {
      table->items.push_back(item);
      table->values.push_back(value);
    }
    return scanner.next();
  }
  static bool begins(std::string_view tag, std::string_view with) {
    return same_word(tag.substr(0, with.size()), with) && tag.find('.') == std::string_view::npos;
  }

  // Returns the token behind the loop.
  CifToken read_loop(CifScanner& scanner) {
    CifTable table;
    CifScanner values = scanner;
    CifToken token = scanner.next();
    const CifToken first = token;
    for (; token.kind == CifToken::Kind::Tag; token = scanner.next()) {
      const auto [category, item] = split(token.text);
      if (table.items.empty()) table.name = category;
      core_cif_ = core_cif_ || begins(token.text, "_atom_site_");
      table.items.push_back(item);
      if (table.items.size() > max_fields)
        fail(Exit::BadInput, code::many_columns, scanner.place(token),
             fmt::format("a loop has more than {} tags", max_fields));
      values = scanner;
    }
    if (table.items.empty())
      fail(Exit::BadInput, first.kind == CifToken::Kind::End ? code::ends_early : molecule_code::cif_syntax,
           scanner.place(first), "a loop has no tags");
    if (table.name == "atom_site" && models_.empty()) return index_atoms(scanner, values, token, table);
    CifTable* keep = table.name == "atom_site" ? nullptr : kept(table.name);
    std::uint64_t count = 0;
    for (; token.kind == CifToken::Kind::Value; token = scanner.next(), ++count)
      if (keep) table.values.push_back(token);
    check_rows(scanner, token, table, count);
    if (keep) *keep = std::move(table);
    return token;
  }

  void check_rows(const CifScanner& scanner, const CifToken& behind, const CifTable& table,
                  std::uint64_t count) const {
    if (count % table.items.size() == 0) return;
    const bool end = behind.kind == CifToken::Kind::End;
    fail(Exit::BadInput, end ? code::ends_early : molecule_code::cif_syntax, scanner.place(behind),
         fmt::format("{} row {} of the loop _{}: it has {} values for {} tags",
                     end ? "the file ends within" : "something else stands in",
                     count / table.items.size() + 1, table.name, count % table.items.size(),
                     table.items.size()));
  }

  // Finds where the rows of each model stand. `values` stands before the first value, which is `token`.
  CifToken index_atoms(CifScanner& scanner, CifScanner values, CifToken token, const CifTable& table) {
    atom_items_ = table.items;
    check_atom_items(scanner.place(token));
    const int model_item = table.item("pdbx_PDB_model_num");
    std::map<std::string, std::size_t, std::less<>> by_number;
    std::size_t current = std::string::npos;
    std::uint64_t count = 0;
    while (token.kind == CifToken::Kind::Value) {
      const CifScanner row = values;
      std::string_view number = "1";
      std::size_t k = 0;
      for (; k < table.items.size() && token.kind == CifToken::Kind::Value; ++k, ++count) {
        if (static_cast<int>(k) == model_item) number = token.text;
        values = scanner;
        token = scanner.next();
      }
      if (k < table.items.size()) break;
      if (current == std::string::npos || models_[current].number != number) {
        const auto [at, fresh] = by_number.try_emplace(std::string(number), models_.size());
        if (fresh) models_.push_back({std::string(number), {}});
        current = at->second;
        models_[current].stretches.push_back({row, 0});
      }
      ++models_[current].stretches.back().rows;
    }
    check_rows(scanner, token, table, count);
    return token;
  }

  void check_atom_items(const SourceLoc& loc) {
    CifTable names;
    names.items = atom_items_;
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr std::array<std::string_view, 3> axes{"Cartn_x", "Cartn_y", "Cartn_z"};
      if (names.item(axes[k]) >= 0) continue;
      std::vector<std::string> there(atom_items_.begin(), atom_items_.end());
      fail(Exit::BadInput, code::no_position, loc, fmt::format("_atom_site has no item {}", axes[k]),
           {"items: " + list_of(there)});
    }
  }

  void read_cell() {
    const CifTable& cell = tables_["cell"];
    constexpr std::array<std::string_view, 6> items{"length_a",    "length_b",   "length_c",
                                                    "angle_alpha", "angle_beta", "angle_gamma"};
    std::array<double, 6> v{};
    for (std::size_t k = 0; k < 6; ++k) {
      const CifToken* token = cell.value(0, items[k]);
      if (!token) return;
      if (!cif_real(*token, v[k]))
        fail(Exit::BadInput, code::box, {bytes_->name(), token->line, token->column},
             fmt::format("_cell.{} is {}, not a number", items[k], shown(token->text)));
    }
    if (v[0] == 1 && v[1] == 1 && v[2] == 1) return; // structures without a crystal
    box_ = cell_box({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
    if (!box_)
      fail(Exit::BadInput, code::box, {bytes_->name(), cell.values[0].line},
           fmt::format("lengths {} {} {} and angles {} {} {} form no cell", v[0], v[1], v[2], v[3], v[4],
                       v[5]));
  }

  Frame read_model(const Model& model);

  std::shared_ptr<Bytes> bytes_;
  std::map<std::string, CifTable> tables_{};
  CifTable single_atom_{};
  std::vector<std::string_view> atom_items_{};
  std::vector<Model> models_{};
  std::vector<Assembly> assemblies_{};
  std::optional<Box> box_{};
  bool core_cif_{};
};

Frame MmcifSource::read_model(const Model& model) {
  CifAtoms atoms(bytes_->name(), atom_items_, tables_["atom_site_anisotrop"].rows() > 0);
  for (const Stretch& stretch : model.stretches) {
    CifScanner scanner = stretch.begin;
    for (std::uint64_t row = 0; row < stretch.rows; ++row) {
      for (CifToken& token : atoms.row()) token = scanner.next();
      atoms.add();
    }
  }
  if (model.stretches.empty()) {
    atoms.row() = single_atom_.values;
    atoms.add();
  }
  if (!atoms.add_anisou(tables_["atom_site_anisotrop"]) && models_.size() == 1 &&
      !warnings_.has(molecule_code::anisotropy))
    warnings_.warning(molecule_code::anisotropy, {bytes_->name()},
                      "rows of _atom_site_anisotrop that belong to no atom are ignored");
  Frame frame;
  atoms.give(frame);
  frame.box = box_;
  frame.assemblies = assemblies_;
  auto property = [&](const char* category, std::string_view item, std::string name) {
    if (const CifToken* value = tables_[category].value(0, item))
      frame.properties.emplace_back(std::move(name), std::string(trim(value->text)));
  };
  property("struct", "title", "title");
  property("entry", "id", "identifier");
  property("symmetry", "space_group_name_H-M", "space_group");
  if (models_.size() > 1) frame.properties.emplace_back("model", model.number);
  return frame;
}

Sureness probe(const Probe& file) {
  Cursor cursor(file.head);
  while (const auto line = cursor.next()) {
    const std::string_view text = trim(line->text);
    if (text.empty() || text[0] == '#') continue;
    if (!same_word(text.substr(0, 5), "data_")) return Sureness::No;
    return file.head.find("\n_") != std::string_view::npos ||
                   file.head.find("loop_") != std::string_view::npos
               ? Sureness::Certain
               : Sureness::ByName;
  }
  return Sureness::No;
}

} // namespace

Reader mmcif_reader() {
  return {{"mmcif", "Protein Data Bank, PDBx/mmCIF (A)", "cif mmcif"},
          probe,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<MmcifSource>(std::move(bytes));
          }};
}

} // namespace mote::data
