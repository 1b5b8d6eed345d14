// SPDX-License-Identifier: Apache-2.0
#include "certify/process/pipe.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace noli {

namespace {

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category(), "a pipe"); }

}  // namespace

Pipe::Pipe() {
  if (::pipe2(ends_.data(), O_CLOEXEC) != 0) fail();
}

Pipe::~Pipe() {
  close(0);
  close(1);
}

void Pipe::close(std::size_t i) {
  if (ends_[i] >= 0) ::close(ends_[i]);
  ends_[i] = -1;
}

void Pipe::never_wait(std::size_t i) const {
  if (::fcntl(ends_[i], F_SETFL, O_NONBLOCK) != 0) fail();
}

}  // namespace noli
