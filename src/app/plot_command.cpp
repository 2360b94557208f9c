// launchsafe plot: pictures of one case, or their numbers.
#include "common_options.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/report/case_pictures.hpp"
#include "launchsafe/scene/toml_reader.hpp"
#include "launchsafe/store/case_file.hpp"
#include "output_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

namespace launchsafe::app {
namespace {

struct PlotArguments {
  std::filesystem::path file;                       ///< of a case
  std::optional<std::filesystem::path> output;      ///< folder; none: CASE_pictures beside the file
  std::optional<std::string> what;                  ///< words of kinds of pictures; none: all with data
  std::optional<std::string> times;                 ///< with units, of fields and profiles
  std::optional<std::filesystem::path> references;  ///< file of published rows, of histories and profiles
  bool tables = false;                              ///< CSV files of numbers instead
};

using report::CasePicture;
using report::PictureKind;

/// The words of a list between commas or blanks.
std::vector<std::string> words_of(std::string list) {
  std::ranges::replace(list, ',', ' ');
  std::istringstream words(list);
  return {std::istream_iterator<std::string>(words), {}};
}

/// What a command draws, and why it leaves out the rest.
struct Selection {
  std::vector<const PictureKind*> kinds;
  std::vector<std::pair<const PictureKind*, std::string>> left_out;

  bool has(std::string_view word) const {
    return std::ranges::any_of(kinds, [&](const PictureKind* kind) { return kind->word == word; });
  }
};

/// The words of kinds that a user named, each of which must be one.
scene::Expected<std::vector<std::string>> named_kinds(const std::string& list) {
  std::vector<std::string> known;
  for (const PictureKind& kind : report::picture_kinds()) known.emplace_back(kind.word);
  const auto fault = [&](const std::string& found) {
    return scene::error_at({}, "--what", fmt::format("\"{}\"", found), scene::quoted_list(known),
                           scene::nearest_of(found, known));
  };
  std::vector<std::string> words = words_of(list);
  if (words.empty()) return fault(list);
  for (const std::string& word : words)
    if (std::ranges::find(known, word) == known.end()) return fault(word);
  return words;
}

/// Of these kinds, or of all where none is named, what the case has data for. A kind that is named must have
/// some.
scene::Expected<Selection> select(const report::DrawnCase& drawn, const std::vector<std::string>& named,
                                  bool as_tables) {
  Selection selection;
  for (const PictureKind& kind : report::picture_kinds()) {
    if (!named.empty() && std::ranges::find(named, kind.word) == named.end()) continue;
    const bool lacks_tables = as_tables && !kind.tables;
    const std::string why = lacks_tables ? "there are pictures of it alone" : kind.lacks(drawn);
    if (why.empty()) {
      selection.kinds.push_back(&kind);
    } else if (named.empty()) {
      selection.left_out.emplace_back(&kind, why);
    } else {
      return scene::error_at({}, "--what",
                             fmt::format("\"{}\", which {} has no data for: {}", kind.word,
                                         lacks_tables ? "--csv" : "this case", why),
                             "what the case has data for; all of that without --what");
    }
  }
  return selection;
}

std::optional<scene::InputError> fault_in_time(const report::DrawnCase& drawn, const Selection& selection,
                                               double time) {
  const std::string found = scene::time_text(time);
  if (selection.has("fields")) {
    const auto snapshots = report::shown_snapshots(drawn);
    const bool known =
        std::ranges::any_of(snapshots, [&](const auto& each) { return report::is_of_time(each, time); });
    if (known) return std::nullopt;
    std::vector<std::string> times;
    for (const auto& each : snapshots) times.push_back(scene::time_text(each.time()));
    return scene::error_at({}, "--times", found + ", of which the case has no snapshot",
                           fmt::format("{}; any time with --what profile", fmt::join(times, ", ")));
  }
  const double end = drawn.result.mechanics.end_time;
  if (time >= 0.0 && time <= end * (1.0 + 1e-9)) return std::nullopt;
  return scene::error_at({}, "--times", found, "times until the end of the run at " + scene::time_text(end));
}

/// The times that a user named, each of which must be one that can be drawn.
scene::Expected<std::vector<double>> wanted_times(const report::DrawnCase& drawn, const Selection& selection,
                                                  const std::string& text) {
  const auto times = scene::parse_list(text, scene::Dimension::time);
  if (!times)
    return scene::error_at({}, "--times", times.error().found, times.error().allowed,
                           times.error().suggestion);
  if (!selection.has("fields") && !selection.has("profile"))
    return scene::error_at({}, "--times", text, "times where fields or profile are drawn");
  for (const double time : *times)
    if (auto fault = fault_in_time(drawn, selection, time)) return *fault;
  return *times;
}

/// A picture, or its numbers, as it will be written.
struct DrawnFile {
  std::string what;  ///< the word of its kind
  std::string name, text;
  std::optional<double> time = {}, gap = {};  ///< s and m, of a picture
};

std::vector<DrawnFile> tabulate(const report::DrawnCase& drawn, const Selection& selection) {
  std::vector<DrawnFile> files;
  for (const PictureKind* kind : selection.kinds)
    for (const report::CaseTable& each : kind->tables(drawn))
      files.push_back({kind->word, each.file, report::to_csv(each.table)});
  return files;
}

store::Result<std::vector<DrawnFile>> draw(const report::DrawnCase& drawn, const Selection& selection,
                                           const Console& console) {
  Progress progress(console.quiet());
  std::vector<DrawnFile> pictures;
  for (const PictureKind* kind : selection.kinds) {
    for (const CasePicture& picture : kind->pictures(drawn)) {
      progress.show("drawing " + picture.file);
      auto svg = report::to_svg(picture.plot, {.stop = &stop_requested()});
      if (!svg) return svg.error();
      pictures.push_back({kind->word, picture.file, std::move(*svg), picture.time, picture.gap});
    }
  }
  return pictures;
}

Json written_json(const std::vector<DrawnFile>& files, const std::filesystem::path& folder,
                  const Selection& selection, const char* list) {
  Json object{{"folder", folder.string()}, {list, Json::array()}, {"left_out", Json::array()}};
  for (const DrawnFile& each : files) {
    Json entry{{"what", each.what}, {"file", (folder / each.name).string()}};
    if (each.time) entry["time_ms"] = 1e3 * *each.time;
    if (each.gap) entry["gap_cm"] = scene::in_unit(*each.gap, scene::Dimension::length, "cm");
    object[list].push_back(std::move(entry));
  }
  for (const auto& [kind, why] : selection.left_out)
    object["left_out"].push_back({{"what", kind->word}, {"because", why}});
  return object;
}

/// What kept a picture from being drawn.
ExitCode end_of_drawing(const store::Error& error, Console& console) {
  if (stop_requested()) {
    console.error("interrupted while drawing; nothing was written");
    return ExitCode::interrupted;
  }
  if (error.kind != store::Error::Kind::missing) return console.fail(error.message);
  return console.refuse(
      "plot: found no program gnuplot (Debian: gnuplot-nox), which draws the pictures; allowed: with it "
      "installed");
}

ExitCode perform(const PlotArguments& arguments, Console& console) {
  const auto file = store::read_case_with_scene(arguments.file);
  if (!file)
    return console.refuse(file.error().message +
                          "; allowed: a case file, such as launchsafe run SCENE.toml -o DIR writes");
  report::DrawnCase drawn{file->scene, file->stored.result};
  if (arguments.references) drawn.published = console.value_of(kinds::read_references(*arguments.references));
  const bool tables = arguments.tables;
  std::vector<std::string> named;
  if (arguments.what) named = console.value_of(named_kinds(*arguments.what));
  const Selection selection = console.value_of(select(drawn, named, tables));
  if (arguments.times) drawn.times = console.value_of(wanted_times(drawn, selection, *arguments.times));
  const auto files = tables ? tabulate(drawn, selection) : draw(drawn, selection, console);
  if (!files) return end_of_drawing(files.error(), console);
  const std::filesystem::path folder = arguments.output.value_or(
      arguments.file.parent_path() / (arguments.file.stem().string() + "_pictures"));
  NamedTexts texts;
  for (const DrawnFile& each : *files) texts.push_back({each.name, each.text});
  write_where_absent(folder, texts, console);
  for (const auto& [kind, why] : selection.left_out)
    console.remark(fmt::format("no {} of {}: {}", tables ? "table" : "picture", kind->word, why));
  if (!texts.empty()) console.print_text(fmt::format("{}\n", fmt::join(places_of(folder, texts), "\n")));
  console.print_json(written_json(*files, folder, selection, tables ? "tables" : "pictures"));
  return ExitCode::done;
}

}  // namespace

void add_plot(CLI::App& app, CommandLine& line) {
  auto [command, plot] = add_command<PlotArguments>(
      app, line, "plot", "Draw a case: histories, profiles, and fields over the section");
  add_required(command, "case", plot.file, "CASE.h5", "Case file");
  add_folder(command, plot.output, "Folder for the pictures; CASE_pictures beside the file unless given");
  std::vector<const char*> kinds;
  for (const report::PictureKind& kind : report::picture_kinds()) kinds.push_back(kind.word);
  command
      .add_option("--what", plot.what,
                  "One or several, with commas between; all that the case has data for unless given")
      ->type_name(fmt::format("{}", fmt::join(kinds, "|")));
  add_optional(command, "--times", plot.times, "LIST",
               "Times of fields, which must be snapshots, and of profiles, such as \"8, 10 ms\"");
  add_optional(command, "--references", plot.references, "FILE",
               "What was published of this launch, [[reference]], beside histories and profiles");
  command.add_flag("--csv", plot.tables,
                   "Their numbers instead of pictures: pressure, fields and histories, as CSV files");
}

}  // namespace launchsafe::app
