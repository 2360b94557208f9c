// launchsafe plot: pictures of one case, or their numbers.
#include "common_options.hpp"
#include "launchsafe/report/case_tables.hpp"

#include <boost/algorithm/string.hpp>

namespace launchsafe::app {
namespace {

struct PlotArguments {
  path file;                         ///< of a case
  std::optional<path> output;        ///< folder; none: CASE_pictures beside the file
  std::optional<std::string> what;   ///< words of kinds of pictures; none: all with data
  std::optional<std::string> times;  ///< with units, of fields and profiles
  bool tables = false;               ///< CSV files of numbers instead
};

using report::CasePicture;
using report::PictureKind;

/// What a command draws, and why it leaves out the rest.
struct Selection {
  std::vector<const PictureKind*> kinds;
  std::vector<std::pair<const PictureKind*, std::string>> left_out;

  bool has(std::string_view word) const {
    return std::ranges::any_of(kinds, [&](const PictureKind* kind) { return kind->word == word; });
  }
};

std::vector<std::string> words_of_kinds() {
  return study::of_each(report::picture_kinds(),
                        [](const PictureKind& kind) { return std::string(kind.word); });
}

/// The words of kinds that a user named, between commas or blanks; each must be one.
std::set<std::string> named_kinds(const std::string& list, Console& console) {
  const std::vector<std::string> known = words_of_kinds();
  std::set<std::string> words;
  boost::algorithm::split(words, list, boost::algorithm::is_any_of(", \t\n"),
                          boost::algorithm::token_compress_on);
  if (words.size() > 1) words.erase("");
  for (const std::string& word : words)
    if (std::ranges::find(known, word) == known.end())
      console.refuse(scene::error_at({}, "--what", fmt::format("\"{}\"", word.empty() ? list : word),
                                     scene::quoted_list(known), scene::nearest_of(word, known)));
  return words;
}

/// Of these kinds, or of all where none is named, what the case has data for. A kind that is named must have
/// some.
Selection select(const report::DrawnCase& drawn, const std::set<std::string>& named, bool as_tables,
                 Console& console) {
  Selection selection;
  for (const PictureKind& kind : report::picture_kinds()) {
    if (!named.empty() && !named.contains(kind.word)) continue;
    const bool lacks_tables = as_tables && !kind.tables;
    const std::string why = lacks_tables ? "there are pictures of it alone" : kind.lacks(drawn);
    if (why.empty())
      selection.kinds.push_back(&kind);
    else if (named.empty())
      selection.left_out.emplace_back(&kind, why);
    else
      console.refuse(scene::error_at({}, "--what",
                                     fmt::format("\"{}\", which {} has no data for: {}", kind.word,
                                                 lacks_tables ? "--csv" : "this case", why),
                                     "what the case has data for; all of that without --what"));
  }
  return selection;
}

/// The times that a user named, each of which must be one that can be drawn.
std::vector<double> wanted_times(const report::DrawnCase& drawn, const Selection& selection,
                                 const std::string& text, Console& console) {
  const auto refuse = [&](const std::string& found, const std::string& allowed,
                          const std::string& suggestion = {}) {
    console.refuse(scene::error_at({}, "--times", found, allowed, suggestion));
  };
  const auto times = scene::parse_list(text, scene::Dimension::time);
  if (!times) refuse(times.error().found, times.error().allowed, times.error().suggestion);
  const bool of_fields = selection.has("fields");
  if (!of_fields && !selection.has("profile")) refuse(text, "times where fields or profile are drawn");
  const auto snapshots = report::shown_snapshots(drawn);
  std::vector<std::string> known;
  for (const auto& each : snapshots) known.push_back(scene::time_text(each.time()));
  const double end = drawn.result.mechanics.end_time;
  for (const double time : *times) {
    const std::string found = scene::time_text(time);
    if (of_fields &&
        std::ranges::none_of(snapshots, [&](const auto& each) { return report::is_of_time(each, time); }))
      refuse(found + ", of which the case has no snapshot",
             fmt::format("{}; any time with --what profile", fmt::join(known, ", ")));
    if (!of_fields && !(time >= 0.0 && time <= end * (1.0 + 1e-9)))
      refuse(found, "times until the end of the run at " + scene::time_text(end));
  }
  return *times;
}

/// What kept a picture from being drawn.
[[noreturn]] void end_of_drawing(const store::Error& error, Console& console) {
  if (stop_requested()) console.fail("interrupted while drawing; nothing was written", ExitCode::interrupted);
  if (error.kind != store::Error::Kind::missing) console.fail(error.message);
  console.refuse(
      "plot: found no program gnuplot (Debian: gnuplot-nox), which draws the pictures; allowed: with it "
      "installed");
}

/// Pictures, or their numbers, as they will be written, and what is told of them.
void draw(const report::DrawnCase& drawn, const Selection& selection, bool tables, const path& folder,
          NamedTexts& texts, Json& told, Console& console) {
  Progress progress(console.quiet());
  const auto add = [&](const PictureKind& kind, const std::string& name, std::string text) {
    texts.push_back({name, std::move(text)});
    told.push_back({{"what", kind.word}, {"file", (folder / name).string()}});
  };
  for (const PictureKind* kind : selection.kinds) {
    if (tables)
      for (const report::CaseTable& each : kind->tables(drawn)) add(*kind, each.file, to_csv(each.table));
    else
      for (const CasePicture& picture : kind->pictures(drawn)) {
        progress.show("drawing " + picture.file);
        auto svg = report::to_svg(picture.plot, {.stop = &stop_requested()});
        if (!svg) end_of_drawing(svg.error(), console);
        add(*kind, picture.file, std::move(*svg));
        if (picture.time) told.back()["time_ms"] = 1e3 * *picture.time;
        if (picture.gap) told.back()["gap_cm"] = scene::in_unit(*picture.gap, scene::Dimension::length, "cm");
      }
  }
}

ExitCode perform(const PlotArguments& arguments, Console& console) {
  constexpr const char* allowed = "a case file, such as launchsafe run SCENE.toml -o DIR writes";
  std::vector<std::string> inside;  // a folder, or that of a study
  for (const path& folder : {arguments.file, arguments.file / "cases"})
    for (const std::string& name : scene::list_folder(folder))
      if (name.ends_with(".h5")) inside.push_back((folder / name).string());
  if (!inside.empty())
    console.refuse(
        scene::error_at({arguments.file.string()}, {}, "a folder", allowed, scene::quoted_list(inside)));
  const auto file = store::read_case_with_scene(arguments.file);
  if (!file) console.refuse(fmt::format("{}; allowed: {}", file.error().message, allowed));
  report::DrawnCase drawn{file->scene, file->stored.result};
  const bool tables = arguments.tables;
  std::set<std::string> named;
  if (arguments.what) named = named_kinds(*arguments.what, console);
  const Selection selection = select(drawn, named, tables, console);
  if (arguments.times) drawn.times = wanted_times(drawn, selection, *arguments.times, console);
  const path folder = arguments.output.value_or(arguments.file.parent_path() /
                                                (arguments.file.stem().string() + "_pictures"));
  const char* list = tables ? "tables" : "pictures";
  Json object{{"folder", folder.string()}, {list, Json::array()}, {"left_out", Json::array()}};
  NamedTexts texts;
  draw(drawn, selection, tables, folder, texts, object[list], console);
  write_where_absent(folder, texts, console);
  for (const auto& [kind, why] : selection.left_out) {
    console.remark(fmt::format("no {} of {}: {}", tables ? "table" : "picture", kind->word, why));
    object["left_out"].push_back({{"what", kind->word}, {"because", why}});
  }
  return console.done(texts.empty() ? "" : fmt::format("{}\n", fmt::join(places_of(folder, texts), "\n")),
                      object);
}

}  // namespace

void add_plot(CLI::App& app, CommandLine& line) {
  auto [command, plot] = add_command<PlotArguments>(app, line, "plot");
  add_required(command, "case", plot.file);
  add(command, "-o,--output", plot.output);
  add(command, "--what", plot.what)->type_name(fmt::format("{}", fmt::join(words_of_kinds(), "|")));
  add(command, "--times", plot.times);
  add(command, "--csv", plot.tables);
}

}  // namespace launchsafe::app
