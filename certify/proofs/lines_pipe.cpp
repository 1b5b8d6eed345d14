// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/lines_pipe.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "trajectory/stop.h"

namespace noli {
namespace {

constexpr int poll_milliseconds = 100;
constexpr std::chrono::minutes time_to_open{1};

}  // namespace

class LinesPipe::End : public Sink {
 public:
  explicit End(LinesPipe& pipe) : pipe_(pipe) {}
  void write(std::string_view bytes) override { pipe_.put(bytes); }
  void sync() override {}
  void truncate(std::uint64_t /*size*/) override {
    throw std::logic_error("what went to a checker cannot be taken back");
  }

 private:
  LinesPipe& pipe_;
};

LinesPipe::LinesPipe(std::optional<std::chrono::steady_clock::time_point> deadline)
    : deadline_(deadline), path_(folder_.path() / "trajectory.blocks") {
  if (::mkfifo(path_.c_str(), S_IRUSR | S_IWUSR) != 0) {
    throw std::system_error(errno, std::generic_category(), path_.string());
  }
  thread_ = std::thread([this] { work(); });
}

LinesPipe::~LinesPipe() {
  {
    const std::lock_guard lock(mutex_);
    abandoned_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::unique_ptr<Sink> LinesPipe::sink() { return std::make_unique<End>(*this); }

void LinesPipe::put(std::string_view bytes) {
  {
    const std::lock_guard lock(mutex_);
    if (over_) return;
    waiting_.emplace_back(bytes);
  }
  changed_.notify_all();
}

void LinesPipe::drained() {
  std::unique_lock lock(mutex_);
  if (!awaited_since_) awaited_since_ = std::chrono::steady_clock::now();
  changed_.wait(lock, [this] { return waiting_.empty() || over_; });
  if (unopened_) {
    throw std::runtime_error("the checker does not read the world lines; expected it to open " + path_.string());
  }
}

void LinesPipe::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  drained();
}

bool LinesPipe::given_up() const {
  const std::lock_guard lock(mutex_);
  return abandoned_ || is_stopped();
}

bool LinesPipe::is_stopped() const {
  return stop_asked() || (deadline_ && std::chrono::steady_clock::now() >= *deadline_);
}

/// Whether drained() has waited too long for the checker to read. Before that the checker may not have been started.
bool LinesPipe::waited_too_long() const {
  const std::lock_guard lock(mutex_);
  return awaited_since_ && std::chrono::steady_clock::now() >= *awaited_since_ + time_to_open;
}

/// Waits for the checker to open its end; our end cannot be opened before.
std::optional<int> LinesPipe::open() const {
  while (!given_up() && !waited_too_long()) {
    const int end = ::open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (end >= 0) return end;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return std::nullopt;
}

/// False if there is no reader any more.
bool LinesPipe::write(int end, std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = ::write(end, bytes.data(), bytes.size());
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    if (written >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN) return false;
    pollfd one{end, POLLOUT, 0};
    ::poll(&one, 1, poll_milliseconds);
    if (given_up()) return false;
  }
  return true;
}

void LinesPipe::work() {
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
  unopened_ = !end && !abandoned_ && !is_stopped();
  waiting_.clear();
  lock.unlock();
  if (end) ::close(*end);
  changed_.notify_all();
}

}  // namespace noli
