// brume: scene file → picture. Parses the command line, runs one command, turns failures into one line and an exit
// code:
// 0 done, 1 device, memory or I/O failure, 2 bad input or usage, 130 interrupted.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/streams.hpp"
#include "base/text_printable.hpp"
#include "cli/command.hpp"
#include "version.hpp"

namespace {

int fail(const char* message, int code) {
  std::fprintf(stderr, "brume: %s\n", message);
  return code;
}

// On one line, whatever names and values it quotes.
int fail_input(const std::string& message) { return fail(brume::text_printable(message).c_str(), 2); }

// Everything is written: nothing is gained by the destructors of the driver's compiler. The leak checker wants them.
int leave(int code) {
#ifndef __SANITIZE_ADDRESS__
  ::_exit(code);
#endif
  return code;
}

int run(int argc, char** argv) {
  CLI::App app{"Renders smoke, fog, clouds and the surfaces around them on any OpenCL device."};
  app.set_version_flag("--version", std::string("brume ") + brume::VERSION);
  app.require_subcommand(1);
  brume::Command command;
  brume::command_render(app, command);
  brume::command_chart(app, command, {brume::chart_peers_check, brume::chart_peers});
  brume::command_check(app, command);
  brume::command_devices(app, command);
  brume::command_info(app, command);
  brume::command_compare(app, command);
  brume::command_merge(app, command);
  brume::command_bench(app, command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    if (argc < 2 || argv[1][0] == '-' || !app.get_subcommands().empty())
      return fail_input(std::string(error.what()) + " (see brume --help)");
    std::string known;
    for (const CLI::App* one : app.get_subcommands([](CLI::App*) { return true; }))
      known += (known.empty() ? "" : ", ") + one->get_name();
    return fail_input("unknown command '" + std::string(argv[1]) + "'; known: " + known);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return fail_input(std::string(error.what()) + " (see brume --help)");
  }
  return command();
}

// Before the shared libraries set themselves up, which takes longer than the rest of the way to main: they find all
// three streams open, and a signal in that time is not lost.
void early(int, char**, char**) {
  brume::streams_open();
  brume::interrupt_install();
}
[[gnu::section(".preinit_array"), gnu::used]] void (*const early_entry)(int, char**, char**) = early;

}  // namespace

int main(int argc, char** argv) {
  if (brume::interrupt_requested()) return fail("interrupted; nothing was begun", 130);
  brume::interrupt_watch();
  try {
    const int code = run(argc, argv);
    brume::stdout_flush();
    if (brume::interrupt_requested()) brume::interrupt_leave("interrupted when all was done");
    return leave(code);
  } catch (const brume::InputError& error) {
    return fail_input(error.what());
  } catch (const brume::Interrupted& error) {
    brume::interrupt_leave(error.what());
  } catch (const std::bad_alloc&) {
    return fail("out of memory", 1);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
