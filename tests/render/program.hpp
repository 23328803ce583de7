// The real program as a child process in a fresh folder: what it prints, how it ends, what it leaves behind.
#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace brume::test {

namespace fs = std::filesystem;

inline fs::path test_data() {
  const char* folder = std::getenv("BRUME_TEST_DATA");
  return folder ? folder : BRUME_SOURCE_DIR "/../shared/data";
}

struct Outcome {
  int exit_code;
  std::string out, err;
};

class Program : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/brume_test_XXXXXX";
    folder_ = mkdtemp(name);
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  // Runs `brume ARGUMENTS` in the folder; `environment`: "NAME=value NAME=value".
  Outcome run(const std::string& arguments, const std::string& environment = "",
              const std::string& guard = "timeout 120") const {
    const fs::path log = fs::path(folder_.string() + ".log");
    fs::create_directories(log);
    const std::string command = "cd " + folder_.string() + " && env " + environment + " " + guard +
                                " " BRUME_BINARY " " + arguments + " >" + (log / "out").string() + " 2>" +
                                (log / "err").string();
    const int status = std::system(command.c_str());
    Outcome result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(log / "out"), text(log / "err")};
    fs::remove_all(log);
    return result;
  }

  fs::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.insert(entry.path().filename().string());
    return names;
  }

  static std::string text(const fs::path& file) {
    std::ostringstream all;
    all << std::ifstream(file, std::ios::binary).rdbuf();
    return all.str();
  }

  // One line "brume: ...", with `cause` in it, the exit code, and no file that was not there before.
  void expect_refused(const std::string& arguments, int code, const std::string& cause,
                      const std::string& environment = "") const {
    const std::set<std::string> before = files();
    const Outcome r = run(arguments, environment);
    EXPECT_EQ(r.exit_code, code) << arguments << "\n" << r.err;
    EXPECT_EQ(r.err.rfind("brume: ", 0), 0u) << arguments << "\n" << r.err;
    EXPECT_EQ(r.err.find('\n'), r.err.size() - 1) << arguments << "\n" << r.err;
    EXPECT_NE(r.err.find(cause), std::string::npos) << arguments << "\n" << r.err;
    EXPECT_EQ(r.out, "") << arguments;
    EXPECT_EQ(files(), before) << arguments;
  }

  fs::path folder_;
};

}  // namespace brume::test
