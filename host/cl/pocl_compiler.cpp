// See pocl_compiler.hpp. PoCL has the library parsed by llvm::parseIRFile and finds functions in it by
// llvm::Module::getFunction; for a kernel it asks llvm::PassManagerBuilder for passes, twice into one list that it
// keeps. Clang asks llvm::PassBuilder for the front end's passes. A program that exports all four
// (cmake/exported_symbols.list) is asked before LLVM: here the file is opened lazily, a function is read when it is
// looked up, the list gets its passes the second time, and the front end's are few. The names are those of LLVM 15; a
// driver that is linked with another one never calls them.
#include "cl/pocl_compiler.hpp"

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
#define ADD_PASSES "_ZN4llvm18PassManagerBuilder25populateModulePassManagerERNS_6legacy15PassManagerBaseE"
#define READ_BODY "_ZN4llvm11GlobalValue11materializeEv"
#define FRONT_PASSES "_ZN4llvm11PassBuilder29buildPerModuleDefaultPipelineENS_17OptimizationLevelEb"
#define PARSE_PASSES                                                                                          \
  "_ZN4llvm11PassBuilder17parsePassPipelineERNS_11PassManagerINS_6ModuleENS_15AnalysisManagerIS2_JEEEJEEENS_" \
  "9StringRefE"

namespace brume {

namespace {

bool known_version = false;

// What the front end is left to do: functions get small before they are inlined. All else is done behind it.
constexpr std::string_view FRONT = "cgscc(inline,function(sroa,early-cse,simplifycfg))";

// Of LLVM's types, what decides how they are handed over.
struct StringRef {
  const char* data;
  std::size_t size;
};
struct FunctionRef {
  void* callback;
  std::intptr_t callable;
};
struct Level {
  unsigned speed, size;
};
// unique_ptr and Error (a word), a list of passes (a vector of pointers), in memory because they have destructors.
template <std::size_t Words>
struct ReturnedWords {
  ReturnedWords() = default;
  ReturnedWords(const ReturnedWords&) = delete;
  ReturnedWords(ReturnedWords&&) noexcept = default;  // where it lies does not matter
  ReturnedWords& operator=(const ReturnedWords&) = delete;
  ReturnedWords& operator=(ReturnedWords&&) = delete;
  ~ReturnedWords() {
  }  // NOLINT(modernize-use-equals-default): it must not be trivial, and leaves what it holds to the caller
  std::uintptr_t held[Words] = {};
};
using Returned = ReturnedWords<1>;
using PassList = ReturnedWords<3>;

// Null where it is unknown.
const char* calling_library(const void* caller) {
  Dl_info library{};
  return ::dladdr(caller, &library) != 0 ? library.dli_fname : nullptr;
}

bool is_pocl(const char* library) {
  return library != nullptr && std::string_view(library).find("libpocl") != std::string_view::npos;
}

// LLVM's own, in what the calling library is linked with: not the program itself, and each driver with its own version.
template <class Function>
Function* llvm_function(const char* name, const void* caller) {
  const char* const name_of_caller = calling_library(caller);
  void* const library = name_of_caller != nullptr ? ::dlopen(name_of_caller, RTLD_LAZY | RTLD_NOLOAD) : nullptr;
  return reinterpret_cast<Function*>(library != nullptr ? ::dlsym(library, name) : nullptr);
}

bool is_builtin_library(const StringRef& file) {
  return std::string_view(file.data, file.size).find("/share/pocl/kernel-") != std::string_view::npos;
}

// Without a failure an Error holds nothing, or a mark in its lowest bit.
bool failed(const Returned& error) { return (error.held[0] & ~std::uintptr_t(1)) != 0; }

}  // namespace

void pocl_compiler_choose(bool pocl_3_1) { known_version = pocl_3_1; }

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

void passes_add(void* builder, void* passes) __asm__(ADD_PASSES);
void passes_add(void* builder, void* passes) {
  static const void* waits = nullptr;  // the list that has been asked for once
  const void* const caller = __builtin_return_address(0);
  if (known_version && is_pocl(calling_library(caller))) {
    const bool again = waits == passes;
    waits = again ? nullptr : passes;
    if (!again) return;
  }
  if (const auto add = llvm_function<decltype(passes_add)>(ADD_PASSES, caller)) add(builder, passes);
}

PassList front_passes(void* builder, Level level, bool before_linking) __asm__(FRONT_PASSES);
PassList front_passes(void* builder, Level level, bool before_linking) {
  const void* const caller = __builtin_return_address(0);
  const auto parse = llvm_function<Returned(void*, void*, StringRef)>(PARSE_PASSES, caller);
  if (known_version && parse != nullptr) {
    PassList passes;
    if (!failed(parse(builder, &passes, {FRONT.data(), FRONT.size()}))) return passes;
  }
  return llvm_function<decltype(front_passes)>(FRONT_PASSES, caller)(builder, level, before_linking);
}
}

}  // namespace brume
