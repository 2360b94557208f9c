// How far a study is, from what its writers tell in their status files: as facts, as text, and as the page
// index.html of its folder.
#pragma once

#include "launchsafe/report/page_texts.hpp"
#include "launchsafe/store/store_status.hpp"
#include "launchsafe/study/scheduler.hpp"

#include <ctime>

namespace launchsafe::report {

/// What a writer tells of its progress: members of its status file.
Row progress_row(const study::Progress& progress);

/// The same as a line of a terminal of so many columns.
std::string progress_line(const study::Progress& progress, std::time_t now, std::size_t width);

/// The local time of day, such as "05:40"; with the day before it where that is another one than now's.
std::string clock_time(std::time_t time, std::time_t now);

/// When the local clock shows "06:00" next after `now`, s since the epoch; nothing for what is no time of
/// day.
std::optional<std::time_t> next_clock_time(const std::string& text, std::time_t now);

/// What the snapshots of a study, at least one, say at a time: its state, cases, times, what is stored,
/// failures by their reason, preliminary critical gaps, and a row for every writer. A writer that told
/// nothing for two minutes counts as one that was killed. `folder` is how it is called. Values that a damaged
/// file lacks are 0.
Row status_facts(const std::string& folder, const std::vector<store::StoreStatus>& snapshots,
                 std::time_t now);

/// Of these facts: for a terminal, and the page. `files`: names of reports that are there, to be linked.
std::string status_text(const Row& facts);
std::string status_page(Row facts, const std::vector<std::string>& files);

/// Whether it pays to look again: a writer is at work.
bool is_running(const Row& facts);

}  // namespace launchsafe::report
