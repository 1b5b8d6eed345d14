// SPDX-License-Identifier: Apache-2.0
#include "app/help.h"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

namespace noli::app {
namespace {

constexpr std::size_t columns = 100, indent = 28;
constexpr std::size_t most_named = 2;  ///< of more options that exclude this one, the error message tells which

/// Appends words of the text as long as they fit; later lines are indented.
void append_wrapped(std::string& out, const std::string& text, std::size_t column, std::size_t hanging) {
  std::istringstream words(text);
  bool first = true;
  for (std::string word; words >> word; first = false) {
    if (!first && column + 1 + word.size() > columns) {
      out += '\n' + std::string(hanging, ' ');
      column = hanging;
      first = true;
    }
    out += (first ? "" : " ") + word;
    column += word.size() + (first ? 0 : 1);
  }
  out += '\n';
}

/// A name and what it means, in two columns; a long name has a line of its own.
std::string entry(const std::string& name, const std::string& meaning) {
  std::string out = "  " + name;
  if (out.size() + 2 > indent) {
    out += '\n' + std::string(indent, ' ');
  } else {
    out.resize(indent, ' ');
  }
  append_wrapped(out, meaning, indent, indent);
  return out;
}

/// "VALUE" of "VALUE:CHECK"
std::string value_of(const CLI::Option& option) {
  std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

std::string names_of_others(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : options) names.push_back(option->get_name(false, false));
  std::ranges::sort(names);
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string meaning_of(const CLI::Option& option) {
  std::string text = option.get_description();
  if (!option.get_default_str().empty()) text += " [default: " + option.get_default_str() + "]";
  if (!option.get_needs().empty()) text += " [with " + names_of_others(option.get_needs()) + "]";
  const auto excluded = option.get_excludes();
  if (!excluded.empty() && excluded.size() <= most_named) text += " [not with " + names_of_others(excluded) + "]";
  return text;
}

/// Its details, and its examples with all that is behind them.
std::pair<std::string, std::string> parts_of(const std::string& footer) {
  static const std::string mark = "Examples:\n";
  const std::size_t at = footer.find(mark);
  if (at == std::string::npos) return {footer, ""};
  std::string details = footer.substr(0, at);
  while (!details.empty() && details.back() == '\n') details.pop_back();
  return {details, footer.substr(at + mark.size())};
}

/// Each line is a paragraph, or as it is if it is indented.
std::string wrapped(const std::string& text) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  ") || line.empty()) {
      out += line + '\n';
    } else {
      append_wrapped(out, line, 0, 0);
    }
  }
  return out;
}

std::string usage(const CLI::App& app) {
  std::string line = "Usage: " + full_name(app);
  if (!app.get_subcommands([](const CLI::App*) { return true; }).empty()) return line + " COMMAND ...\n";
  for (const CLI::Option* const option : app.get_options()) {
    if (option->get_positional()) line += ' ' + option_in_words(*option);
  }
  return line + " [OPTIONS]\n";
}

std::string arguments(const CLI::App& app) {
  std::string out;
  for (const CLI::Option* const option : app.get_options()) {
    if (option->get_positional()) out += entry(option_in_words(*option), meaning_of(*option));
  }
  return out.empty() ? "" : "\nArguments:\n" + out;
}

std::string commands(const CLI::App& app) {
  std::string out;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) out += entry(command->get_name(), command->get_description());
  }
  return out.empty() ? "" : "\nCommands:\n" + out;
}

/// In the order in which they are shown.
std::vector<std::string> groups_of(const CLI::App& app) {
  std::vector<std::string> groups = app.get_groups();
  const auto place = [](const std::string& name) {
    if (name == "Options") return 0;
    if (name == group::question) return 1;
    if (name == group::output) return 3;
    return name == group::limits ? 4 : 2;
  };
  std::ranges::stable_sort(groups, {}, place);
  return groups;
}

std::string options(const CLI::App& app) {
  std::string out;
  for (const std::string& name : groups_of(app)) {
    std::string entries;
    for (const CLI::Option* const option : app.get_options()) {
      if (option->get_positional() || option->get_group() != name) continue;
      entries += entry(option_in_words(*option), meaning_of(*option));
    }
    if (!name.empty() && !entries.empty()) out += '\n' + name + ":\n" + entries;
  }
  return out;
}

}  // namespace

std::string help_of(const CLI::App& app) {
  const auto [details, examples] = parts_of(app.get_footer());
  std::string out = full_name(app) + ": " + app.get_description() + "\n\n" + usage(app);
  if (!examples.empty()) out += "\nExamples:\n" + examples;
  if (out.back() != '\n') out += '\n';
  out += arguments(app) + commands(app) + options(app);
  if (!details.empty()) out += '\n' + wrapped(details);
  return out;
}

void use_help(CLI::App& app) {
  app.formatter_fn([](const CLI::App* command, const std::string&, CLI::AppFormatMode) { return help_of(*command); });
  app.get_help_ptr()->description("Print this help");
}

std::string option_in_words(const CLI::Option& option) {
  const bool several = option.get_expected_max() > 1 && option.get_items_expected_max() > 100;
  const std::string value = value_of(option) + (several ? "..." : "");
  if (option.get_positional()) return option.get_required() ? value : "[" + value + "]";
  std::string names = option.get_name(false, true);
  if (const std::size_t comma = names.find(','); comma != std::string::npos) names.insert(comma + 1, " ");
  return value.empty() ? names : names + ' ' + value;
}

std::string full_name(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : full_name(*app.get_parent()) + ' ' + app.get_name();
}

}  // namespace noli::app
