// See builtin_library.hpp. PoCL has the library parsed by llvm::parseIRFile and finds functions in it by
// llvm::Module::getFunction. A program that exports both (cmake/exported_symbols.list) is asked before LLVM: here the
// file is opened lazily, and a function is read when it is looked up. The names are those of LLVM 15; a driver that is
// linked with another one never calls them.
#include "cl/builtin_library.hpp"

#include <dlfcn.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#define PARSE_FILE                                                                                                     \
  "_ZN4llvm11parseIRFileENS_9StringRefERNS_12SMDiagnosticERNS_11LLVMContextENS_12function_refIFNS_8OptionalINSt7__cxx" \
  "1112basic_stringIcSt11char_traitsIcESaIcEEEEES0_EEE"
#define OPEN_LAZILY "_ZN4llvm19getLazyIRFileModuleENS_9StringRefERNS_12SMDiagnosticERNS_11LLVMContextEb"
#define GET_FUNCTION "_ZNK4llvm6Module11getFunctionENS_9StringRefE"
#define READ_BODY "_ZN4llvm11GlobalValue11materializeEv"

namespace brume {

namespace {

bool known_version = false;

// Of LLVM's types, what decides how they are handed over.
struct StringRef {
  const char* data;
  std::size_t size;
};
struct FunctionRef {
  void* callback;
  std::intptr_t callable;
};
// unique_ptr and Error, in memory because they have destructors.
struct Returned {
  Returned() = default;
  Returned(const Returned&) = delete;
  Returned& operator=(const Returned&) = delete;
  ~Returned() {
  }  // NOLINT(modernize-use-equals-default): it must not be trivial, and leaves what it holds to the caller
  std::uintptr_t held = 0;
};

// LLVM's own, in what the calling library is linked with: not the program itself, and each driver with its own version.
template <class Function>
Function* llvm_function(const char* name, const void* caller) {
  Dl_info driver{};
  if (::dladdr(caller, &driver) == 0) return nullptr;
  void* const library = ::dlopen(driver.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
  return reinterpret_cast<Function*>(library != nullptr ? ::dlsym(library, name) : nullptr);
}

bool is_builtin_library(const StringRef& file) {
  return std::string_view(file.data, file.size).find("/share/pocl/kernel-") != std::string_view::npos;
}

// Without a failure an Error holds nothing, or a mark in its lowest bit.
bool failed(const Returned& error) { return (error.held & ~std::uintptr_t(1)) != 0; }

}  // namespace

void builtin_library_choose(const std::string& platform_version) {
  known_version = platform_version.find("PoCL 3.1") != std::string::npos;
}

extern "C" {

Returned builtin_parse_file(StringRef file, void* diagnostic, void* context, FunctionRef layout) __asm__(PARSE_FILE);
Returned builtin_parse_file(StringRef file, void* diagnostic, void* context, FunctionRef layout) {
  const void* const caller = __builtin_return_address(0);
  const auto parse = llvm_function<decltype(builtin_parse_file)>(PARSE_FILE, caller);
  const auto open = llvm_function<Returned(StringRef, void*, void*, bool)>(OPEN_LAZILY, caller);
  if (known_version && open != nullptr && is_builtin_library(file)) return open(file, diagnostic, context, false);
  return parse(file, diagnostic, context, layout);
}

void* builtin_get_function(const void* module, StringRef name) __asm__(GET_FUNCTION);
void* builtin_get_function(const void* module, StringRef name) {
  const void* const caller = __builtin_return_address(0);
  const auto get = llvm_function<decltype(builtin_get_function)>(GET_FUNCTION, caller);
  void* const function = get(module, name);
  if (!known_version || function == nullptr) return function;
  const auto read = llvm_function<Returned(void*)>(READ_BODY, caller);
  if (read != nullptr && failed(read(function))) std::abort();
  return function;
}
}

}  // namespace brume
