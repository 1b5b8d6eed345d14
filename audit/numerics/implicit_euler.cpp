// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/implicit_euler.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>

namespace noli::audit {
namespace {

using integrator::Model;
using integrator::VertexVectors;

constexpr int most_corrections = 200;
constexpr double solved = 1e-9;
/// Relative residual of the linear equations of one correction; the next correction makes up for the rest.
constexpr double most_residual = 1e-3;

template <int Dim>
class ImplicitEuler {
 public:
  using Vec = integrator::Vec<double, Dim>;

  ImplicitEuler(const Model<double, Dim>& model, double step)
      : model_(model),
        free_(free_vertices(model)),
        h_(step),
        x_(model.x),
        v_(model.v),
        size_(integrator::extent<Dim>(model.x)) {
    for (std::size_t i = 0; i < v_.size(); ++i) {
      if (!free_[i]) v_[i].setZero();
    }
    solver_.setTolerance(most_residual);
  }

  void step() {
    const std::vector<Vec> before = x_;
    std::vector<Vec> target = x_;  // where inertia and gravity alone would take the vertices
    for (std::size_t i = 0; i < x_.size(); ++i) {
      if (!free_[i]) continue;
      target[i] += h_ * v_[i];
      if (model_.gravity) target[i] += (h_ * h_) * model_.gravity->acceleration;
    }
    x_ = target;
    bool done = false;
    for (int i = 0; i < most_corrections && !done; ++i) done = correct(target);
    converged_ = converged_ && done;
    for (std::size_t i = 0; i < x_.size(); ++i) v_[i] = (x_[i] - before[i]) / h_;
  }

  Sample<Dim> sample() const { return {x_, v_}; }
  bool converged() const { return converged_; }
  std::uint64_t evaluations() const { return evaluations_; }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  /// Makes one correction of x'; true if it was small.
  bool correct(const std::vector<Vec>& target) {
    const auto n = static_cast<Eigen::Index>(x_.size() * Dim);
    entries_.clear();
    residual_.setZero(n);
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double inertia = free_[i] ? model_.mass[i] / (h_ * h_) : 1;
      for (int k = 0; k < Dim; ++k) {
        entries_.emplace_back(row(i, k), row(i, k), inertia);
        if (free_[i]) residual_[row(i, k)] = inertia * (x_[i][k] - target[i][k]);
      }
    }
    for_each_list(model_, [&](const auto& list) { add(list.forces); });
    Matrix matrix(n, n);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    solver_.compute(matrix);
    const Eigen::VectorXd correction = solver_.solve(residual_);
    for (std::size_t i = 0; i < x_.size(); ++i) {
      for (int k = 0; k < Dim; ++k) x_[i][k] -= correction[row(i, k)];
    }
    return correction.cwiseAbs().maxCoeff() <= solved * size_;
  }

  static int row(std::size_t vertex, int k) { return static_cast<int>(vertex) * Dim + k; }

  template <class F>
  void add(const std::vector<F>& forces) {
    evaluations_ += forces.size();
    VertexVectors<double, Dim, F::size> x;
    for (const F& force : forces) {
      for (std::size_t i = 0; i < F::size; ++i) x[i] = x_[force.vertices[i]];
      const auto gradient = force.gradient(x);
      for (std::size_t i = 0; i < F::size; ++i) {
        const VertexId v = force.vertices[i];
        for (int k = 0; k < Dim && free_[v]; ++k) residual_[row(v, k)] += gradient[i][k];
      }
      add_stiffness(force, x);
    }
  }

  template <class F>
  void add_stiffness(const F& force, const VertexVectors<double, Dim, F::size>& x) {
    const auto gradients = force.measure_gradients(x);
    const auto stiffness = force.stiffness();
    for (std::size_t i = 0; i < F::size; ++i) {
      for (std::size_t j = 0; j < F::size; ++j) {
        const VertexId a = force.vertices[i], b = force.vertices[j];
        if (!free_[a] || !free_[b]) continue;
        for (int k = 0; k < Dim; ++k) {
          for (int l = 0; l < Dim; ++l) {
            double sum = 0;
            for (std::size_t m = 0; m < F::measures; ++m) sum += stiffness[m] * gradients[m][i][k] * gradients[m][j][l];
            entries_.emplace_back(row(a, k), row(b, l), sum);
          }
        }
      }
    }
  }

  const Model<double, Dim>& model_;
  std::vector<bool> free_;
  double h_;
  std::vector<Vec> x_, v_;
  double size_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd residual_;
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver_;
  std::uint64_t evaluations_ = 0;
  bool converged_ = true;
};

}  // namespace

template <int Dim>
SampledRun<Dim> run_implicit_euler(const Model<double, Dim>& model, double step, int windows,
                                   const std::atomic<bool>* stop) {
  ImplicitEuler<Dim> method(model, step);
  const auto steps = static_cast<std::uint64_t>(std::llround(model.window_length / step));
  SampledRun<Dim> run;
  sample_windows<Dim>(
      run, windows, stop,
      [&] {
        for (std::uint64_t i = 0; i < steps && !stopped(stop); ++i) method.step();
      },
      [&] { return method.sample(); });
  run.events = method.evaluations();
  run.converged = method.converged();
  return run;
}

template SampledRun<2> run_implicit_euler(const Model<double, 2>&, double, int, const std::atomic<bool>*);
template SampledRun<3> run_implicit_euler(const Model<double, 3>&, double, int, const std::atomic<bool>*);

}  // namespace noli::audit
