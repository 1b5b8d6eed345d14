// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/trajectory_pipe.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "certify/process/child.h"

namespace noli {
namespace {

constexpr int poll_milliseconds = 100;
constexpr std::chrono::minutes time_to_open{1};

}  // namespace

class TrajectoryPipe::End : public Sink {
 public:
  explicit End(TrajectoryPipe& pipe) : pipe_(pipe) {}
  void write(std::string_view bytes) override { pipe_.put(bytes); }
  void sync() override {}
  void truncate(std::uint64_t /*size*/) override {
    throw std::logic_error("what went to a checker cannot be taken back");
  }

 private:
  TrajectoryPipe& pipe_;
};

TrajectoryPipe::TrajectoryPipe(const StopOfWork& stop) : stop_(stop), path_(folder_.path() / "trajectory.blocks") {
  if (::mkfifo(path_.c_str(), S_IRUSR | S_IWUSR) != 0) {
    throw std::system_error(errno, std::generic_category(), path_.string());
  }
  thread_ = std::thread([this] { work(); });
}

TrajectoryPipe::~TrajectoryPipe() {
  abandon();
  thread_.join();
}

void TrajectoryPipe::abandon() {
  {
    const std::lock_guard lock(mutex_);
    abandoned_ = true;
  }
  changed_.notify_all();
}

std::unique_ptr<Sink> TrajectoryPipe::sink() { return std::make_unique<End>(*this); }

void TrajectoryPipe::put(std::string_view bytes) {
  {
    const std::lock_guard lock(mutex_);
    if (over_) return;
    waiting_.emplace_back(bytes);
  }
  changed_.notify_all();
}

void TrajectoryPipe::drained() {
  std::unique_lock lock(mutex_);
  if (!awaited_since_) awaited_since_ = std::chrono::steady_clock::now();
  changed_.wait(lock, [this] { return waiting_.empty() || over_; });
  if (unopened_) {
    throw std::runtime_error("the checker does not read the motion; expected it to open " + path_.string());
  }
}

void TrajectoryPipe::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  drained();
}

bool TrajectoryPipe::is_over() const {
  const std::lock_guard lock(mutex_);
  return over_;
}

bool TrajectoryPipe::given_up() const {
  const std::lock_guard lock(mutex_);
  return abandoned_ || stop_.is_asked();
}

/// Whether somebody has waited too long for the checker to read. Before anybody waits it may not have been started.
bool TrajectoryPipe::waited_too_long() const {
  const std::lock_guard lock(mutex_);
  return awaited_since_ && std::chrono::steady_clock::now() >= *awaited_since_ + time_to_open;
}

/// Waits for the checker to open its end; until then ours cannot be opened.
std::optional<int> TrajectoryPipe::open() const {
  while (!given_up() && !waited_too_long()) {
    const int end = ::open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (end >= 0) return end;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return std::nullopt;
}

/// False when nobody reads it any more.
bool TrajectoryPipe::write(int end, std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = write_to_pipe(end, bytes);
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    if (written >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN) return false;
    pollfd one{end, POLLOUT, 0};
    ::poll(&one, 1, poll_milliseconds);
    if (given_up()) return false;
  }
  return true;
}

void TrajectoryPipe::work() {
  const std::optional<int> end = open();
  std::unique_lock lock(mutex_);
  while (end && !abandoned_) {
    changed_.wait(lock, [this] { return !waiting_.empty() || closing_ || abandoned_; });
    if (waiting_.empty()) break;
    const std::string& bytes = waiting_.front();  // put() does not move it
    lock.unlock();
    const bool taken = write(*end, bytes);
    lock.lock();
    if (!taken) break;
    waiting_.pop_front();
    if (waiting_.empty()) changed_.notify_all();
  }
  over_ = true;
  unopened_ = !end && !abandoned_ && !stop_.is_asked();
  waiting_.clear();
  lock.unlock();
  if (end) ::close(*end);
  changed_.notify_all();
}

}  // namespace noli
