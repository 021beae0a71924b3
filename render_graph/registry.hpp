// SPDX-License-Identifier: MIT
// The kinds of passes by name. Filled by explicit functions (register_builtin_passes and, for kinds
// that are read from files, whoever reads them), never by static initializers. Listing is sorted.
//
// kinds_text() and kinds_json() print what each kind takes, gives and understands, found by running
// declare() on no parameters at all: no device, no file.
#pragma once

#include "render_graph/pass.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mote::rg {

class Registry {
public:
  // Throws std::logic_error if the kind exists already, its name is no name or it has no factory.
  void add(PassKind kind);
  [[nodiscard]] const PassKind* find(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> names() const; // sorted

private:
  std::map<std::string, PassKind, std::less<>> kinds_;
};

struct KindInfo {
  std::string name{}, summary{};
  std::vector<Slot> slots{};       // as declared with default parameters
  std::vector<ParamInfo> params{}; // as asked for with no parameters given
  bool draws{};
};
std::vector<KindInfo> describe(const Registry& registry);

std::string kinds_text(const Registry& registry);
std::string kinds_json(const Registry& registry); // {"kinds": [{"name", "summary", "draws", "inputs", "outputs", "params"}]}
// JSON schema of graph files (draft 7), for editors.
std::string graph_schema(const Registry& registry);

std::string to_text(const SizeSpec& size);         // "view", "view*0.5", "640x480", "like a.b"
std::string to_text(const ResourceSpec& resource); // "rgba16float view", "buffer 16 bytes x 100"

// Throws std::logic_error for slots that contradict themselves (a kind's bug, not a file's): twice the same
// name in one direction, Write without `makes`, state without ReadWrite and `makes`, a buffer as attachment.
void check_slots(std::string_view kind, const std::vector<Slot>& slots);

} // namespace mote::rg
