// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/stability_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>

#include <noli/errors.h>
#include "certify/json.h"
#include "certify/process/run_program.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;

/// The columns of a table of numbers with a header line (`noli export --figure ... -o FILE.csv`).
using Columns = std::map<std::string, std::vector<double>>;

Columns columns_of(const std::string& text) {
  Columns columns;
  std::vector<std::vector<double>*> in_order;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line) && !lines.eof();) {  // an incomplete last line does not count
    const bool names = in_order.empty();
    std::istringstream cells(line);
    std::string cell;
    for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
      if (names) in_order.push_back(&columns[cell]);
      if (!names && i < in_order.size()) in_order[i]->push_back(std::strtod(cell.c_str(), nullptr));
    }
  }
  return columns;
}

bool all_finite(const Columns& columns) {
  return std::ranges::all_of(columns, [](const auto& column) {
    return std::ranges::all_of(column.second, [](double x) { return std::isfinite(x); });
  });
}

/// Tests one point. point_ is filled in promise by promise.
class Asking {
 public:
  Asking(const fs::path& folder, const StabilityOptions& options) : folder_(folder), options_(options) {}

  StabilityPoint scene(const SceneCase& what) {
    write_file(folder_ / "scene.json", what.scene);
    const ProgramEnd run = simulate("run", {});
    point_.exit_code = run.kind == ProgramEnd::Kind::exited ? run.code : -1;
    if (!ended_well(run)) return point_;
    const Json document = run.code == 3 ? Json() : Json::parse(run.out, nullptr, false);
    if (!agrees(run, document)) return point_;
    if (run.code == 3) {
      gives("refused", line_of(run.err));
      return point_;
    }
    const auto windows = document["windows"].get<std::uint64_t>();
    const bool unstable = document["verdict"] == "unstable";
    if (run.code != 0 && !unstable) {
      const auto end = document["end"].get<std::string>();
      gives(end, fmt::format("{} after {} of {} windows", end, windows, document["windows_total"].dump()));
    }
    if (windows > 0) verify_again(windows);
    if (run.code == 0 || unstable) look_at_series(what.free, unstable);
    if (run.code == 0) resume(document["time"].get<double>());
    return point_;
  }

  StabilityPoint frames(const FramesCase& what) {
    std::vector<std::string> words = {"verify", "--porcelain"};
    for (std::size_t i = 0; i < 2; ++i) {
      const fs::path file = folder_ / fmt::format("{}.ply", i);
      write_file(file, what.frames[i]);
      words.push_back(file.string());
    }
    words.insert(words.end(), {"--threads", "1", "--max-reports", "1"});
    const ProgramEnd run = noli(words);
    point_.exit_code = run.kind == ProgramEnd::Kind::exited ? run.code : -1;
    if (!ended_well(run)) return point_;
    const std::string expected = what.touch ? "verdict=contact " : "verdict=proved ";
    if (run.code == (what.touch ? 1 : 0) && run.out.starts_with(expected)) return point_;
    gives("answer", line_of(run.code <= 2 ? run.out : run.err));
    // "No answer" does not count as a wrong answer.
    if (run.code <= 1)
      finding(fmt::format("{}, but they {}", first_line(run.out), what.touch ? "touch" : "stay apart"));
    return point_;
  }

 private:
  ProgramEnd noli(std::vector<std::string> words) {
    words.insert(words.begin(), options_.program.string());
    const std::chrono::nanoseconds limit = 2 * options_.point_limit + std::chrono::seconds(10);
    ProgramEnd run = run_program(std::move(words), {limit, stop_by(options_.stop), 2 * time_to_end});
    point_.seconds += run.seconds;
    return run;
  }

  ProgramEnd simulate(const std::string& to, const std::vector<std::string>& more) {
    const auto limit = std::chrono::duration_cast<std::chrono::milliseconds>(options_.point_limit).count();
    std::vector<std::string> words = {
        "simulate",     (folder_ / "scene.json").string(), "-o",     path(to), "--threads",     "1",
        "--time-limit", fmt::format("{}ms", limit),        "--json", "-",      "--ignore-space"};
    words.insert(words.end(), more.begin(), more.end());
    return noli(words);
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// The first complaint on one line, without the folder, whose name differs each time.
  std::string line_of(const std::string& text) const {
    const std::string prefix = path("");
    std::string line = on_one_line(first_complaint(text));
    for (std::size_t at; (at = line.find(prefix)) != std::string::npos;) line.erase(at, prefix.size());
    return line;
  }

  /// Records the first promise that is broken.
  void gives(const std::string& what, const std::string& words) {
    if (!point_.gives.empty()) return;
    point_.gives = what;
    point_.message = words;
  }

  void finding(const std::string& words) { point_.findings.push_back(on_one_line(words)); }

  /// Records a promise broken by a run with exit code 0.
  void broken(const std::string& what, const std::string& words) {
    gives(what, words);
    finding(fmt::format("exit 0, but {}: {}", what, words));
  }

  /// True if the program exited by itself with a documented code.
  bool ended_well(const ProgramEnd& run) {
    if (run.kind == ProgramEnd::Kind::stopped) return false;
    if (run.kind == ProgramEnd::Kind::exited && run.code >= 0 && run.code <= 3) return true;
    gives(run.brief(), line_of(run.err));
    finding(run.brief() + (run.err.empty() ? "" : ": " + line_of(run.err)));
    return false;
  }

  /// True if the document has all members that are read below.
  static bool whole(const Json& document) {
    return document.is_object() && document.value("verdict", Json()).is_string() &&
           document.value("end", Json()).is_string() && document.value("time", Json()).is_number() &&
           document.value("windows", Json()).is_number_unsigned() &&
           document.value("windows_total", Json()).is_number_unsigned();
  }

  /// True if verdict and exit code agree, and a run that exits with 0 reached its end.
  bool agrees(const ProgramEnd& run, const Json& document) {
    if (run.code == 3 && !run.err.empty() && run.out.empty()) return true;
    static const std::map<std::string, int> codes = {{"no_contact", 0}, {"contact", 1},  {"too_near", 1},
                                                     {"not_finite", 1}, {"unstable", 1}, {"undecided", 2}};
    std::string problem;
    if (!whole(document)) {
      problem = "no document with a verdict";
    } else if (const auto code = codes.find(document["verdict"].get<std::string>());
               code == codes.end() || code->second != run.code) {
      problem = fmt::format("the verdict is {}", document["verdict"].dump());
    } else if (run.code == 0 && (document["end"] != "done" || document["windows"] != document["windows_total"])) {
      problem = fmt::format("{} of {} windows", document["windows"].dump(), document["windows_total"].dump());
    }
    if (problem.empty()) return true;
    gives("verdict", problem);
    finding(fmt::format("exit {}, but {}", run.code, problem));
    return false;
  }

  /// However a run ends, its committed windows must be free of contact.
  void verify_again(std::uint64_t windows) {
    const ProgramEnd run = noli({"verify", "--porcelain", path("run"), "--threads", "1"});
    if (!ended_well(run)) return;
    const std::string steps = fmt::format(" steps={} steps_total={} ", windows, windows);
    const bool good = run.out.starts_with("verdict=proved ") || run.out.starts_with("verdict=no_contact ");
    if (run.code == 0 && good && first_line(run.out).find(steps) != std::string::npos) return;
    gives("verified", first_line(run.out));
    finding(fmt::format("of a run with {} windows `noli verify` says, with exit {}: {}", windows, run.code,
                        line_of(run.out.empty() ? run.err : run.out)));
  }

  std::optional<Columns> series(const char* figure) {
    const std::string file = path(std::string(figure) + ".csv");
    const ProgramEnd run = noli({"export", path("run"), "--figure", figure, "-o", file, "--force"});
    if (!ended_well(run)) return std::nullopt;
    const Columns columns = columns_of(bytes_of(file));
    const std::size_t rows = columns.empty() ? 0 : columns.begin()->second.size();
    const bool whole = std::ranges::all_of(columns, [&](const auto& column) { return column.second.size() == rows; });
    if (run.code == 0 && rows > 0 && whole) return columns;
    broken("finite", fmt::format("there is no series of {}: {}", figure, line_of(run.err)));
    return std::nullopt;
  }

  /// `said`: the program reported the run as unstable.
  void look_at_series(bool free, bool said) {
    const auto energy = series("energy"), momentum = series("momentum");
    if (!energy || !momentum) return;
    if (!all_finite(*energy) || !all_finite(*momentum))
      return broken("finite", "a series contains a value that is not finite");
    look_at_energy(*energy, said);
    if (free) look_at_momentum(*momentum);
  }

  void look_at_energy(const Columns& energy, bool said) {
    // Scenes begin in their rest shape: the energy at the first window's end is the initial one plus the work.
    double work = 0;
    for (const auto& [name, column] : energy) {
      const auto is = [&quantity = name](const char* list) {
        return quantity.starts_with(list) && quantity.find("_of_material_") == quantity.npos;
      };
      if (is("work_") || is("damping_work_") || is("held_work_") || is("restitution_work")) work += column[0];
    }
    const double begin = energy.at("kinetic [J]")[0] - work;
    double worst = 0;
    for (const double total : energy.at("total [J]")) worst = std::max(worst, std::abs(total - begin));
    if (begin > 0) point_.energy_error = worst / begin;
    const bool stays = begin > 0 && *point_.energy_error <= most_energy_error;
    const std::string words =
        begin > 0 ? fmt::format("it was {:.3g} J, and drifted by {:.2g} of that", begin, *point_.energy_error)
                  : fmt::format("it was {:.3g} J, and drifted by {:.2g} J", begin, worst);
    if (said) return gives("energy", words);
    if (!stays) broken("energy", words);
  }

  void look_at_momentum(const Columns& momentum) {
    for (const std::string kind : {"momentum", "angular_momentum"}) {
      const std::string unit = kind == "momentum" ? " [N s]" : " [N m s]";
      std::array<std::string, 3> names;
      for (std::size_t k = 0; k < 3; ++k) names[k] = fmt::format("{}_{}{}", kind, "xyz"[k], unit);
      double size = 0, worst = 0;
      for (const std::string& name : names) size = std::hypot(size, momentum.at(name)[0]);
      for (std::size_t i = 0; i < momentum.at(names[0]).size(); ++i) {
        double off = 0;
        for (const std::string& name : names) off = std::hypot(off, momentum.at(name)[i] - momentum.at(name)[0]);
        worst = std::max(worst, off);
      }
      const double error = worst == 0 ? 0 : worst / size;
      point_.momentum_error = std::max(point_.momentum_error.value_or(0), error);
      if (!(error <= most_momentum_error)) broken(kind, fmt::format("{:.2g} of it is lost or gained", error));
    }
  }

  void resume(double end) {
    const ProgramEnd half = simulate("resumed", {"--until", fmt::format("{:.17g}", end / 2)});
    if (!ended_well(half)) return;
    const ProgramEnd rest = simulate("resumed", {"--resume"});
    if (!ended_well(rest)) return;
    if (half.code != 0 || rest.code != 0) {
      return broken("resume", fmt::format("exit {} halfway, then {}", half.code, rest.code));
    }
    for (const char* file : {"trajectory.blocks", "proof.blocks"}) {
      const std::string whole = bytes_of(folder_ / "run" / file);
      if (whole.empty() || whole != bytes_of(folder_ / "resumed" / file)) {
        return broken("resume", fmt::format("{} has different bytes", file));
      }
    }
  }

  const fs::path& folder_;
  const StabilityOptions& options_;
  StabilityPoint point_;
};

}  // namespace

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

StabilityPoint ask_point(const StabilityCase& what, const fs::path& folder, const StabilityOptions& options) {
  Asking asking(folder, options);
  if (const auto* scene = std::get_if<SceneCase>(&what)) return asking.scene(*scene);
  return asking.frames(std::get<FramesCase>(what));
}

}  // namespace noli::audit
