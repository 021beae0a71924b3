// SPDX-License-Identifier: MIT
// Located messages. Everything that reads what a user wrote (graph, scene, particle file, command
// line) reports through a Diagnostics list: all problems of a file at once, each with a stable
// code, a place and a sentence. A list that has an error means that nothing was run.
//
//   graph.toml:12:9: error G012: pass 'glow' input 'color' names 'opaque.colour', but ...
//   md.bin:@1032: error D004: ...                      (binary files: byte offset, no line)
//
// The code is the contract (docs/errors.md lists them all; tests check code and words); the text
// is for people. Nothing here prints by itself.
#pragma once

#include <cstdint>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote {

enum class Severity : std::uint8_t { Note, Warning, Error };
std::string_view to_string(Severity severity);

// Exit statuses of the command line (docs/errors.md).
enum class Exit : int {
  Done = 0,
  Failed = 1,        // rendering, writing; `compare`: the two differ
  Usage = 2,         // wrong command line
  BadInput = 3,      // a file that cannot be understood
  NoDevice = 4,      // no suitable Vulkan device
  Interrupted = 130, // SIGINT
  Terminated = 143,  // SIGTERM
};

// Where in a file. Text files: line and column from 1. Binary files: byte >= 0 and line 0.
// A place without line and byte names the file only; without a file it is the program itself.
struct SourceLoc {
  std::string file{};
  std::uint64_t line{};
  std::uint64_t column{};
  std::int64_t byte{-1};
  bool operator==(const SourceLoc&) const = default;
};
std::string to_string(const SourceLoc& loc); // "f:3:4", "f:@17", "f"

struct Diagnostic {
  Severity severity{Severity::Error};
  std::string code{}; // "G012"
  SourceLoc loc{};
  std::string text{};               // one sentence: what is wrong, with the offending value quoted
  std::vector<std::string> hints{}; // what exists instead, "Did you mean 'x'?"; one line each
};
std::string to_string(const Diagnostic& diagnostic); // several lines when there are hints

class Diagnostics {
public:
  void add(Diagnostic diagnostic) { list_.push_back(std::move(diagnostic)); }
  void error(std::string_view code, SourceLoc loc, std::string text, std::vector<std::string> hints = {});
  void warning(std::string_view code, SourceLoc loc, std::string text, std::vector<std::string> hints = {});
  void note(std::string_view code, SourceLoc loc, std::string text, std::vector<std::string> hints = {});
  void append(const Diagnostics& other);

  [[nodiscard]] bool has_errors() const;
  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] const std::vector<Diagnostic>& list() const { return list_; }
  [[nodiscard]] bool has(std::string_view code) const;
  void sort_by_place(); // stable: file, line, column, byte

private:
  std::vector<Diagnostic> list_;
};
std::string to_string(const Diagnostics& diagnostics);

// For places where going on makes no sense (a reader that met garbage). Carries one diagnostic and
// the exit status that a command line should end with; what() is the printed diagnostic.
class Failure : public std::exception {
public:
  Failure(Exit exit, Diagnostic diagnostic);
  [[nodiscard]] const char* what() const noexcept override { return printed_.c_str(); }
  [[nodiscard]] const Diagnostic& diagnostic() const { return diagnostic_; }
  [[nodiscard]] Exit exit() const { return exit_; }

private:
  Exit exit_;
  Diagnostic diagnostic_;
  std::string printed_;
};
[[noreturn]] void fail(Exit exit, std::string_view code, SourceLoc loc, std::string text,
                       std::vector<std::string> hints = {});

// "Did you mean 'x'?" for the candidate nearest to `word` (edit distance at most a third of its
// length, at least 1), or an empty string. Case is ignored.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);
// "a, b, c"; an empty list prints as "(none)".
std::string list_of(std::span<const std::string> words);

} // namespace mote
