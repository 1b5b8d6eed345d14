// SPDX-License-Identifier: Apache-2.0
//
// Facts about a model that a run needs in addition to integrating it.
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

/// Marks vertices that only the scene moves: two cells that have only such vertices are not compared.
template <int Dim>
std::vector<std::uint8_t> labels_of(const integrator::Model<double, Dim>& model) {
  std::vector<std::uint8_t> labels(model.x.size(), 0);
  for (const VertexId v : model.pinned) labels[v] = scripted_vertex;
  for (const auto& script : model.scripts) labels[script.vertex] = scripted_vertex;
  return labels;
}

/// The pairs of groups that the scene lets pass through each other. Groups without free vertices are left out: their
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

/// The kinetic energy of all free vertices at time 0 [J].
template <int Dim>
double kinetic_energy(const integrator::Model<double, Dim>& model) {
  const std::vector<std::uint8_t> held = integrator::held_vertices(model);
  double sum = 0;
  for (std::size_t i = 0; i < model.v.size(); ++i) {
    if (held[i] == 0) sum += 0.5 * model.mass[i] * model.v[i].squaredNorm();
  }
  return sum;
}

/// The kinetic energy with which everything would move by 2^-30 of the model's size within a window [J]. Smaller
/// motions may come from rounding.
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

/// The hash of everything that determines a model's motion: initial state, masses, steps, paths. The scene has a hash
/// of its own; this one shows whether the files that it names have changed.
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
