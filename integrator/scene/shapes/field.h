// SPDX-License-Identifier: Apache-2.0
//
// A field of a scene's document, which the schema has accepted: reads its value, and names it in errors.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <noli/mesh.h>
#include "integrator/scene/json_text.h"

namespace noli::integrator {

/// Refers to its document, which must outlive it.
class Field {
 public:
  Field(const Json& document, std::string file) : document_(&document), file_(std::move(file)) {}

  Field operator[](std::string_view name) const { return {*this, at_ / std::string(name)}; }
  Field operator[](std::size_t item) const { return {*this, at_ / item}; }
  bool has(std::string_view name) const { return json().contains(name); }
  /// Items of an array, from first to last.
  std::vector<Field> items() const;

  const Json& json() const { return document_->at(at_); }
  std::string path() const { return at_.to_string(); }

  double number() const { return json().get<double>(); }
  std::string text() const { return json().get<std::string>(); }
  bool flag() const { return json().get<bool>(); }
  /// An integer in any notation (5, 5.0, 5e0). Precondition: in the range of T.
  template <class T = std::uint32_t>
  T count() const {
    return json().is_number_float() ? static_cast<T>(json().get<double>()) : json().get<T>();
  }
  std::optional<double> number_if(std::string_view name) const;

  template <std::size_t N>
  std::array<double, N> numbers() const {
    return json().get<std::array<double, N>>();
  }
  template <std::size_t N>
  std::array<std::uint32_t, N> counts() const {
    std::array<std::uint32_t, N> values{};
    for (std::size_t i = 0; i < N; ++i) values[i] = (*this)[i].count();
    return values;
  }
  /// As many numbers as the scene has dimensions; z = 0 in dimension 2. Throws InputError if there are more or fewer.
  Position vector() const;
  std::vector<Position> vectors() const;
  /// Throws InputError when the vector is zero.
  Position direction() const;

  /// A time longer than 2^-50 of the duration. Throws InputError when it is shorter.
  double countable_time() const;

  /// The window and the dimension of the scene.
  double window() const { return document_->at("window").get<double>(); }
  int dimension() const { return document_->at("dimension").get<int>(); }

  /// Throws InputError: the file, the path of this field, the problem.
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  Field(const Field& root, Json::json_pointer at) : document_(root.document_), file_(root.file_), at_(std::move(at)) {}

  const Json* document_;
  std::string file_;
  Json::json_pointer at_;
};

}  // namespace noli::integrator
