// SPDX-License-Identifier: Apache-2.0
//
// The kernel's algebraic numbers beside CGAL's Algebraic_kernel_d_1, on the polynomials of real first times of contact:
// all roots in [0, 1]; the order of two times; the sign of a polynomial at a time. Both begin with polynomials in their
// own numbers, and give the same answers, which is checked before they are timed.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <noli/cgal.h>
#include <noli/time_of_impact.h>
#include "bench/bench.h"
#include "bench/data.h"
#include "bench/report.h"
#include "kernel/arithmetic/algebraic.h"
#include "kernel/cgal_numbers.h"

namespace noli::bench {
namespace {

using Reals = std::vector<AlgebraicKernel::Algebraic_real_1>;

/// What both are asked, in numbers of each.
struct Work {
  std::vector<Polynomial> ours;
  std::vector<AlgebraicKernel::Polynomial_1> cgals;
  std::vector<AlgebraicNumber> times;  ///< one of each polynomial
  Reals cgals_times;
};

std::vector<AlgebraicNumber> roots(const Polynomial& p) { return roots_in_unit_interval(p); }

Reals roots(const AlgebraicKernel::Polynomial_1& p) {
  Reals found;
  AlgebraicKernel().solve_1_object()(p, false, 0, 1, std::back_inserter(found));
  return found;
}

/// Of the times of impact that have no closed form within the numbers at hand: irrational ones.
void add(const TimeOfImpact& time, Work& work) {
  const AlgebraicNumber& t = time.algebraic();
  if (t.is_rational()) return;
  work.ours.push_back(t.polynomial().primitive());
  work.cgals.push_back(cgal_detail::polynomial(work.ours.back()));
  work.times.push_back(t);
  work.cgals_times.push_back(to_algebraic_real_1(time));
}

std::shared_ptr<Work> work_of(const QueryFile& file) {
  auto work = std::make_shared<Work>();
  std::visit(
      [&](const auto& queries) {
        for (const auto& query : queries) {
          if (const auto first = first_contact(query)) add(first->time, *work);
        }
      },
      file.queries);
  return work;
}

void require(bool same, const std::string& what) {
  if (!same) throw std::logic_error("noli_bench_algebraic: " + what + " differ");
}

std::size_t count_roots(const auto& polynomials) {
  std::size_t count = 0;
  for (const auto& p : polynomials) count += roots(p).size();
  return count;
}

/// Of times that follow one another.
std::size_t count_earlier(const std::vector<AlgebraicNumber>& times) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < times.size(); ++i) count += times[i - 1] < times[i];
  return count;
}
std::size_t count_earlier(const Reals& times) {
  const auto compare = AlgebraicKernel().compare_1_object();
  std::size_t count = 0;
  for (std::size_t i = 1; i < times.size(); ++i) count += compare(times[i - 1], times[i]) == CGAL::SMALLER;
  return count;
}

/// Of the polynomial before at each time.
std::size_t count_positive(const Work& work, const std::vector<AlgebraicNumber>& times) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < times.size(); ++i) count += times[i].sign_of(work.ours[i - 1]) > 0;
  return count;
}
std::size_t count_positive(const Work& work, const Reals& times) {
  const auto sign = AlgebraicKernel().sign_at_1_object();
  std::size_t count = 0;
  for (std::size_t i = 1; i < times.size(); ++i) count += sign(work.cgals[i - 1], times[i]) == CGAL::POSITIVE;
  return count;
}

/// CGAL's numbers remember what they have found out, so each pass begins with copies made from intervals.
Reals anew(const Work& work) {
  const auto construct = AlgebraicKernel().construct_algebraic_real_1_object();
  Reals result;
  for (std::size_t i = 0; i < work.times.size(); ++i) {
    const AlgebraicNumber& t = work.times[i];
    result.push_back(construct(work.cgals[i], cgal_detail::gmpq(t.low()), cgal_detail::gmpq(t.high())));
  }
  return result;
}

void register_work(const std::string& name, const std::shared_ptr<Work>& work) {
  require(count_roots(work->ours) == count_roots(work->cgals), "roots");
  require(count_earlier(work->times) == count_earlier(work->cgals_times), "orders");
  require(count_positive(*work, work->times) == count_positive(*work, work->cgals_times), "signs");
  register_passes("noli/roots/" + name, [work] { return count_roots(work->ours); });
  register_passes("cgal/roots/" + name, [work] { return count_roots(work->cgals); });
  register_passes("noli/order/" + name, [work] { return count_earlier(std::vector(work->times)); });
  register_passes("cgal/order/" + name, [work] { return count_earlier(anew(*work)); });
  register_passes("noli/sign/" + name, [work] { return count_positive(*work, std::vector(work->times)); });
  register_passes("cgal/sign/" + name, [work] { return count_positive(*work, anew(*work)); });
  register_passes("cgal/anew/" + name, [work] { return anew(*work).size(); });
}

}  // namespace

bool run() {
  std::vector<std::pair<std::string, std::shared_ptr<Work>>> all;
  for (const QueryFile& file : read_query_files()) {
    auto work = work_of(file);
    if (work->ours.size() < 10) continue;
    register_work(file.name, work);
    all.emplace_back(file.name, std::move(work));
  }
  if (all.empty()) return false;
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  Table table({"times of impact of", "irrational", "roots, ns", "CGAL / ours", "order, ns", "CGAL / ours", "sign, ns",
               "CGAL / ours"});
  for (const auto& [name, work] : all) {
    const auto ns = [&, of = name, n = static_cast<double>(work->ours.size())](const std::string& what) {
      const double* const median = reporter.median_ns(what + of);
      return median != nullptr ? *median / n : 0;
    };
    const double making = ns("cgal/anew/");
    std::vector<std::string> row{name, fmt::format("{}", work->ours.size())};
    for (const std::string what : {"roots/", "order/", "sign/"}) {
      const double own = ns("noli/" + what), other = ns("cgal/" + what) - (what == "roots/" ? 0 : making);
      row.push_back(fmt::format("{:.0f}", own));
      row.push_back(fmt::format("{:.1f}", own > 0 ? other / own : 0));
    }
    table.row(row);
  }
  std::fputs(("\n" + table.text() + "\n").c_str(), stdout);
  return true;
}

}  // namespace noli::bench
