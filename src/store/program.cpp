#include "launchsafe/store/file.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

namespace launchsafe::store {
namespace {

constexpr int not_found_code = 127, too_long_code = 124;  // of a shell, and of timeout

/// A folder for files of its own, gone afterwards.
struct OwnFolder {
  std::string path = (std::filesystem::temp_directory_path() / "launchsafe-XXXXXX").string();
  OwnFolder() {
    if (::mkdtemp(path.data()) == nullptr) throw Error{Error::Kind::failed, "cannot make the folder " + path};
  }
  ~OwnFolder() {
    std::error_code failed;
    std::filesystem::remove_all(path, failed);
  }
};

std::string in_quotes(std::string_view word) {
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? R"('\'')" : std::string(1, letter);
  return text + "'";
}

}  // namespace

Result<ProgramOutput> run_program(const std::string& program, const std::vector<std::string>& arguments,
                                  const std::string& input, const ProgramLimits& limits) try {
  if (limits.stop != nullptr && limits.stop->load())
    return Error{Error::Kind::failed, program + ": the program was asked to stop"};
  const OwnFolder folder;
  std::string command = fmt::format("timeout {} {}", limits.time, in_quotes(program));
  for (const std::string& argument : arguments) command += " " + in_quotes(argument);
  command += fmt::format(" > {0}/output 2> {0}/errors", folder.path);
  std::FILE* pipe = ::popen(command.c_str(), "we");
  if (pipe == nullptr) return Error{Error::Kind::failed, "cannot start " + program};
  std::fwrite(input.data(), 1, input.size(), pipe);
  const int status = ::pclose(pipe), code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == not_found_code)
    return Error{Error::Kind::missing, fmt::format("cannot start {}: there is no such program", program)};
  if (code == too_long_code)
    return Error{Error::Kind::failed,
                 fmt::format("{}: it was not done after {:.3g} s and was ended", program, limits.time)};
  return ProgramOutput{read_file(folder.path + "/output"), read_file(folder.path + "/errors"), code == 0};
} catch (const Error& error) {
  return error;
}

}  // namespace launchsafe::store
