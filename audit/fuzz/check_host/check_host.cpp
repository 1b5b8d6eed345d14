// SPDX-License-Identifier: Apache-2.0
//
// noli_check_host FOLDER: the checker of proofs (proofs/checker/main.cpp, included whole) in a process that checks one
// proof after another, for `noli fuzz proofs` and tests/proofs/run_mutants.py. Standard input is a sequence of
//
//   F  name data                writes the file FOLDER/name
//   R  count name...            runs the checker in this process with these arguments, files in FOLDER
//   W  count name...            the same, and tells what it printed
//
// Names are a byte of length and the bytes; data are a u32 of length, little-endian, and the bytes; a count is a byte.
// R and W are answered on standard output with one byte, the exit code, and W then with data, at most 65,535 bytes of
// what the checker printed.
//
// What this does not do: it judges no answer, and does not survive a crash of the checker in R; whoever reads its
// answers sees from their number which proof it was.
#define main noli_check_main
#include "proofs/checker/main.cpp"  // NOLINT(bugprone-suspicious-include)
#undef main

#include <sys/mman.h>
#include <unistd.h>

namespace {

[[noreturn]] void stop(const char* why) {
  std::fprintf(stderr, "noli_check_host: %s\n", why);
  std::exit(4);
}

std::string read_bytes(std::size_t size) {
  std::string bytes(size, '\0');
  if (size != 0 && std::fread(bytes.data(), 1, size, stdin) != size) stop("the input ends early");
  return bytes;
}

std::size_t read_byte() { return static_cast<unsigned char>(read_bytes(1)[0]); }

std::string read_name() { return read_bytes(read_byte()); }

void write_file() {
  const std::string name = read_name(), size = read_bytes(4);
  std::uint32_t length;
  std::memcpy(&length, size.data(), 4);
  const std::string data = read_bytes(length);
  std::FILE* file = std::fopen(name.c_str(), "wb");
  if (file == nullptr || std::fwrite(data.data(), 1, data.size(), file) != data.size() || std::fclose(file) != 0)
    stop("a file cannot be written");
}

/// Where the checker's standard output goes, which is this process's own.
class Words {
 public:
  Words() : file_(memfd_create("words", 0)) {
    if (file_ < 0 || dup2(file_, STDOUT_FILENO) < 0) stop("standard output cannot be moved");
  }

  /// What was printed since the last time.
  std::string take() const {
    std::fflush(stdout);
    std::string words(65535, '\0');
    const ssize_t size = pread(file_, words.data(), words.size(), 0);
    if (size < 0 || ftruncate(file_, 0) != 0 || lseek(file_, 0, SEEK_SET) != 0) stop("its words cannot be read");
    words.resize(static_cast<std::size_t>(size));
    return words;
  }

 private:
  int file_;
};

void answer(int to, const std::string& bytes) {
  if (write(to, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) stop("nobody reads the answers");
}

std::string data_record(const std::string& bytes) {
  const auto length = static_cast<std::uint32_t>(bytes.size());
  std::string record(4, '\0');
  std::memcpy(record.data(), &length, 4);
  return record + bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || chdir(argv[1]) != 0) stop("expected a folder");
  const int answers = dup(1);
  if (answers < 0) stop("standard output cannot be moved");
  const Words words_of_checker;
  for (int kind; (kind = std::getchar()) != EOF;) {
    if (kind == 'F') {
      write_file();
      continue;
    }
    if (kind != 'R' && kind != 'W') stop("an unknown record");
    std::vector<std::string> words = {"noli_check"};
    for (std::size_t count = read_byte(); count > 0; --count) words.push_back(read_name());
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int code = noli_check_main(static_cast<int>(words.size()), arguments.data());
    const std::string said = words_of_checker.take();
    answer(answers, std::string(1, static_cast<char>(code)) + (kind == 'W' ? data_record(said) : ""));
  }
  return 0;
}
