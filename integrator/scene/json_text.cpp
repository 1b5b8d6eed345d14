// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/json_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include <noli/errors.h>
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

/// "line 3, column 14" of the byte at `offset`, both from 1.
std::string place(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
  return fmt::format("line {}, column {}", line, before.size() - start + 1);
}

/// The parser's message without its own place: "syntax error while parsing value - unexpected ...".
std::string reason(std::string_view what) {
  for (const std::string_view start : {"syntax error", "number overflow"}) {
    if (const auto at = what.find(start); at != std::string_view::npos) return std::string(what.substr(at));
  }
  return std::string(what);
}

constexpr std::size_t deepest = 64;  ///< levels, as writing JSON for messages is recursive

/// Builds the document, and refuses fields that occur twice.
class Builder : public nlohmann::json_sax<Json> {
 public:
  Builder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Json result;

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    key_of_.back() = name;
    if (open_.back()->contains(name)) throw InputError(file_, path(), "expected this field once, found it twice");
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) override {
    throw InputError(file_, place(text_, position == 0 ? 0 : position - 1),
                     fmt::format("is not JSON: {}", reason(error.what())));
  }

 private:
  Json& insert(Json value) {
    end_if_stopped();
    if (open_.empty()) return result = std::move(value);
    if (open_.back()->is_array()) return open_.back()->emplace_back(std::move(value));
    return (*open_.back())[key_of_.back()] = std::move(value);
  }
  bool put(Json value) {
    insert(std::move(value));
    return true;
  }
  bool open(Json container) {
    Json& there = insert(std::move(container));
    if (open_.size() == deepest) throw InputError(file_, path(), fmt::format("expected at most {} levels", deepest));
    open_.push_back(&there);
    key_of_.emplace_back();
    return true;
  }
  bool close() {
    open_.pop_back();
    key_of_.pop_back();
    return true;
  }
  /// The JSON pointer of the field that is being read. Precondition: arrays already contain the current item.
  std::string path() const {
    Json::json_pointer pointer;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (open_[i]->is_array()) {
        pointer /= open_[i]->size() - 1;
      } else {
        pointer /= key_of_[i];
      }
    }
    return pointer.to_string();
  }

  std::string_view text_;
  const std::string& file_;
  std::vector<Json*> open_;          ///< from the outermost
  std::vector<std::string> key_of_;  ///< the last key of each
};

}  // namespace

Json parse_json(std::string_view text, const std::string& file) {
  Builder builder(text, file);
  Json::sax_parse(text, &builder);
  return std::move(builder.result);
}

std::string brief(const Json& value) {
  constexpr std::size_t longest = 60;
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& words) {
  const auto edits = [word](const std::string& w) { return edit_distance(word, w); };
  const auto least = std::ranges::min_element(words, {}, edits);
  if (least == words.end() || edits(*least) > std::max<std::size_t>(1, word.size() / 3)) return std::nullopt;
  return *least;
}

std::string nearest_or_all(std::string_view word, const std::vector<std::string>& words) {
  constexpr std::size_t most = 20;
  if (const auto near = nearest(word, words)) return "the nearest is " + Json(*near).dump();
  std::vector<std::string> quoted;
  for (const std::string& known : words) quoted.push_back(Json(known).dump());
  const bool all = quoted.size() <= most;
  quoted.resize(std::min(quoted.size(), most));
  return fmt::format("expected one of {}{}", fmt::join(quoted, ", "), all ? "" : ", ...");
}

}  // namespace noli::integrator
