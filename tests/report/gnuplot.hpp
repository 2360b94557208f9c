// Whether pictures can be drawn here, and what stands in the commands for them.
#pragma once

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace launchsafe::report {

inline bool gnuplot_is_there() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

/// The lines of a data block in gnuplot's commands.
inline std::vector<std::string> block_of(const std::string& commands, const std::string& name) {
  const std::string begin = "$" + name + " << END_OF_DATA\n";
  const std::size_t at = commands.find(begin);
  if (at == std::string::npos) return {};
  std::istringstream text(commands.substr(
      at + begin.size(), commands.find("END_OF_DATA", at + begin.size()) - at - begin.size()));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

}  // namespace launchsafe::report
