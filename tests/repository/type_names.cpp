// SPDX-License-Identifier: Apache-2.0
#include "type_names.h"

#include <cctype>
#include <map>
#include <optional>
#include <span>

#include "workspace.h"

namespace noli::repository {
namespace fs = std::filesystem;
namespace {

using Tokens = std::vector<std::string>;
using Statement = std::span<const std::string>;

bool begins_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool is_name(const std::string& token) {
  return !token.empty() && begins_word(token[0]) && std::isdigit(static_cast<unsigned char>(token[0])) == 0;
}

/// The place after the next `what`, or the end.
std::size_t after(std::string_view text, std::string_view what, std::size_t i) {
  const std::size_t found = text.find(what, i);
  return found == text.npos ? text.size() : found + what.size();
}

/// The place after the literal of text or character that begins at `i`.
std::size_t after_literal(std::string_view text, std::size_t i) {
  const char quote = text[i];
  for (++i; i < text.size() && text[i] != quote; ++i) i += text[i] == '\\' ? 1 : 0;
  return i + 1;
}

/// The place after the raw literal whose quote is at `i`.
std::size_t after_raw_literal(std::string_view text, std::size_t i) {
  const std::size_t open = text.find('(', i);
  const std::string close = ")" + std::string(text.substr(i + 1, open - i - 1)) + "\"";
  return after(text, close, open);
}

/// The end of the line, or of the last of the lines that backslashes join.
std::size_t after_directive(std::string_view text, std::size_t i) {
  std::size_t end = text.find('\n', i);
  while (end != text.npos && text[end - 1] == '\\') end = text.find('\n', end + 1);
  return end;
}

/// Words, "::" and single characters. Literals of text become "". Comments and directives go.
Tokens tokens_of(std::string_view text) {
  Tokens tokens;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view two = text.substr(i, 2);
    if (two == "//") {
      i = after(text, "\n", i);
    } else if (two == "/*") {
      i = after(text, "*/", i);
    } else if (text[i] == '#') {
      i = after_directive(text, i);
    } else if (two == "R\"") {
      tokens.emplace_back();
      i = after_raw_literal(text, i + 1);
    } else if (text[i] == '"' || text[i] == '\'') {
      tokens.emplace_back();
      i = after_literal(text, i);
    } else if (begins_word(text[i])) {
      const std::size_t begin = i;
      const bool number = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
      while (i < text.size() && (begins_word(text[i]) || (number && text[i] == '\''))) ++i;
      tokens.emplace_back(text.substr(begin, i - begin));
    } else if (two == "::") {
      tokens.emplace_back(two);
      i += 2;
    } else {
      if (std::isspace(static_cast<unsigned char>(text[i])) == 0) tokens.emplace_back(1, text[i]);
      ++i;
    }
  }
  return tokens;
}

/// The statement after the bracket that closes its first token.
Statement after_brackets(Statement s, const std::string& open, const std::string& close) {
  int depth = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    depth += s[i] == open ? 1 : s[i] == close ? -1 : 0;
    if (depth == 0) return s.subspan(i + 1);
  }
  return {};
}

/// Without template parameters, attributes and alignments at its beginning.
Statement without_prefixes(Statement s) {
  for (;;) {
    if (s.size() > 1 && s[0] == "template" && s[1] == "<") {
      s = after_brackets(s.subspan(1), "<", ">");
    } else if (s.size() > 1 && s[0] == "alignas" && s[1] == "(") {
      s = after_brackets(s.subspan(1), "(", ")");
    } else if (s.size() > 1 && s[0] == "[" && s[1] == "[") {
      s = after_brackets(s, "[", "]");
    } else {
      return s;
    }
  }
}

/// Takes a name with its "::" from the beginning of `s`.
std::string take_name(Statement& s) {
  std::string name;
  while (!s.empty() && (s[0] == "::" || (is_name(s[0]) && (name.empty() || name.ends_with("::"))))) {
    name += s[0];
    s = s.subspan(1);
  }
  return name;
}

/// The type that a statement defines, if any. `body`: whether the statement has reached a "{", not a ";".
std::optional<std::string> type_of(Statement s, bool body) {
  s = without_prefixes(s);
  if (s.empty()) return std::nullopt;
  if (s[0] == "using" && s.size() > 2 && is_name(s[1]) && (s[2] == "=" || s[2] == "[")) return s[1];
  if (s[0] == "typedef" && !body && is_name(s.back())) return s.back();
  if (!body || (s[0] != "class" && s[0] != "struct" && s[0] != "union" && s[0] != "enum")) return std::nullopt;
  s = s.subspan(s[0] == "enum" && s.size() > 1 && (s[1] == "class" || s[1] == "struct") ? 2 : 1);
  s = without_prefixes(s);
  const std::string name = take_name(s);
  const bool complete = s.empty() || s[0] == ":" || s[0] == "final";
  return complete && !name.empty() ? std::optional(name) : std::nullopt;
}

/// The namespace that a statement before a "{" opens: "" for one that adds no name, nullopt if it opens none.
std::optional<std::string> namespace_of(Statement s) {
  if (!s.empty() && s[0] == "inline") s = s.subspan(1);
  if (s.size() == 2 && s[0] == "extern" && s[1].empty()) return "";
  if (s.empty() || s[0] != "namespace") return std::nullopt;
  s = s.subspan(1);
  const std::string name = take_name(s);
  return name.empty() ? "" : name + "::";
}

}  // namespace

std::set<std::string> defined_types(std::string_view header) {
  std::set<std::string> types;
  std::vector<std::string> scopes = {""};  // what names begin with, in each namespace that is open
  Tokens statement;
  const auto note = [&](bool body) {
    if (const auto type = type_of(statement, body)) types.insert(scopes.back() + *type);
  };
  const Tokens tokens = tokens_of(header);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string& token = tokens[i];
    if (token == "{") {
      if (const auto opened = namespace_of(statement)) {
        scopes.push_back(scopes.back() + *opened);
        statement.clear();
        continue;
      }
      note(true);
      const Statement rest = after_brackets(Statement(tokens).subspan(i), "{", "}");
      i = tokens.size() - rest.size() - 1;  // the "}"
      const bool goes_on = !statement.empty() && (statement[0] == "typedef" || statement[0] == "using");
      if (!goes_on) statement.clear();
    } else if (token == "}") {
      if (scopes.size() > 1) scopes.pop_back();
      statement.clear();
    } else if (token == ";") {
      note(false);
      statement.clear();
    } else {
      statement.push_back(token);
    }
  }
  return types;
}

std::vector<std::string> types_defined_twice(const fs::path& root) {
  std::map<std::string, std::vector<std::string>> headers;
  for (const fs::path& path : files_below(root)) {
    const fs::path file = path.lexically_relative(root);
    if (path.extension() != ".h" || *file.begin() == "tests") continue;
    for (const std::string& type : defined_types(read_text(path))) headers[type].push_back(file.string());
  }
  std::vector<std::string> twice;
  for (const auto& [type, files] : headers) {
    if (files.size() < 2) continue;
    std::string line = type + ":";
    for (const std::string& file : files) line += (file == files.front() ? " " : ", ") + file;
    twice.push_back(line);
  }
  return twice;
}

}  // namespace noli::repository
