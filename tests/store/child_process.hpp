// What a limited process sees, without limiting the test itself.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace launchsafe::testing {

/// Runs `body` in a child process; true when it returns true there.
template <class Body>
bool holds_in_child(Body body) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(body() ? 0 : 1);
  int status = 0;
  return child > 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// The same for a process that can write no file larger than `bytes`.
template <class Body>
bool holds_under_file_size_limit(rlim_t bytes, Body body) {
  return holds_in_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    return ::setrlimit(RLIMIT_FSIZE, &limit) == 0 && body();
  });
}

/// The same for a process that permissions bind, also when this one is root's.
template <class Body>
bool holds_without_privileges(Body body) {
  return holds_in_child([&] {
    constexpr uid_t nobody = 65534;
    return (::geteuid() != 0 || (::setgid(nobody) == 0 && ::setuid(nobody) == 0)) && body();
  });
}

}  // namespace launchsafe::testing
