// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/shapes/field.h"

#include <fmt/format.h>

#include <noli/errors.h>

namespace noli::integrator {

std::vector<Field> Field::items() const {
  std::vector<Field> result;
  for (std::size_t i = 0; i < json().size(); ++i) result.push_back((*this)[i]);
  return result;
}

std::optional<double> Field::number_if(std::string_view name) const {
  if (!has(name)) return std::nullopt;
  return (*this)[name].number();
}

Position Field::vector() const {
  const Json& value = json();
  if (value.size() != static_cast<std::size_t>(dimension())) {
    fail(fmt::format("expected {} numbers, as many as the scene has dimensions, found {}", dimension(), brief(value)));
  }
  return {value[0].get<double>(), value[1].get<double>(), dimension() == 3 ? value[2].get<double>() : 0.0};
}

std::vector<Position> Field::vectors() const {
  std::vector<Position> values;
  for (const Field& item : items()) values.push_back(item.vector());
  return values;
}

Position Field::direction() const {
  const Position value = vector();
  if (value == Position{}) fail("expected a vector that is not zero");
  return value;
}

double Field::countable_time() const {
  const double least = document_->at("duration").get<double>() * 0x1p-50;
  if (!(number() > least)) {
    fail(fmt::format("expected more than {} [s], 2^-50 of the duration, found {}: shorter times cannot be counted",
                     least, number()));
  }
  return number();
}

void Field::fail(const std::string& problem) const { throw InputError(file_, path().empty() ? "/" : path(), problem); }

}  // namespace noli::integrator
