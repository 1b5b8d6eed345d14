// SPDX-License-Identifier: Apache-2.0
#include "licences.h"

#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include "workspace.h"

namespace noli::repository {
namespace fs = std::filesystem;
namespace {

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// The text with comment signs and runs of white space as single spaces, so that sentences are found however wrapped.
std::string running_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool gap = contains(" \t\r\n*/#;", std::string_view(&c, 1));
    if (!gap) {
      out += c;
    } else if (!out.empty() && out.back() != ' ') {
      out += ' ';
    }
  }
  return out;
}

/// Whether one alternative of an SPDX expression is acceptable: no GPL without an exception, and no commercial licence.
bool may_be_chosen(const std::string& alternative) {
  static const std::regex gpl(R"((^|[^A-Za-z])A?GPL-)");
  const bool is_gpl = std::regex_search(alternative, gpl) && !contains(alternative, " WITH ");
  return !is_gpl && !contains(alternative, "LicenseRef-Commercial");
}

/// "A OR B" is acceptable if A or B is. Brackets are ignored: "(A OR B) AND C" is judged as "A OR (B AND C)".
bool acceptable(const std::string& expression) {
  static const std::regex either(R"(\s+OR\s+)");
  for (auto part = std::sregex_token_iterator(expression.begin(), expression.end(), either, -1);
       part != std::sregex_token_iterator(); ++part) {
    if (may_be_chosen(part->str())) return true;
  }
  return false;
}

/// The objection of the SPDX lines; empty if there is none. Sets `stated` if there is an SPDX line.
std::string spdx_objection(const std::string& text, bool& stated) {
  static const std::regex spdx(R"(SPDX-License-Identifier:[ \t]*([^\r\n]*))");
  for (auto line = std::sregex_iterator(text.begin(), text.end(), spdx); line != std::sregex_iterator(); ++line) {
    stated = true;
    const std::string expression = (*line)[1];
    if (!acceptable(expression)) return "is licensed " + expression;
  }
  return "";
}

bool speaks_of_gpl_alone(std::string_view text) {
  const std::string words = running_text(text);
  if (!contains(words, "GNU General Public License")) return false;
  for (const char* escape :
       {"Lesser General Public", "Library General Public", "Runtime Library Exception", "special exception"}) {
    if (contains(words, escape)) return false;
  }
  return true;
}

/// The sources that are compiled as one file (cmake/NoliBatches.cmake), else `file` alone.
std::vector<fs::path> sources_of(const fs::path& file) {
  if (file.parent_path().filename() != "Unity") return {file};
  static const std::regex include("#include \"([^\"]*)\"");
  const std::string text = read_text(file);
  std::vector<fs::path> sources;
  for (auto found = std::sregex_iterator(text.begin(), text.end(), include); found != std::sregex_iterator(); ++found)
    sources.emplace_back((*found)[1].str());
  return sources;
}

bool is_cgal(const fs::path& path) { return contains(path.generic_string(), "/include/CGAL/"); }

}  // namespace

std::string objection(const fs::path& path, std::string_view text) {
  const std::string name = path.generic_string();
  if (contains(name, "/CGAL/license/") && path.filename() != "lgpl.h")
    return "is what headers of CGAL's GPL packages include";
  if (path.filename() == "NonMPL2.h") return "is what Eigen's headers under other licences than MPL-2.0 include";
  if (path.filename() == "mpreal.h" || path.filename() == "MPRealSupport") return "is mpreal, which is under the GPL";
  bool stated = false;
  std::string problem = spdx_objection(std::string(text), stated);
  if (stated) return problem;
  if (is_cgal(path)) return "is CGAL's and states no licence";
  return speaks_of_gpl_alone(text) ? "is under the GNU General Public License" : "";
}

std::vector<CompileCommand> compile_commands(const fs::path& build) {
  static const std::regex output(R"( -o \S+)");
  static const std::regex input(R"( -c .*$)");
  std::vector<CompileCommand> commands;
  for (const auto& entry : nlohmann::json::parse(read_text(build / "compile_commands.json"))) {
    const std::string command = std::regex_replace(entry.at("command").get<std::string>(), output, "");
    for (const fs::path& source : sources_of(entry.at("file").get<std::string>())) {
      commands.push_back({source, std::regex_replace(command, input, ""), entry.at("directory").get<std::string>()});
    }
  }
  return commands;
}

std::vector<fs::path> files_read(const CompileCommand& command, const fs::path& input) {
  const auto [exit_code, output] = run("cd " + quoted(command.folder.string()) + " && " + command.flags +
                                       " -M -x c++ " + quoted(input.string()) + " 2>&1");
  if (exit_code != 0) throw std::runtime_error(input.string() + ": the compiler fails:\n" + output);
  std::set<fs::path> files;
  std::istringstream words(output.substr(output.find(':') + 1));
  for (std::string word; words >> word;) {
    if (word == "\\") continue;
    while (word.back() == '\\') {  // an escaped space
      std::string rest;
      words >> rest;
      word.back() = ' ';
      word += rest;
    }
    files.insert(fs::canonical(command.folder / word));
  }
  return {files.begin(), files.end()};
}

std::vector<std::string> licence_violations(const std::vector<fs::path>& files) {
  std::vector<std::string> violations;
  for (const fs::path& file : files) {
    const std::string problem = objection(file, read_text(file));
    if (!problem.empty()) violations.push_back(file.string() + " " + problem);
  }
  return violations;
}

std::vector<std::string> unexpected_libraries(std::string_view readelf_output) {
  static const std::regex needed(R"(\(NEEDED\)[^\[]*\[([^\]]*)\])");
  static const std::regex known(
      R"((lib(gmp|gmpxx|mpfr|png16|pugixml|zip|tbb|tbbmalloc|fmt|stdc\+\+|gcc_s|c|m|z|pthread|dl|rt))"
      R"(|lib(asan|ubsan|tsan))"
      R"(|ld-linux[-a-z0-9_]*)\.so.*)");
  const std::string text(readelf_output);
  std::vector<std::string> unexpected;
  for (auto line = std::sregex_iterator(text.begin(), text.end(), needed); line != std::sregex_iterator(); ++line) {
    if (!std::regex_match((*line)[1].str(), known)) unexpected.push_back((*line)[1]);
  }
  return unexpected;
}

std::vector<std::string> network_libraries(std::string_view ldd_output) {
  static const std::regex network(R"(\blib(hdf5|curl|gnutls|nettle|krb5|gssapi|ldap|lber|sasl|ssl|ssh|nghttp|aec)\S*)");
  const std::string text(ldd_output);
  return {std::sregex_token_iterator(text.begin(), text.end(), network), std::sregex_token_iterator()};
}

}  // namespace noli::repository
