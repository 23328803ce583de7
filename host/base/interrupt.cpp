// See interrupt.hpp. A signal handler may only touch a lock-free flag, post a semaphore, write and _exit.
#include "base/interrupt.hpp"

#include <semaphore.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "base/error.hpp"
#include "base/foreign_lines.hpp"

namespace brume {

namespace {

std::atomic<bool> installed{false}, requested{false}, claimed{false};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<double>::is_always_lock_free);
std::atomic<double> first_s{0};  // seconds of the monotonic clock
sem_t first_signal;
std::mutex access_to_plans;
std::function<void()> rescue_planned;
std::filesystem::path folder_removed;

double now() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

extern "C" void interrupt_handle(int) {
  if (!requested) {
    first_s = now();
    requested = true;
    message_write("\nbrume: stopping; once more ends at once\n");
    sem_post(&first_signal);
  } else if (now() - first_s > INTERRUPT_ECHO_S) {
    _exit(130);
  }
}

void watch() {
  while (sem_wait(&first_signal) != 0) continue;
  std::this_thread::sleep_for(std::chrono::duration<double>(INTERRUPT_GRACE_S));
  if (claimed.exchange(true)) return;
  {
    const std::lock_guard<std::mutex> lock(access_to_plans);
    if (rescue_planned) rescue_planned();
    std::error_code ignored;
    if (!folder_removed.empty()) std::filesystem::remove_all(folder_removed, ignored);
  }
  std::fflush(stdout);
  message_write("brume: interrupted\n");
  _exit(130);
}

}  // namespace

void interrupt_install() {
  sem_init(&first_signal, 0, 0);
  installed = true;
  interrupt_listen();
}

void interrupt_watch() { std::thread(watch).detach(); }

void interrupt_listen() {
  if (!installed) return;  // in a test
  std::signal(SIGINT, interrupt_handle);
  std::signal(SIGTERM, interrupt_handle);
}

bool interrupt_requested() { return requested; }

void interrupt_check() {
  if (requested) throw Interrupted("interrupted");
}

void interrupt_removes(const std::filesystem::path& folder) {
  const std::lock_guard<std::mutex> lock(access_to_plans);
  folder_removed = folder;
}

InterruptRescue::InterruptRescue(std::function<void()> rescue) {
  const std::lock_guard<std::mutex> lock(access_to_plans);
  rescue_planned = std::move(rescue);
}

InterruptRescue::~InterruptRescue() {
  const std::lock_guard<std::mutex> lock(access_to_plans);
  rescue_planned = nullptr;
}

void interrupt_claim() {
  static thread_local bool mine = false;
  while (!mine && claimed.exchange(true)) pause();
  mine = true;
}

void interrupt_leave(const char* message) {
  interrupt_claim();
  std::fflush(stdout);
  std::fprintf(stderr, "brume: %s\n", message);
  _exit(130);
}

}  // namespace brume
