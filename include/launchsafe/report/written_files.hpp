// What a report left in its folder.
#pragma once

#include <string>
#include <vector>

namespace launchsafe::report {

struct WrittenFiles {
  std::vector<std::string> files;    ///< names in the folder, in the order written
  std::vector<std::string> remarks;  ///< what could not be made and why, such as a missing gnuplot
  int pictures_missing = 0;          ///< because they could not be drawn: another time they may be
};

}  // namespace launchsafe::report
