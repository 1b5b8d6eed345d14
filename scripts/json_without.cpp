// SPDX-License-Identifier: Apache-2.0
//
// json_without FILE KEY...: the JSON in FILE on standard output, without the members called KEY, at any depth. For
// comparing results.
#include <exception>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

void remove_members(nlohmann::ordered_json& value, const std::vector<std::string>& keys) {
  if (value.is_object()) {
    for (const std::string& key : keys) value.erase(key);
  }
  if (!value.is_structured()) return;
  for (auto& child : value) remove_members(child, keys);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::cerr << "usage: json_without FILE KEY...\n";
    return 3;
  }
  std::ifstream file(argv[1]);
  if (!file) {
    std::cerr << argv[1] << ": cannot be read\n";
    return 3;
  }
  nlohmann::ordered_json value = nlohmann::ordered_json::parse(file);
  remove_members(value, {argv + 2, argv + argc});
  std::cout << value.dump(1) << "\n";
  return std::cout.flush() ? 0 : 4;
} catch (const std::exception& error) {
  std::cerr << argv[1] << ": " << error.what() << "\n";
  return 3;
}
