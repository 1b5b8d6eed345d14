// SPDX-License-Identifier: Apache-2.0
//
// Makes a scene that fails simpler: members and items left out, numbers shortened.
#include <cmath>

#include "audit/fuzz/scenes/fuzz_scenes.h"

namespace noli::audit {

namespace {

using Pointer = SceneJson::json_pointer;

/// All places in a document, those that hold others before them.
void collect(const SceneJson& value, const Pointer& at, std::vector<Pointer>& places) {
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      places.push_back(at / key);
      collect(member, at / key, places);
    }
  }
  for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
    places.push_back(at / i);
    collect(value[i], at / i, places);
  }
}

std::vector<Pointer> places_of(const SceneJson& scene) {
  std::vector<Pointer> places;
  collect(scene, Pointer(), places);
  return places;
}

void erase(SceneJson& scene, const Pointer& place) {
  SceneJson& parent = scene[place.parent_pointer()];
  if (parent.is_array()) {
    parent.erase(static_cast<std::size_t>(std::stoull(place.back())));
  } else {
    parent.erase(place.back());
  }
}

class SceneMinimiser {
 public:
  SceneMinimiser(SceneJson scene, const std::function<bool(const SceneJson&)>& fails, std::size_t budget)
      : scene_(std::move(scene)), fails_(fails), budget_(budget) {}

  SceneJson run() {
    for (bool smaller = true; smaller;) {
      smaller = leave_out();
      smaller = shorten() || smaller;
    }
    return scene_;
  }

 private:
  bool accept(const SceneJson& candidate) {
    if (budget_ == 0) return false;
    --budget_;
    if (!fails_(candidate)) return false;
    scene_ = candidate;
    return true;
  }

  bool leave_out() {
    bool progress = false;
    std::vector<Pointer> places = places_of(scene_);
    for (std::size_t i = 0; i < places.size() && budget_ > 0;) {
      SceneJson candidate = scene_;
      erase(candidate, places[i]);
      if (accept(candidate)) {
        places = places_of(scene_);
        progress = true;
      } else {
        ++i;
      }
    }
    return progress;
  }

  bool shorten() {
    bool progress = false;
    for (const Pointer& place : places_of(scene_)) {
      if (!scene_[place].is_number()) continue;
      const std::string before = scene_[place].dump();
      for (const double value : {0.0, 1.0, std::round(scene_[place].get<double>())}) {
        SceneJson candidate = scene_;
        candidate[place] = value;
        if (value == std::trunc(value) && std::abs(value) < 1e9) candidate[place] = static_cast<std::int64_t>(value);
        if (candidate[place].dump().size() < before.size() && accept(candidate)) {
          progress = true;
          break;
        }
      }
    }
    return progress;
  }

  SceneJson scene_;
  const std::function<bool(const SceneJson&)>& fails_;
  std::size_t budget_;
};

}  // namespace

SceneJson minimise(const SceneJson& scene, const std::function<bool(const SceneJson&)>& fails, std::size_t budget) {
  return SceneMinimiser(scene, fails, budget).run();
}

}  // namespace noli::audit
