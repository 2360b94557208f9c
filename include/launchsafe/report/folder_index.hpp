// One page that leads to all reports of a folder.
#pragma once

#include <filesystem>
#include <string>

namespace launchsafe::report {

/// How a page of `index_page` begins, by which it is known.
inline constexpr const char* index_begin = "<!DOCTYPE html>\n<!-- launchsafe report --index 1 -->\n";

/// An entry for every folder within `folder` that holds a page or a picture: title and answer as its
/// study.json or report.json has them, or else the heading of its page, with links to its pages and pictures.
/// Folders further down are links in the entry of the folder that they are in. Empty where there is no
/// report.
std::string index_page(const std::filesystem::path& folder);

}  // namespace launchsafe::report
