// SPDX-License-Identifier: MIT
#include "core/scene/expression.hpp"

#include "core/scene/attributes.hpp"
#include "core/scene/codes.hpp"
#include "core/scene/expression_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace mote {
namespace {

using expression::Word;
using expression::WordKind;

constexpr int deepest = 200; // of nested parentheses and signs

enum class Kind : std::uint8_t { Number, Text, Truth };
constexpr std::array<std::string_view, 3> kind_names{"a number", "a text", "a truth value"};

// A checked part of the expression; `number` gives numbers and truth values (0 or 1), `text` texts.
struct Part {
  Kind kind{Kind::Number};
  virtual ~Part() = default;
  [[nodiscard]] virtual double number(std::uint64_t) const { return 0.0; }
  [[nodiscard]] virtual std::string_view text(std::uint64_t) const { return {}; }
};
using PartPtr = std::unique_ptr<Part>;

struct NumberPart : Part {
  double value;
  explicit NumberPart(double v, Kind k = Kind::Number) : value(v) { kind = k; }
  double number(std::uint64_t) const override { return value; }
};
struct TextPart : Part {
  std::string value;
  explicit TextPart(std::string v) : value(std::move(v)) { kind = Kind::Text; }
  std::string_view text(std::uint64_t) const override { return value; }
};
struct IndexPart : Part {
  double number(std::uint64_t row) const override { return static_cast<double>(row); }
};
struct AttributePart : Part {
  Attribute attribute;
  explicit AttributePart(const Attribute& a) : attribute(a) { kind = a.is_text() ? Kind::Text : Kind::Number; }
  double number(std::uint64_t row) const override { return attribute.at(row); }
  std::string_view text(std::uint64_t row) const override { return std::get<data::TextColumn>(attribute.column->values).at(row); }
};

template <class Fn> struct Unary : Part {
  PartPtr a;
  Fn fn;
  Unary(PartPtr x, Fn f, Kind k) : a(std::move(x)), fn(f) { kind = k; }
  double number(std::uint64_t row) const override { return fn(a->number(row)); }
};
template <class Fn> struct Binary : Part {
  PartPtr a, b;
  Fn fn;
  Binary(PartPtr x, PartPtr y, Fn f, Kind k) : a(std::move(x)), b(std::move(y)), fn(f) { kind = k; }
  double number(std::uint64_t row) const override { return fn(a->number(row), b->number(row)); }
};
struct SameText : Part {
  PartPtr a, b;
  bool same;
  SameText(PartPtr x, PartPtr y, bool s) : a(std::move(x)), b(std::move(y)), same(s) { kind = Kind::Truth; }
  double number(std::uint64_t row) const override { return (a->text(row) == b->text(row)) == same ? 1.0 : 0.0; }
};
struct OneOf : Part {
  PartPtr a;
  std::vector<PartPtr> list;
  OneOf(PartPtr x, std::vector<PartPtr> l) : a(std::move(x)), list(std::move(l)) { kind = Kind::Truth; }
  double number(std::uint64_t row) const override {
    return std::any_of(list.begin(), list.end(),
                       [&](const PartPtr& p) { return a->kind == Kind::Text ? a->text(row) == p->text(row) : a->number(row) == p->number(row); })
               ? 1.0
               : 0.0;
  }
};

template <class Fn> PartPtr unary(PartPtr a, Fn fn, Kind kind) { return std::make_unique<Unary<Fn>>(std::move(a), fn, kind); }
template <class Fn> PartPtr binary(PartPtr a, PartPtr b, Fn fn, Kind kind) {
  return std::make_unique<Binary<Fn>>(std::move(a), std::move(b), fn, kind);
}
double truth(bool b) { return b ? 1.0 : 0.0; }

struct Function {
  std::string_view name;
  double (*one)(double);
  double (*two)(double, double);
};
constexpr std::array<Function, 10> functions{{
    {"abs", [](double x) { return std::abs(x); }, nullptr},     {"sqrt", [](double x) { return std::sqrt(x); }, nullptr},
    {"floor", [](double x) { return std::floor(x); }, nullptr}, {"ceil", [](double x) { return std::ceil(x); }, nullptr},
    {"log", [](double x) { return std::log(x); }, nullptr},     {"exp", [](double x) { return std::exp(x); }, nullptr},
    {"sin", [](double x) { return std::sin(x); }, nullptr},     {"cos", [](double x) { return std::cos(x); }, nullptr},
    {"min", nullptr, [](double x, double y) { return std::fmin(x, y); }},
    {"max", nullptr, [](double x, double y) { return std::fmax(x, y); }},
}};

struct Broken {}; // thrown within the parser when the error is reported

class Parser {
public:
  Parser(std::string_view text, const data::Frame& frame, const SourceLoc& loc, Diagnostics& diagnostics)
      : text_(text), words_(expression::words_of(text)), frame_(frame), loc_(loc), diagnostics_(diagnostics) {}

  PartPtr parse() {
    PartPtr all = any();
    if (now().kind != WordKind::End) unexpected("the end of the expression or an operator");
    need(*all, Kind::Truth, 0, "the whole expression");
    return all;
  }

private:
  const Word& now() const { return words_[at_]; }
  bool sign(std::string_view s) const { return now().kind == WordKind::Sign && now().text == s; }
  bool take(std::string_view s) {
    if (!sign(s)) return false;
    ++at_;
    return true;
  }
  SourceLoc place(std::size_t byte) const {
    SourceLoc loc = loc_;
    if (loc.line && text_.find('\n') == std::string_view::npos) loc.column += byte;
    return loc;
  }
  [[noreturn]] void broken(std::string_view code, std::size_t byte, const std::string& what, std::vector<std::string> hints = {}) {
    diagnostics_.error(code, place(byte), fmt::format("the selection '{}': {}", text_, what), std::move(hints));
    throw Broken{};
  }
  [[noreturn]] void unexpected(std::string_view wanted) {
    const Word& w = now();
    if (w.kind == WordKind::Wrong) broken(code::expression_syntax, w.at, fmt::format("at character {} stands {}", w.at + 1, w.text));
    const std::string found = w.kind == WordKind::End ? "it ends" : fmt::format("at character {} stands '{}'", w.at + 1, w.text);
    broken(code::expression_syntax, w.at, fmt::format("{} where {} is needed", found, wanted),
           {"For example: type == \"O\" && speed > 2"});
  }
  void need(const Part& part, Kind kind, std::size_t byte, std::string_view what) {
    if (part.kind == kind) return;
    broken(code::expression_type, byte,
           fmt::format("{} is {}, but {} is needed", what, kind_names[static_cast<std::size_t>(part.kind)], kind_names[static_cast<std::size_t>(kind)]));
  }
  struct Deeper {
    int& depth;
    explicit Deeper(Parser& p) : depth(p.depth_) {
      if (++depth > deepest) p.broken(code::expression_syntax, p.now().at, "it is nested too deeply");
    }
    ~Deeper() { --depth; }
  };

  PartPtr any() {
    const Deeper deeper(*this);
    PartPtr a = all();
    while (sign("||")) {
      const std::size_t byte = words_[at_++].at;
      PartPtr b = all();
      need(*a, Kind::Truth, byte, "the left side of ||");
      need(*b, Kind::Truth, byte, "the right side of ||");
      a = binary(std::move(a), std::move(b), [](double x, double y) { return truth(x != 0.0 || y != 0.0); }, Kind::Truth);
    }
    return a;
  }
  PartPtr all() {
    PartPtr a = negation();
    while (sign("&&")) {
      const std::size_t byte = words_[at_++].at;
      PartPtr b = negation();
      need(*a, Kind::Truth, byte, "the left side of &&");
      need(*b, Kind::Truth, byte, "the right side of &&");
      a = binary(std::move(a), std::move(b), [](double x, double y) { return truth(x != 0.0 && y != 0.0); }, Kind::Truth);
    }
    return a;
  }
  PartPtr negation() {
    if (!sign("!")) return comparison();
    const Deeper deeper(*this);
    const std::size_t byte = words_[at_++].at;
    PartPtr a = negation();
    need(*a, Kind::Truth, byte, "what stands behind !");
    return unary(std::move(a), [](double x) { return truth(x == 0.0); }, Kind::Truth);
  }

  PartPtr comparison() {
    PartPtr a = sum();
    if (now().kind == WordKind::Name && now().text == "in") return membership(std::move(a));
    for (const std::string_view s : {"==", "!=", "<=", ">=", "<", ">"})
      if (sign(s)) {
        const std::size_t byte = words_[at_++].at;
        return compare(s, byte, std::move(a), sum());
      }
    return a;
  }
  PartPtr compare(std::string_view s, std::size_t byte, PartPtr a, PartPtr b) {
    if (a->kind != b->kind)
      broken(code::expression_type, byte,
             fmt::format("{} is compared with {}", kind_names[static_cast<std::size_t>(a->kind)], kind_names[static_cast<std::size_t>(b->kind)]),
             {"Texts stand in quotes, numbers do not"});
    if (a->kind == Kind::Text) {
      if (s != "==" && s != "!=") broken(code::expression_type, byte, fmt::format("texts have no order: {} is for numbers", s));
      return std::make_unique<SameText>(std::move(a), std::move(b), s == "==");
    }
    if (s == "==") return binary(std::move(a), std::move(b), [](double x, double y) { return truth(x == y); }, Kind::Truth);
    if (s == "!=") return binary(std::move(a), std::move(b), [](double x, double y) { return truth(x != y); }, Kind::Truth);
    if (s == "<=") return binary(std::move(a), std::move(b), [](double x, double y) { return truth(x <= y); }, Kind::Truth);
    if (s == ">=") return binary(std::move(a), std::move(b), [](double x, double y) { return truth(x >= y); }, Kind::Truth);
    if (s == "<") return binary(std::move(a), std::move(b), [](double x, double y) { return truth(x < y); }, Kind::Truth);
    return binary(std::move(a), std::move(b), [](double x, double y) { return truth(x > y); }, Kind::Truth);
  }
  PartPtr membership(PartPtr a) {
    const std::size_t byte = words_[at_++].at;
    if (!take("[")) unexpected("'[' behind in");
    std::vector<PartPtr> list;
    do {
      list.push_back(sum());
      need(*list.back(), a->kind, byte, "a value of the list");
    } while (take(","));
    if (!take("]")) unexpected("',' or ']'");
    return std::make_unique<OneOf>(std::move(a), std::move(list));
  }

  PartPtr arithmetic(std::string_view s, std::size_t byte, PartPtr a, PartPtr b) {
    need(*a, Kind::Number, byte, fmt::format("the left side of {}", s));
    need(*b, Kind::Number, byte, fmt::format("the right side of {}", s));
    if (s == "+") return binary(std::move(a), std::move(b), [](double x, double y) { return x + y; }, Kind::Number);
    if (s == "-") return binary(std::move(a), std::move(b), [](double x, double y) { return x - y; }, Kind::Number);
    if (s == "*") return binary(std::move(a), std::move(b), [](double x, double y) { return x * y; }, Kind::Number);
    if (s == "/") return binary(std::move(a), std::move(b), [](double x, double y) { return x / y; }, Kind::Number);
    if (s == "%") return binary(std::move(a), std::move(b), [](double x, double y) { return x - y * std::floor(x / y); }, Kind::Number);
    return binary(std::move(a), std::move(b), [](double x, double y) { return std::pow(x, y); }, Kind::Number);
  }
  PartPtr sum() {
    PartPtr a = product();
    while (sign("+") || sign("-")) {
      const Word& w = words_[at_++];
      a = arithmetic(w.text, w.at, std::move(a), product());
    }
    return a;
  }
  PartPtr product() {
    PartPtr a = signed_part();
    while (sign("*") || sign("/") || sign("%")) {
      const Word& w = words_[at_++];
      a = arithmetic(w.text, w.at, std::move(a), signed_part());
    }
    return a;
  }
  PartPtr signed_part() {
    if (!sign("-") && !sign("+")) return power();
    const Deeper deeper(*this);
    const Word& w = words_[at_++];
    PartPtr a = signed_part();
    need(*a, Kind::Number, w.at, fmt::format("what stands behind {}", w.text));
    return w.text == "+" ? std::move(a) : unary(std::move(a), [](double x) { return -x; }, Kind::Number);
  }
  PartPtr power() {
    PartPtr a = single();
    if (!sign("^")) return a;
    const Word& w = words_[at_++];
    return arithmetic("^", w.at, std::move(a), signed_part());
  }

  PartPtr single() {
    const Deeper deeper(*this);
    const Word w = now();
    if (w.kind == WordKind::Number) return ++at_, std::make_unique<NumberPart>(w.number);
    if (w.kind == WordKind::Text) return ++at_, std::make_unique<TextPart>(w.text);
    if (w.kind == WordKind::Name) return ++at_, named(w);
    if (!take("(")) unexpected("a value");
    PartPtr inner = any();
    if (!take(")")) unexpected("')'");
    return inner;
  }
  PartPtr named(const Word& w) {
    if (sign("(")) return call(w);
    if (w.text == "true" || w.text == "false") return std::make_unique<NumberPart>(truth(w.text == "true"), Kind::Truth);
    if (const auto attribute = find_attribute(frame_, w.text)) return std::make_unique<AttributePart>(*attribute);
    if (w.text == "index") return std::make_unique<IndexPart>();
    const std::vector<std::string> names = attribute_names(frame_);
    broken(code::attribute_missing, w.at, fmt::format("there is no attribute '{}'", w.text),
           {did_you_mean(w.text, names), fmt::format("Attributes: {}; texts stand in quotes", list_of(names))});
  }
  PartPtr call(const Word& w) {
    const auto found = std::find_if(functions.begin(), functions.end(), [&](const Function& f) { return f.name == w.text; });
    if (found == functions.end()) {
      std::vector<std::string> names;
      for (const Function& f : functions) names.emplace_back(f.name);
      broken(code::expression_syntax, w.at, fmt::format("there is no function '{}'", w.text), {did_you_mean(w.text, names), fmt::format("Functions: {}", list_of(names))});
    }
    ++at_;
    PartPtr a = sum();
    need(*a, Kind::Number, w.at, fmt::format("the argument of {}", w.text));
    PartPtr b;
    if (found->two) {
      if (!take(",")) unexpected("',' and a second value");
      b = sum();
      need(*b, Kind::Number, w.at, fmt::format("the argument of {}", w.text));
    }
    if (!take(")")) unexpected("')'");
    return b ? binary(std::move(a), std::move(b), found->two, Kind::Number) : unary(std::move(a), found->one, Kind::Number);
  }

  std::string_view text_;
  std::vector<Word> words_;
  std::size_t at_{};
  int depth_{};
  const data::Frame& frame_;
  const SourceLoc& loc_;
  Diagnostics& diagnostics_;
};

} // namespace

std::vector<bool> select_rows(std::string_view text, const data::Frame& frame, const SourceLoc& loc, Diagnostics& diagnostics) {
  PartPtr program;
  try {
    program = Parser(text, frame, loc, diagnostics).parse();
  } catch (const Broken&) {
    return {};
  }
  std::vector<bool> rows(frame.count);
  for (std::uint64_t row = 0; row < frame.count; ++row) rows[row] = program->number(row) != 0.0;
  return rows;
}

} // namespace mote
