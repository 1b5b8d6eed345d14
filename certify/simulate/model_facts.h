// SPDX-License-Identifier: Apache-2.0
//
// What a run has to know of its model beside how to integrate it.
#pragma once

#include <array>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "integrator/model.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/sha256.h"

namespace noli {

/// Which vertices nothing moves but the scene: no two cells of them alone are compared.
template <int Dim>
std::vector<std::uint8_t> labels_of(const integrator::Model<double, Dim>& model) {
  std::vector<std::uint8_t> labels(model.x.size(), 0);
  for (const VertexId v : model.pinned) labels[v] = scripted_vertex;
  for (const auto& script : model.scripts) labels[script.vertex] = scripted_vertex;
  return labels;
}

/// Which groups the scene lets pass through each other. Groups of which nothing moves by itself are not named: their
/// cells are not compared anyway.
template <int Dim>
Exclusions exclusions_of(const integrator::Model<double, Dim>& model) {
  Exclusions result;
  if (!model.contact) return result;
  const integrator::ContactSettings& contact = *model.contact;
  const std::vector<std::uint8_t> labels = labels_of<Dim>(model);
  std::vector<bool> moves(contact.group_count, false);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != scripted_vertex) moves[contact.groups[i]] = true;
  }
  for (std::uint16_t a = 0; a < contact.group_count; ++a) {
    for (std::uint16_t b = a; b < contact.group_count; ++b) {
      const std::uint16_t material = contact.material_of[contact.place(a, b, 0, 0)];
      if (material == integrator::ContactSettings::excluded && (moves[a] || moves[b])) {
        result.pairs.push_back({a, b});
      }
    }
  }
  if (!result.empty()) result.groups = contact.groups;
  return result;
}

/// Of what is free, at time 0 [J].
template <int Dim>
double kinetic_energy(const integrator::Model<double, Dim>& model) {
  const std::vector<std::uint8_t> held = integrator::held_vertices(model);
  double sum = 0;
  for (std::size_t i = 0; i < model.v.size(); ++i) {
    if (held[i] == 0) sum += 0.5 * model.mass[i] * model.v[i].squaredNorm();
  }
  return sum;
}

/// With which everything would move by 2^-30 of the model's size within a window [J]: where there is less, it may be
/// rounding that moves things.
template <int Dim>
double energy_of_rounding(const integrator::Model<double, Dim>& model) {
  const double mass = std::accumulate(model.mass.begin(), model.mass.end(), 0.0);
  const double speed = 0x1p-30 * integrator::extent<Dim>(model.x) / model.window_length;
  return 0.5 * mass * speed * speed;
}

inline void hash_numbers(std::span<const double> numbers, Sha256& hash) {
  std::string bytes;
  put_all(bytes, numbers);
  hash.update(bytes);
}

template <int Dim>
void hash_vectors(const std::vector<integrator::Vec<double, Dim>>& vectors, Sha256& hash) {
  for (const auto& v : vectors) hash_numbers(std::span<const double>(v.data(), Dim), hash);
}

/// Of what a model's motion follows from: initial state, masses, steps, paths. The scene is hashed apart; this tells
/// whether the files that it names are the same.
template <int Dim>
Sha256Digest hash_of(const integrator::Model<double, Dim>& model) {
  Sha256 hash;
  hash_vectors<Dim>(model.x, hash);
  hash_vectors<Dim>(model.v, hash);
  hash_numbers(model.mass, hash);
  std::apply([&](const auto&... list) { (hash_numbers(list.steps, hash), ...); }, model.forces.lists());
  for (const auto& script : model.scripts) {
    hash_numbers(script.times, hash);
    hash_vectors<Dim>(script.positions, hash);
  }
  if (model.contact) {
    for (const auto& m : model.contact->materials) {
      hash_numbers(std::array{m.thickness, m.stiffness, m.step, m.restitution, m.friction}, hash);
    }
  }
  return hash.digest();
}

}  // namespace noli
