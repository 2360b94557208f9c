// launchsafe plot: pictures of one case, or their numbers.
#include "common_options.hpp"
#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::app {
namespace {

struct PlotArguments {
  path file;                         ///< of a case
  std::optional<path> output;        ///< folder; none: CASE_pictures beside the file
  std::vector<std::string> what;     ///< words of kinds of pictures; none: all with data
  std::optional<std::string> times;  ///< with units, of fields and profiles
  bool tables = false;               ///< CSV files of numbers instead
};

using report::Picture;
using report::PictureKind;

/// The kinds that a user named, which must have data, or all with data where none is named.
std::vector<const PictureKind*> selected(const report::DrawnCase& drawn, const PlotArguments& arguments) {
  std::vector<const PictureKind*> kinds;
  for (const PictureKind& kind : report::picture_kinds()) {
    const bool is_named = std::ranges::find(arguments.what, kind.word) != arguments.what.end();
    if (!is_named && !arguments.what.empty()) continue;
    const bool lacks_tables = arguments.tables && !kind.tables;
    const std::string why = lacks_tables ? "there are pictures of it alone" : kind.lacks(drawn);
    if (why.empty())
      kinds.push_back(&kind);
    else if (is_named)
      throw scene::error_at({}, "--what", fmt::format("\"{}\", without data: {}", kind.word, why),
                            "what the case has data for; all of that without --what");
  }
  return kinds;
}

/// The times that a user named: of fields those of snapshots, of profiles any until the end of the run.
std::vector<double> wanted_times(const report::DrawnCase& drawn, bool of_fields, const std::string& text) {
  const std::vector<double> times = scene::parse_list(text, scene::Dimension::time);
  const auto snapshots = report::shown_snapshots(drawn);
  std::vector<std::string> known;
  for (const auto& each : snapshots) known.push_back(scene::time_text(each.time()));
  const double end = drawn.result.mechanics.end_time;
  for (const double time : times) {
    const bool is_known =
        of_fields
            ? std::ranges::any_of(snapshots, [&](const auto& each) { return report::is_of_time(each, time); })
            : time >= 0.0 && time <= end * (1.0 + 1e-9);
    if (!is_known)
      throw scene::error_at({}, "--times", scene::time_text(time),
                            of_fields ? fmt::format("snapshots at {}", fmt::join(known, ", "))
                                      : "times until the end of the run at " + scene::time_text(end));
  }
  return times;
}

/// Throws what kept a picture from being drawn.
std::string drawn_picture(const Picture& picture) {
  auto svg = report::to_svg(picture.drawing, {.stop = &stop_requested});
  if (svg) return std::move(*svg);
  if (stop_requested) throw Ended{"interrupted while drawing; nothing was written", ExitCode::interrupted};
  if (svg.error().kind != store::Error::Kind::missing) throw Ended{svg.error().message, ExitCode::failed};
  throw Ended{"plot: found no program gnuplot, which draws the pictures (Debian: gnuplot-nox)"};
}

ExitCode perform(const PlotArguments& arguments, Console& console) {
  const store::StoredCase stored = store::read_case_file(arguments.file);
  const scene::SceneFile file = scene::parse_scene(stored.manifest.input_text, arguments.file);
  report::DrawnCase drawn{file.scene, stored.result};
  const std::vector<const PictureKind*> kinds = selected(drawn, arguments);
  const bool of_fields = std::ranges::find(kinds, "fields", &PictureKind::word) != kinds.end();
  if (arguments.times) drawn.times = wanted_times(drawn, of_fields, *arguments.times);
  const path folder = arguments.output.value_or(arguments.file.parent_path() /
                                                (arguments.file.stem().string() + "_pictures"));
  Progress progress(console.quiet());
  NamedTexts texts;
  Json list = Json::array();
  const auto add = [&](const PictureKind& kind, const std::string& name, std::string text) {
    texts.push_back({name, std::move(text)});
    list.push_back({{"what", kind.word}, {"file", (folder / name).string()}});
  };
  for (const PictureKind* kind : kinds) {
    if (arguments.tables) {
      for (const report::ReportTable& each : kind->tables(drawn)) add(*kind, each.csv, to_csv(each.table));
      continue;
    }
    for (const Picture& picture : kind->pictures(drawn)) {
      progress.show("drawing " + picture.file);
      add(*kind, picture.file, drawn_picture(picture));
      if (picture.time) list.back()["time_ms"] = 1e3 * *picture.time;
      if (picture.gap) list.back()["gap_cm"] = scene::in_unit(*picture.gap, scene::Dimension::length, "cm");
    }
  }
  const std::vector<std::string> places = write_where_absent(folder, texts);
  return console.done(fmt::format("{}\n", fmt::join(places, "\n")),
                      {{"folder", folder.string()}, {arguments.tables ? "tables" : "pictures", list}});
}

}  // namespace

void add_plot(CLI::App& app, CommandLine& line) {
  const auto words =
      study::of_each(report::picture_kinds(), [](const PictureKind& kind) { return std::string(kind.word); });
  auto [command, plot] = add_command<PlotArguments>(
      app, line, "plot", "Draw a case: histories, profiles, and fields over the section");
  add(command, "case", plot.file, "CASE.h5", "Case file")->required();
  add(command, "-o,--output", plot.output, "DIR",
      "Folder for the pictures; CASE_pictures beside the file unless given");
  add(command, "--what", plot.what, "KINDS",
      "One or several, with commas between; all that the case has data for unless given")
      ->delimiter(',')
      ->check(CLI::IsMember(words));
  add(command, "--times", plot.times, "LIST",
      "Times of fields, which must be snapshots, and of profiles, such as \"8, 10 ms\"");
  command.add_flag("--csv", plot.tables, "Their numbers instead of pictures: pressure, fields and histories");
}

}  // namespace launchsafe::app
