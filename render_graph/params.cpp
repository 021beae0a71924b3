// SPDX-License-Identifier: MIT
#include "render_graph/params.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace mote::rg {

// What all levels of one pass's parameters share.
struct Params::Shared {
  std::string pass{}, kind{};
  SourceLoc pass_loc{};
  std::vector<DrawList> draw{};
  bool asked_draw{};
  std::vector<ParamInfo> asked{};
  Diagnostics* diagnostics{};
  Diagnostics own{}; // for the describing form, whose messages nobody wants
};

struct Params::Level {
  Table values{};
  SourceLoc loc{};
  std::string prefix{}; // "samples." or empty
  std::vector<std::string> known{};
  std::vector<std::shared_ptr<Level>> children{};
};

namespace {

std::optional<double> as_number(const Value& value) {
  if (const auto* d = std::get_if<double>(&value.data)) return *d;
  if (const auto* i = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*i);
  return std::nullopt;
}

// Numbers of an array, or nothing if it is no array or holds anything else.
std::optional<std::vector<double>> as_numbers(const Value& value) {
  const auto* array = std::get_if<Array>(&value.data);
  if (!array) return std::nullopt;
  std::vector<double> out;
  for (const Value& item : *array) {
    const auto number = as_number(item);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    out.push_back(*number);
  }
  return out;
}

std::string text_of(const Range& range) {
  std::string out;
  if (std::isfinite(range.min)) out = fmt::format("{} {}", range.open_min ? ">" : ">=", range.min);
  if (std::isfinite(range.max)) out += fmt::format("{}<= {}", out.empty() ? "" : ", ", range.max);
  return out;
}

std::string text_of(std::span<const double> values) { return fmt::format("[{}]", fmt::join(values, ", ")); }
std::string text_of(const gpu::Color& c) { return fmt::format("[{}, {}, {}, {}]", c.r, c.g, c.b, c.a); }
std::string in_quotes(std::string_view text) { return fmt::format("\"{}\"", text); }

// "#rgb", "#rrggbb" or "#rrggbbaa" as numbers 0..1.
std::optional<gpu::Color> parse_hex_color(std::string_view text) {
  if (text.empty() || text[0] != '#') return std::nullopt;
  text.remove_prefix(1);
  const std::size_t digits = text.size() == 3 ? 1 : 2;
  if (text.size() != 3 && text.size() != 6 && text.size() != 8) return std::nullopt;
  double channels[4] = {0, 0, 0, 1};
  for (std::size_t i = 0; i * digits < text.size(); ++i) {
    unsigned value = 0;
    const char* begin = text.data() + i * digits;
    const auto result = std::from_chars(begin, begin + digits, value, 16);
    if (result.ec != std::errc{} || result.ptr != begin + digits) return std::nullopt;
    channels[i] = value / (digits == 1 ? 15.0 : 255.0);
  }
  return gpu::Color{channels[0], channels[1], channels[2], channels[3]};
}

std::optional<gpu::Color> parse_color(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value.data)) return parse_hex_color(*text);
  const auto numbers = as_numbers(value);
  if (!numbers || (numbers->size() != 3 && numbers->size() != 4)) return std::nullopt;
  return gpu::Color{(*numbers)[0], (*numbers)[1], (*numbers)[2], numbers->size() == 4 ? (*numbers)[3] : 1.0};
}

} // namespace

Params::Params() : shared_(std::make_shared<Shared>()), level_(std::make_shared<Level>()) {
  shared_->diagnostics = &shared_->own;
}
Params::Params(Table values, std::vector<DrawList> draw, std::string pass, std::string kind, SourceLoc pass_loc,
               Diagnostics& diagnostics)
    : shared_(std::make_shared<Shared>()), level_(std::make_shared<Level>()) {
  *shared_ = {std::move(pass), std::move(kind), pass_loc, std::move(draw), false, {}, &diagnostics, {}};
  *level_ = {std::move(values), std::move(pass_loc), {}, {}, {}};
}
Params::Params(std::shared_ptr<Shared> shared, Table values, SourceLoc loc, std::string prefix)
    : shared_(std::move(shared)),
      level_(std::make_shared<Level>(Level{std::move(values), std::move(loc), std::move(prefix), {}, {}})) {}

bool Params::has(std::string_view name) const { return find(level_->values, name) != nullptr; }
bool Params::is_table(std::string_view name) const {
  const Entry* entry = find(level_->values, name);
  return entry && std::holds_alternative<Table>(entry->value.data);
}
bool Params::is_string(std::string_view name) const {
  const Entry* entry = find(level_->values, name);
  return entry && std::holds_alternative<std::string>(entry->value.data);
}
const std::string& Params::pass() const { return shared_->pass; }
const std::string& Params::kind() const { return shared_->kind; }
SourceLoc Params::loc(std::string_view name) const {
  const Entry* entry = find(level_->values, name);
  return entry ? entry->value.loc : level_->loc;
}
const std::vector<ParamInfo>& Params::asked() const { return shared_->asked; }
bool Params::asked_draw() const { return shared_->asked_draw; }

const Value* Params::ask(std::string_view name, std::string_view type, std::string fallback, std::string range,
                         std::string_view summary) {
  auto& known = level_->known;
  if (std::find(known.begin(), known.end(), name) == known.end()) known.emplace_back(name);
  const std::string full = level_->prefix + std::string(name);
  auto& asked = shared_->asked;
  if (std::none_of(asked.begin(), asked.end(), [&](const ParamInfo& info) { return info.name == full; }))
    asked.push_back({full, std::string(type), std::move(fallback), std::move(range), std::string(summary)});
  const Entry* entry = find(level_->values, name);
  return entry ? &entry->value : nullptr;
}

void Params::error(std::string_view code, std::string_view name, std::string_view text, std::vector<std::string> hints) {
  error_at(code, loc(name), fmt::format("pass '{}' parameter '{}{}' {}", pass(), level_->prefix, name, text), std::move(hints));
}
void Params::error_at(std::string_view code, const SourceLoc& loc, std::string text, std::vector<std::string> hints) {
  shared_->diagnostics->error(code, loc, std::move(text), std::move(hints));
}
void Params::wrong_type(std::string_view name, const Value& value, std::string_view wanted) {
  error("G020", name, fmt::format("is {} ({}), but must be {}.", type_name(value), to_text(value), wanted));
}
void Params::require(std::string_view name) {
  if (!has(name)) error("G025", name, fmt::format("is missing; kind '{}' needs it.", kind()));
}

bool Params::in_range(std::string_view name, double value, const Range& range, const Value& at) {
  const bool above = range.open_min ? value > range.min : value >= range.min;
  if (std::isfinite(value) && above && value <= range.max) return true;
  const std::string bounds = text_of(range);
  error("G022", name, fmt::format("is {}, but must be {}.", to_text(at), bounds.empty() ? "finite" : bounds));
  return false;
}

double Params::number(std::string_view name, double fallback, Range range, std::string_view summary) {
  const Value* value = ask(name, "number", fmt::format("{}", fallback), text_of(range), summary);
  if (!value) return fallback;
  const auto number = as_number(*value);
  if (!number) return wrong_type(name, *value, "a number"), fallback;
  return in_range(name, *number, range, *value) ? *number : fallback;
}

std::int64_t Params::integer(std::string_view name, std::int64_t fallback, Range range, std::string_view summary) {
  const Value* value = ask(name, "integer", fmt::format("{}", fallback), text_of(range), summary);
  if (!value) return fallback;
  const auto* integer = std::get_if<std::int64_t>(&value->data);
  if (!integer) return wrong_type(name, *value, "an integer"), fallback;
  return in_range(name, static_cast<double>(*integer), range, *value) ? *integer : fallback;
}

bool Params::boolean(std::string_view name, bool fallback, std::string_view summary) {
  const Value* value = ask(name, "boolean", fallback ? "true" : "false", {}, summary);
  if (!value) return fallback;
  if (const bool* flag = std::get_if<bool>(&value->data)) return *flag;
  return wrong_type(name, *value, "true or false"), fallback;
}

std::string Params::string(std::string_view name, std::string_view fallback, std::string_view summary) {
  const Value* value = ask(name, "string", in_quotes(fallback), {}, summary);
  if (!value) return std::string(fallback);
  if (const auto* text = std::get_if<std::string>(&value->data)) return *text;
  return wrong_type(name, *value, "a string"), std::string(fallback);
}

std::string Params::word(std::string_view name, std::string_view fallback, std::span<const std::string> words, std::string_view summary) {
  const Value* value = ask(name, "string", in_quotes(fallback), list_of(words), summary);
  if (!value) return std::string(fallback);
  const auto* text = std::get_if<std::string>(&value->data);
  if (!text) return wrong_type(name, *value, "a string"), std::string(fallback);
  if (std::find(words.begin(), words.end(), *text) != words.end()) return *text;
  error("G023", name, fmt::format("is '{}', which is none of its words.", *text), {"words: " + list_of(words) + ".", did_you_mean(*text, words)});
  return std::string(fallback);
}
std::string Params::word(std::string_view name, std::string_view fallback, std::initializer_list<std::string_view> words, std::string_view summary) {
  const std::vector<std::string> list(words.begin(), words.end());
  return word(name, fallback, std::span<const std::string>(list), summary);
}

std::string Params::path(std::string_view name, std::string_view fallback, std::string_view summary) {
  const std::string text = string(name, fallback, summary);
  if (text.empty() || text == fallback || std::filesystem::path(text).is_absolute()) return text;
  const SourceLoc place = loc(name);
  if (place.line == 0) return text; // from the command line
  return (std::filesystem::path(place.file).parent_path() / text).string();
}

gpu::Color Params::color(std::string_view name, gpu::Color fallback, std::string_view summary) {
  const Value* value = ask(name, "color", text_of(fallback), {}, summary);
  if (!value) return fallback;
  if (const auto color = parse_color(*value)) return *color;
  error("G024", name, fmt::format("is {}, which is not a color.", to_text(*value)), {"colors: \"#rgb\", \"#rrggbb\", \"#rrggbbaa\", [r, g, b], [r, g, b, a]."});
  return fallback;
}

void Params::vec_values(std::string_view name, std::span<double> values, std::string_view summary) {
  const Value* value = ask(name, fmt::format("{} numbers", values.size()), text_of(values), {}, summary);
  if (!value) return;
  const auto numbers = as_numbers(*value);
  if (!numbers || numbers->size() != values.size()) return wrong_type(name, *value, fmt::format("an array of {} numbers", values.size()));
  std::copy(numbers->begin(), numbers->end(), values.begin());
}

std::vector<double> Params::numbers(std::string_view name, std::vector<double> fallback, std::string_view summary) {
  const Value* value = ask(name, "numbers", text_of(fallback), {}, summary);
  if (!value) return fallback;
  if (auto numbers = as_numbers(*value)) return std::move(*numbers);
  return wrong_type(name, *value, "an array of numbers"), fallback;
}

std::vector<std::string> Params::strings(std::string_view name, std::vector<std::string> fallback, std::string_view summary) {
  std::string shown;
  for (const std::string& item : fallback) shown += (shown.empty() ? "" : ", ") + in_quotes(item);
  const Value* value = ask(name, "strings", "[" + shown + "]", {}, summary);
  if (!value) return fallback;
  if (const auto* text = std::get_if<std::string>(&value->data)) return {*text};
  const auto* array = std::get_if<Array>(&value->data);
  std::vector<std::string> out;
  for (const Value& item : array ? *array : Array{})
    if (const auto* text = std::get_if<std::string>(&item.data)) out.push_back(*text);
  if (array && out.size() == array->size()) return out;
  return wrong_type(name, *value, "an array of strings"), fallback;
}

Params Params::table(std::string_view name, std::string_view summary) {
  const Value* value = ask(name, "table", {}, {}, summary);
  const Table* table = value ? std::get_if<Table>(&value->data) : nullptr;
  if (value && !table) wrong_type(name, *value, "a table");
  Params child(shared_, table ? *table : Table{}, loc(name), fmt::format("{}{}.", level_->prefix, name));
  level_->children.push_back(child.level_);
  return child;
}

std::vector<Params> Params::tables(std::string_view name, std::string_view summary) {
  const Value* value = ask(name, "tables", {}, {}, summary);
  if (!value) return {};
  const Array* array = std::get_if<Array>(&value->data);
  const Array single{*value};
  std::vector<Params> out;
  for (const Value& item : array ? *array : single) {
    const Table* table = std::get_if<Table>(&item.data);
    if (!table) return wrong_type(name, *value, "an array of tables"), std::vector<Params>{};
    out.push_back(Params(shared_, *table, item.loc, fmt::format("{}{}.", level_->prefix, name)));
    level_->children.push_back(out.back().level_);
  }
  return out;
}

std::vector<LocatedString> Params::draw(std::string_view list) {
  shared_->asked_draw = true;
  for (const DrawList& entry : shared_->draw)
    if (entry.name == list) return entry.items;
  return {};
}
const std::vector<DrawList>& Params::draw_lists() {
  shared_->asked_draw = true;
  return shared_->draw;
}

void Params::finish_level(const Level& level) {
  for (const Entry& entry : level.values) {
    if (std::find(level.known.begin(), level.known.end(), entry.key) != level.known.end()) continue;
    std::vector<std::string> names = level.known;
    std::sort(names.begin(), names.end());
    error_at("G021", entry.key_loc,
             fmt::format("pass '{}' parameter '{}{}' is not known to kind '{}'.", pass(), level.prefix, entry.key, kind()),
             {"parameters: " + list_of(names) + ".", did_you_mean(entry.key, names)});
  }
  for (const auto& child : level.children) finish_level(*child);
}

void Params::finish() {
  finish_level(*level_);
  if (!shared_->asked_draw && !shared_->draw.empty())
    error_at("G030", shared_->draw.front().loc, fmt::format("pass '{}' has 'draw', but kind '{}' draws no particles.", pass(), kind()));
}

} // namespace mote::rg
