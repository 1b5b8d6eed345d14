// SPDX-License-Identifier: Apache-2.0
//
// mutate_conditions OUT FILE...: copies sources into OUT, so that the program that includes them leaves out one of its
// conditions, the one with the number in the environment variable NOLI_MUTANT. Prints a line for each: number, file,
// line, condition.
//
// A condition is a conjunct of the first argument of `require(...)` or `require_word(...)`, or of what
// `const bool apart`, `usable`, `same`, `covers` or `together` is initialised with.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace {

/// The end of the expression that begins at `at`: the comma, bracket or semicolon that is not within it.
std::size_t end_of_argument(const std::string& text, std::size_t at) {
  int depth = 0;
  for (bool quoted = false; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"' && text[at - 1] != '\\') quoted = !quoted;
    if (quoted) continue;
    if (c == '(' || c == '{' || c == '[') ++depth;
    if (depth == 0 && (c == ',' || c == ')' || c == ';')) return at;
    if (c == ')' || c == '}' || c == ']') --depth;
  }
  return at;
}

/// Its conjuncts, or it alone if it is no conjunction at the top.
std::vector<std::string> conjuncts(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(' || text[i] == '{' || text[i] == '[') ++depth;
    if (text[i] == ')' || text[i] == '}' || text[i] == ']') --depth;
    if (depth == 0 && (text.compare(i, 2, "||") == 0 || text[i] == '?')) return {text};
    if (depth == 0 && text.compare(i, 2, "&&") == 0) {
      parts.emplace_back();
      ++i;
    } else {
      parts.back() += text[i];
    }
  }
  return parts;
}

}  // namespace

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  static const std::regex place(
      R"(\brequire(?:_word)?\((?!bool )|\bconst bool (apart|usable|same|covers|together) =\s)");
  int number = 0;
  for (int i = 2; i < argc; ++i) {
    std::ifstream in(argv[i], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    std::string out;
    std::size_t done = 0;
    for (std::sregex_iterator m(text.begin(), text.end(), place), none; m != none; ++m) {
      const auto begin = static_cast<std::size_t>(m->position() + m->length());
      const std::size_t end = end_of_argument(text, begin);
      out += text.substr(done, begin - done);
      const auto parts = conjuncts(text.substr(begin, end - begin));
      for (std::size_t k = 0; k < parts.size(); ++k) {
        std::string shown = std::regex_replace(parts[k], std::regex("\\s+"), " ");
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
        std::cout << ++number << ' ' << fs::path(argv[i]).filename().string() << ' ' << line << ' ' << shown << '\n';
        out += (k > 0 ? " && " : "") + ("((" + parts[k]) + ") || noli_mutant(" + std::to_string(number) + "))";
      }
      done = end;
    }
    out += text.substr(done);
    const std::string head =
        "#pragma once\n#include <cstdlib>\n"
        "inline bool noli_mutant(int n) {\n  static const char* const wanted = std::getenv(\"NOLI_MUTANT\");\n"
        "  static const int number = wanted == nullptr ? 0 : std::atoi(wanted);\n  return n == number;\n}\n";
    if (fs::path(argv[i]).filename() == "base.h") out.replace(out.find("#pragma once\n"), 13, head);
    std::ofstream(fs::path(argv[1]) / fs::path(argv[i]).filename(), std::ios::binary) << out;
  }
  return 0;
}
