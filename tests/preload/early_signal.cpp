// Loaded into brume by a test: a signal that arrives before main does, while shared libraries set themselves up.
#include <csignal>

namespace {
[[gnu::constructor]] void send() { std::raise(SIGINT); }
}  // namespace
