// SPDX-License-Identifier: Apache-2.0
#include "app/wrong_usage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>
#include <utility>

#include "app/help.h"

namespace noli::app {
namespace {

/// Names that other programs have for what is here, and what to do instead.
struct OtherName {
  std::string_view name, needs, instead;  ///< `needs`: the option that the command must have for this advice
};
constexpr std::array<OtherName, 20> other_names = {{
    {"--tolerance", "--min-distance",
     "answers are exact, there is no tolerance; --min-distance DISTANCE asks for a gap"},
    {"--eps", "--min-distance", "answers are exact, there is no tolerance; --min-distance DISTANCE asks for a gap"},
    {"--epsilon", "--min-distance", "answers are exact, there is no tolerance; --min-distance DISTANCE asks for a gap"},
    {"--thickness", "--min-distance", "--min-distance DISTANCE asks for a gap"},
    {"--distance", "--min-distance", "--min-distance DISTANCE asks for a gap"},
    {"--jobs", "--threads", "--threads N says how many threads"},
    {"-j", "--threads", "--threads N says how many threads"},
    {"--timeout", "--time-limit", "--time-limit TIME ends the work"},
    {"--duration", "--until", "--until SECONDS says when to stop, --time-limit TIME ends the work"},
    {"--out", "--json", "--json OUT writes the result"},
    {"-o", "--json", "--json OUT writes the result"},
    {"--output", "--json", "--json OUT writes the result"},
    {"--all", "--keep-going", "--keep-going goes through all steps"},
    {"--continue", "--keep-going", "--keep-going goes through all steps"},
    {"--sort", "--order", "--order natural sorts frames by the numbers in their names"},
    {"--natural", "--order", "--order natural sorts frames by the numbers in their names"},
    {"--overwrite", "--force", "--force lets outputs replace files"},
    {"-f", "--force", "--force lets outputs replace files"},
    {"-y", "--force", "--force lets outputs replace files"},
    {"--silent", "--quiet", "-q prints nothing and leaves the exit code"},
}};

/// A word of the user as messages quote it: of a long one the beginning.
std::string quoted_word(const std::string& word) {
  constexpr std::size_t most = 80;
  return word.size() <= most ? word : word.substr(0, most) + "...";
}

/// Least number of letters to insert, to remove, to replace or to exchange with the next.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = std::exchange(last, row);
  }
  return last.back();
}

std::vector<std::string> commands_below(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::string more_help(const CLI::App& app) { return fmt::format("see `{} --help`", full_name(app)); }

/// Not a negative number.
bool is_option(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-' && argument != "--" &&
         std::string_view("0123456789.").find(argument[1]) == std::string_view::npos;
}

bool known_option(const CLI::App& app, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  if (name.size() > 2 && name[1] != '-') return std::ranges::count(options_of(app), name.substr(0, 2)) > 0;
  return std::ranges::count(options_of(app), name) > 0;
}

/// Dashes for underscores, two of them at the beginning of a word.
std::string as_option(std::string name) {
  std::ranges::replace(name, '_', '-');
  if (name.size() > 2 && name[1] != '-') name.insert(0, 1, '-');
  return name;
}

/// Of a word within a longer name, as in --ring for --min-distance-from-ring, the one option that has it.
std::optional<std::string> nearest_option(const CLI::App& app, const std::string& name) {
  if (name.size() < 4) return std::nullopt;
  const std::vector<std::string> known = options_of(app);
  if (const auto meant = nearest(name, known)) return meant;
  const std::string word = name.substr(1);  // "-ring"
  const auto has = [&](const std::string& one) { return one.size() > 2 && one.find(word, 1) != std::string::npos; };
  const auto found = std::ranges::find_if(known, has);
  return std::ranges::count_if(known, has) == 1 ? std::optional(*found) : std::nullopt;
}

/// "-j" of "-j4", "--order" of "--order=natural"
std::string name_of(const std::string& argument) {
  const bool with_number = argument.size() > 2 && argument[1] != '-' && argument[2] >= '0' && argument[2] <= '9';
  return with_number ? argument.substr(0, 2) : argument.substr(0, argument.find('='));
}

std::string unknown_option(const CLI::App& app, const std::string& argument) {
  const std::string name = name_of(argument);
  const std::string what = fmt::format("`{}` has no option {}", full_name(app), quoted_word(name));
  if (const auto meant = nearest_option(app, as_option(name))) {
    return fmt::format("{}; did you mean {}? {}", what, *meant, more_help(app));
  }
  const auto* const other = std::ranges::find(other_names, name, &OtherName::name);
  const bool helps = other != other_names.end() && known_option(app, std::string(other->needs));
  return helps ? fmt::format("{}: {}", what, other->instead) : fmt::format("{}; {}", what, more_help(app));
}

/// "X not in {a,b}" with what may have been meant.
std::optional<std::string> unknown_value(const std::string& said) {
  static constexpr std::string_view middle = " not in {";
  const std::size_t at = said.find(middle), end = said.rfind('}');
  if (at == std::string::npos || end == std::string::npos || end < at) return std::nullopt;
  const std::size_t colon = said.find(": ");
  const std::string option = colon < at ? said.substr(0, colon + 2) : "";
  const std::string value = said.substr(option.size(), at - option.size());
  std::vector<std::string> known;
  std::string one;
  for (const char c : said.substr(at + middle.size(), end - at - middle.size()) + ",") {
    if (c == ',') {
      known.push_back(std::exchange(one, ""));
    } else {
      one += c;
    }
  }
  const auto meant = nearest(value, known);
  return fmt::format(
      "{}{} is unknown; {}", option, value.empty() ? "''" : quoted_word(value),
      meant ? fmt::format("did you mean {}?", *meant) : fmt::format("expected one of {};", fmt::join(known, ", ")));
}

/// What CLI11 says of a fault, as the texts between its parts, and what we say of these parts.
struct Wording {
  std::array<std::string_view, 4> between;  ///< the first may be empty: then the first part is what stands before it
  const char* ours;
};
constexpr std::array<Wording, 8> wordings = {{
    {{"Could not convert: ", " = "}, "{0}: {1} is not a number;"},
    {{"", ": Value ", " not in range ", " to "}, "{0}: {1} is wrong; expected a number from {2} to {3};"},
    {{"", " excludes "}, "{0} and {1} cannot be combined; drop one of them;"},
    {{"", " requires "}, "{0} needs {1};"},
    {{"", ": 1 required ", " missing"}, "{0} needs a value, {1};"},
    {{"", ": ", " required ", " missing"}, "{0} needs {1} values, {2};"},
    {{"", ": At Most 1 required but received "}, "{0} was given {1} times; expected it once;"},
    {{"", ": At least ", " required but received "}, "{0} needs {1} values, but got {2};"},
}};

/// The parts of what is said, without checks behind the name of a type ("N:INT in [0 - 9]"); nothing if it is not so.
std::optional<std::array<std::string, 4>> parts_of(const std::string& said, const Wording& wording) {
  if (!said.starts_with(wording.between[0])) return std::nullopt;
  std::array<std::string, 4> parts;
  std::size_t at = wording.between[0].size();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string_view next = i + 1 < wording.between.size() ? wording.between[i + 1] : "";
    const std::size_t end = next.empty() ? said.size() : said.find(next, at);
    if (end == std::string::npos) return std::nullopt;
    parts[i] = quoted_word(said.substr(at, end - at));
    if (const std::size_t check = parts[i].find(":{"); check != std::string::npos) parts[i].resize(check);
    if (next.empty()) break;
    at = end + next.size();
  }
  return parts;
}

std::string reworded(const std::string& said) {
  for (const Wording& wording : wordings) {
    const auto parts = parts_of(said, wording);
    if (parts) return fmt::format(fmt::runtime(wording.ours), (*parts)[0], (*parts)[1], (*parts)[2], (*parts)[3]);
  }
  constexpr std::size_t most = 300;
  return said.substr(0, most) + ";";
}

std::string missing(const CLI::App& app, const std::string& said) {
  for (const CLI::Option* const option : app.get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    return fmt::format("`{}` needs {} ({}); {}", full_name(app), option_in_words(*option), option->get_description(),
                       more_help(app));
  }
  return said;
}

/// CLI11 describes a fault in a line or two; the user gets one.
std::string on_one(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

std::optional<std::string> nearest(const std::string& word, const std::vector<std::string>& known) {
  const std::size_t most = std::max<std::size_t>(word.size() < 4 ? 1 : 2, word.size() / 3);
  constexpr std::size_t longest = 60;  // nobody mistypes a longer one
  if (word.size() > longest) return std::nullopt;
  std::optional<std::string> best;
  std::size_t least = most + 1;
  for (const std::string& name : known) {
    const bool begins = word.size() > 3 && name.starts_with(word);
    const std::size_t distance = begins ? 1 : edits(word, name);
    if (distance < std::min(least, std::max(word.size(), name.size()))) {
      least = distance;
      best = name;
    }
  }
  return best;
}

CLI::App& named_command(CLI::App& app, std::vector<std::string> arguments, std::vector<std::string>& rest) {
  CLI::App* command = &app;
  std::size_t at = 0;
  for (; at < arguments.size(); ++at) {
    if (is_option(arguments[at])) continue;
    const auto below = command->get_subcommands([&](const CLI::App* one) { return one->get_name() == arguments[at]; });
    if (below.empty()) break;
    command = below.front();
  }
  rest.assign(arguments.begin() + static_cast<std::ptrdiff_t>(at), arguments.end());
  return *command;
}

std::string unknown_command(const CLI::App& app, const std::string& word) {
  const std::string what = fmt::format("`{}` has no command {}", full_name(app), quoted_word(word));
  if (const auto meant = nearest(word, commands_below(app))) {
    return fmt::format("{}; did you mean {}? {}", what, *meant, more_help(app));
  }
  if (app.get_parent() == nullptr && word.find('.') != std::string::npos) {
    return fmt::format("{}; to verify frames: noli verify FRAMES...; {}", what, more_help(app));
  }
  return fmt::format("{}; expected one of {}; {}", what, fmt::join(commands_below(app), ", "), more_help(app));
}

namespace {

/// "noli -q verify": options stand behind the command.
std::optional<std::string> option_before_command(const CLI::App& app, const CLI::App& command,
                                                 const std::vector<std::string>& arguments) {
  const bool before = &app != &command && is_option(arguments.front()) && !known_option(app, arguments.front()) &&
                      known_option(command, arguments.front());
  if (!before) return std::nullopt;
  return fmt::format("{} comes before the command; put it after: {} {}", arguments.front(), full_name(command),
                     arguments.front());
}

}  // namespace

std::optional<std::string> wrong_usage(CLI::App& app, const std::vector<std::string>& arguments,
                                       const CLI::ParseError& error) {
  std::vector<std::string> rest;
  const CLI::App& command = named_command(app, arguments, rest);
  if (const auto early = option_before_command(app, command, arguments)) return early;
  if (!commands_below(command).empty()) {
    if (!rest.empty()) return unknown_command(command, rest.front());
    for (const std::string& argument : arguments) {
      if (is_option(argument) && !known_option(command, argument)) return unknown_option(command, argument);
    }
    return std::nullopt;
  }
  const bool may_be_misspelt = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                               dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  for (const std::string& argument : arguments) {
    if (may_be_misspelt && is_option(argument) && !known_option(command, argument)) {
      return unknown_option(command, argument);
    }
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return missing(command, on_one(error.what()));
  const std::string said = on_one(error.what());
  return fmt::format("{} {}", unknown_value(said).value_or(reworded(said)), more_help(command));
}

}  // namespace noli::app
