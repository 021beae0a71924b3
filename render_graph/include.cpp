// SPDX-License-Identifier: MIT
#include "render_graph/include.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace mote::rg {
namespace {

constexpr std::string_view variables_key = "variables";

Entry* find_entry(Table& table, std::string_view key) {
  const auto it = std::find_if(table.begin(), table.end(), [&](const Entry& entry) { return entry.key == key; });
  return it == table.end() ? nullptr : &*it;
}
const std::string* text_of(const Table& table, std::string_view key) {
  const Entry* entry = find(table, key);
  return entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
}

// What `over` says goes over what `base` says; tables key by key.
void merge(Table& base, const Table& over) {
  for (const Entry& entry : over) {
    Entry* known = find_entry(base, entry.key);
    if (!known) {
      base.push_back(entry);
      continue;
    }
    auto* inner = std::get_if<Table>(&known->value.data);
    const auto* other = std::get_if<Table>(&entry.value.data);
    if (inner && other) merge(*inner, *other);
    else *known = entry;
  }
}

// Passes of one name become one pass at the place of the first, located where the last one stands.
void merge_passes(Array& base, const Array& over) {
  const std::size_t included = base.size();
  for (const Value& item : over) {
    const auto* table = std::get_if<Table>(&item.data);
    const std::string* name = table ? text_of(*table, "name") : nullptr;
    const auto same = std::find_if(base.begin(), base.begin() + static_cast<std::ptrdiff_t>(included), [&](const Value& known) {
      const auto* other = std::get_if<Table>(&known.data);
      const std::string* its = other ? text_of(*other, "name") : nullptr;
      return name && its && *its == *name;
    });
    if (!name || same == base.begin() + static_cast<std::ptrdiff_t>(included)) {
      base.push_back(item); // two passes of one name in one file are the compiler's error
      continue;
    }
    merge(std::get<Table>(same->data), *table);
    same->loc = item.loc;
  }
}

void merge_graphs(Table& base, const Table& over) {
  for (const Entry& entry : over) {
    Entry* known = find_entry(base, entry.key);
    if (!known) {
      base.push_back(entry);
      continue;
    }
    auto* passes = std::get_if<Array>(&known->value.data);
    const auto* more = std::get_if<Array>(&entry.value.data);
    auto* variables = std::get_if<Table>(&known->value.data);
    const auto* others = std::get_if<Table>(&entry.value.data);
    if (entry.key == "pass" && passes && more) merge_passes(*passes, *more);
    else if (entry.key == variables_key && variables && others) merge(*variables, *others);
    else *known = entry;
  }
}

class Includer {
public:
  Includer(const ParseOptions& options, Diagnostics& diagnostics) : options_(options), diagnostics_(diagnostics) {}

  Table load(std::string_view toml, const std::string& file) {
    Table own = parse_toml_text(toml, file, diagnostics_);
    open_.push_back(identity(file));
    Table all;
    if (const Entry* include = find(own, "include")) {
      const auto* list = std::get_if<Array>(&include->value.data);
      const Array single{include->value};
      for (const Value& item : list ? *list : single) add(all, item);
    }
    open_.pop_back();
    std::erase_if(own, [](const Entry& entry) { return entry.key == "include"; });
    merge_graphs(all, own);
    return all;
  }

private:
  static std::string identity(const std::string& file) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
    return error ? file : path.string();
  }

  void add(Table& all, const Value& item) {
    const auto* name = std::get_if<std::string>(&item.data);
    if (!name) {
      diagnostics_.error("G004", item.loc, fmt::format("'include' holds {}, but must be a file's name or a list of them.", type_name(item)));
      return;
    }
    const std::optional<GraphText> found = options_.read ? options_.read(*name, item.loc.file) : read_beside(*name, item.loc.file);
    if (!found) {
      diagnostics_.error("G007", item.loc, fmt::format("the graph file '{}' cannot be read.", *name), {"it is looked for beside the file that includes it."});
      return;
    }
    const std::string id = identity(found->file);
    if (const auto ring = std::find(open_.begin(), open_.end(), id); ring != open_.end()) {
      std::string text;
      for (auto it = ring; it != open_.end(); ++it) text += std::filesystem::path(*it).filename().string() + " -> ";
      diagnostics_.error("G027", item.loc, fmt::format("'{}' includes itself: {}{}.", *name, text, std::filesystem::path(id).filename().string()));
      return;
    }
    Table included = load(found->text, found->file);
    std::erase_if(included, [](const Entry& entry) { return entry.key == "schema" || entry.key == "name"; });
    merge_graphs(all, included);
  }

  const ParseOptions& options_;
  Diagnostics& diagnostics_;
  std::vector<std::string> open_{}; // files that are being read, outermost first
};

class Substitution {
public:
  Substitution(const Table& variables, Diagnostics& diagnostics) : variables_(variables), diagnostics_(diagnostics) {}

  // False: the value names a variable that does not exist (reported) and is better left out.
  bool apply(Value& value) {
    if (auto* array = std::get_if<Array>(&value.data)) std::erase_if(*array, [&](Value& item) { return !apply(item); });
    if (auto* table = std::get_if<Table>(&value.data)) std::erase_if(*table, [&](Entry& entry) { return !apply(entry.value); });
    auto* text = std::get_if<std::string>(&value.data);
    if (!text || text->find('$') == std::string::npos) return true;
    const std::string name = text->substr(1);
    if (text->front() != '$' || !valid_name(name)) {
      value.data = interpolate(*text, value.loc);
      return true;
    }
    const Value* found = look_up(name, value.loc);
    if (found) value.data = found->data;
    return found != nullptr;
  }

private:
  const Value* look_up(const std::string& name, const SourceLoc& loc) {
    if (const Entry* entry = find(variables_, name)) return &entry->value;
    const std::vector<std::string> names = keys_of(variables_);
    diagnostics_.error("G028", loc, fmt::format("there is no variable '{}'.", name), {"variables: " + list_of(names) + ".", did_you_mean(name, names)});
    return nullptr;
  }

  std::string interpolate(const std::string& text, const SourceLoc& loc) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '$') {
        out += text[i];
        continue;
      }
      if (text.compare(i, 2, "$$") == 0) {
        out += text[i++];
        continue;
      }
      const std::size_t close = text.compare(i, 2, "${") == 0 ? text.find('}', i) : std::string::npos;
      const std::string name = close == std::string::npos ? std::string() : text.substr(i + 2, close - i - 2);
      if (!valid_name(name)) {
        diagnostics_.error("G029", loc, fmt::format("'{}' has a '$' that begins no variable.", text), {"write \"$name\" for a whole value, \"${name}\" within a text, \"$$\" for a dollar sign."});
        return text;
      }
      if (const Value* found = look_up(name, loc)) out += plain_text(*found, name, loc);
      i = close;
    }
    return out;
  }

  std::string plain_text(const Value& value, const std::string& name, const SourceLoc& loc) {
    if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
    if (!std::holds_alternative<Array>(value.data) && !std::holds_alternative<Table>(value.data)) return to_text(value);
    diagnostics_.error("G029", loc, fmt::format("the variable '{}' is {} and cannot stand within a text.", name, type_name(value)), {"\"$" + name + "\" alone takes it as a whole."});
    return {};
  }

  const Table& variables_;
  Diagnostics& diagnostics_;
};

// --set variables.NAME=VALUE
void set_variables(Table& variables, const std::vector<std::string>& settings, Diagnostics& diagnostics) {
  for (const std::string& setting : settings) {
    if (!sets_variable(setting)) continue;
    const std::size_t equals = setting.find('=');
    const std::string name = setting.substr(variables_key.size() + 1, equals - variables_key.size() - 1);
    if (Entry* known = find_entry(variables, name)) {
      known->value = parse_setting(setting.substr(equals + 1), {"--set"});
      continue;
    }
    const std::vector<std::string> names = keys_of(variables);
    diagnostics.error("G028", {"--set"}, fmt::format("'{}': there is no variable '{}'.", setting, name), {"variables: " + list_of(names) + ".", did_you_mean(name, names)});
  }
}

} // namespace

bool sets_variable(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  return equals != std::string_view::npos && assignment.starts_with("variables.") && equals > variables_key.size() + 1;
}

std::optional<GraphText> read_beside(const std::string& name, const std::string& from) {
  const std::filesystem::path path(name);
  const std::string file = path.is_absolute() ? name : (std::filesystem::path(from).parent_path() / path).string();
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  if (!in || text.bad() || std::filesystem::is_directory(file)) return std::nullopt;
  return GraphText{file, text.str()};
}

Table assemble_graph(std::string_view toml, const std::string& file, const ParseOptions& options, Diagnostics& diagnostics) {
  Table all = Includer(options, diagnostics).load(toml, file);
  Table variables;
  if (Entry* entry = find_entry(all, variables_key)) {
    if (auto* table = std::get_if<Table>(&entry->value.data)) variables = *table;
    else diagnostics.error("G004", entry->value.loc, fmt::format("'variables' is {}, but must be a table.", type_name(entry->value)));
  }
  for (const Entry& entry : variables)
    if (!valid_name(entry.key))
      diagnostics.error("G006", entry.key_loc, fmt::format("variable name '{}' is not a name.", entry.key), {"a name is a lower-case letter, then lower-case letters, digits and '_'."});
  set_variables(variables, options.settings, diagnostics);
  Substitution substitution(variables, diagnostics);
  std::erase_if(all, [&](Entry& entry) { return entry.key != variables_key && !substitution.apply(entry.value); });
  return all;
}

} // namespace mote::rg
