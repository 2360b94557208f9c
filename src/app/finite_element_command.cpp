// launchsafe verify --finite-elements: static stresses held against another program's.
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/verify/static_stress_comparison.hpp"
#include "output_folder.hpp"
#include "signals.hpp"
#include "verify_command.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <utility>

namespace launchsafe::app {
namespace {

using verify::ParticleMeans, verify::StaticComparison, verify::StressMeasures;

constexpr const char* tube_name = "thick tube";
const std::vector<std::string> stress_files{"stresses.csv", "summary.md"};
const char* const stress_title = "Static stresses at the charge bottom against finite elements";

/// All that was compared, and by what.
struct FiniteElementComparison {
  std::string version;  ///< of CalculiX
  std::vector<StaticComparison> cases;
  std::optional<verify::TubeComparison> tube;
};

std::string millimetres(double length) { return report::significant(1e3 * length, 4) + " mm"; }

report::Column number_column(std::string name, std::string unit, int decimals) {
  return {.name = std::move(name), .unit = std::move(unit), .decimals = decimals};
}

/// Difference in percent; nothing for nothing.
report::Cell difference(double value, double reference) { return 100.0 * (value / reference - 1.0); }

report::Table case_table(const StaticComparison& comparison) {
  report::Table table;
  table.title = comparison.compared.name;
  const bool closed = !comparison.compared.exact.empty();
  const std::string reference = closed ? "closed form" : "finite elements";
  table.columns = {report::text_column("point"), number_column("r", "cm", 2),
                   number_column(reference + ": pressure", "MPa", 3),
                   number_column(reference + ": von Mises", "MPa", 3)};
  const auto add_pair = [&](const std::string& name) {
    table.columns.push_back(number_column(name + ": pressure", "%", 3));
    table.columns.push_back(number_column("von Mises", "%", 3));
  };
  if (closed) add_pair("finite elements");
  add_pair("coarser elements");
  for (const ParticleMeans& mesh : comparison.meshes)
    if (mesh.failure.empty()) add_pair("particles " + millimetres(mesh.cell_size));
  for (std::size_t k = 0; k < comparison.compared.stations.size(); ++k) {
    const StressMeasures& expected = comparison.reference()[k];
    std::vector<report::Cell> row{comparison.compared.stations[k].name,
                                  100.0 * comparison.compared.stations[k].r, expected.pressure / 1e6,
                                  expected.von_mises / 1e6};
    const auto add = [&](const StressMeasures& found, const StressMeasures& against) {
      row.push_back(difference(found.pressure, against.pressure));
      row.push_back(difference(found.von_mises, against.von_mises));
    };
    if (closed) add(comparison.fine.means[k], expected);
    add(comparison.coarse.means[k], comparison.fine.means[k]);
    for (const ParticleMeans& mesh : comparison.meshes)
      if (mesh.failure.empty()) add(mesh.means[k], expected);
    table.rows.push_back(std::move(row));
  }
  table.notes = {
      comparison.compared.description,
      fmt::format("Percentages are differences from the {}; of the coarser elements, from the finer.",
                  closed ? "closed form" : "finite elements")};
  return table;
}

bool slides(const StaticComparison& comparison) { return !comparison.compared.scene.interfaces.empty(); }

report::Table run_table(const FiniteElementComparison& comparison) {
  report::Table table;
  table.title = "Computations";
  table.columns = {report::text_column("case"),
                   report::text_column("computed by"),
                   {.name = "elements or particles", .unit = ""},
                   number_column("alternation of pressure", "%", 3),
                   number_column("motion left: pressure", "%", 4),
                   number_column("motion left: von Mises", "%", 4),
                   number_column("correction for contact's springs", "%", 3),
                   number_column("wall time", "s", 1)};
  for (const StaticComparison& each : comparison.cases) {
    const auto elements = [&](const char* name, const verify::FiniteElementMeans& run) {
      table.rows.push_back({each.compared.name, std::string(name), static_cast<std::int64_t>(run.elements),
                            report::Cell{}, report::Cell{}, report::Cell{},
                            slides(each) ? report::Cell{100.0 * run.contact_correction} : report::Cell{},
                            run.wall_time});
    };
    elements("coarser elements", each.coarse);
    elements("finite elements", each.fine);
    for (const ParticleMeans& mesh : each.meshes) {
      std::vector<report::Cell> row{each.compared.name,
                                    "particles in cells of " + millimetres(mesh.cell_size),
                                    static_cast<std::int64_t>(mesh.particles)};
      if (mesh.failure.empty())
        row.insert(row.end(), {100.0 * mesh.alternation, 100.0 * mesh.ringing_pressure,
                               100.0 * mesh.ringing_von_mises, report::Cell{}, mesh.wall_time});
      else
        row.emplace_back("failed: " + mesh.failure);
      table.rows.push_back(std::move(row));
    }
  }
  table.notes = {
      fmt::format(
          "Alternation: root mean square of (p[j-2] - 4 p[j-1] + 6 p[j] - 4 p[j+1] + p[j+2])/16 along "
          "r for r < {:.3g} cm, in all rows of the boxes, as a share of the pressure's.",
          100.0 * verify::alternation_radius),
      "Motion left: the largest departure of a point's stress from its mean over the last 0.5 ms.",
      "Correction for contact's springs: CalculiX presses faces on each other, and holds them where they "
      "stick, by springs. Stresses are extrapolated from two stiffnesses, one half the other, to rigid "
      "faces: by how much, at most."};
  return table;
}

report::Table tube_table(const verify::TubeComparison& tube) {
  report::Table table;
  table.title = "Thick tube, 65/77.5 mm, 100 MPa inside, plane strain: hoop stress";
  table.columns = {report::text_column("at"),
                   number_column("closed form", "MPa", 3),
                   number_column("finite elements", "MPa", 3),
                   number_column("particles", "MPa", 3),
                   number_column("finite elements, difference", "%", 4),
                   number_column("particles, difference", "%", 4)};
  const auto add = [&](const char* at, double exact, double elements, double particles) {
    table.rows.push_back({std::string(at), exact / 1e6, elements / 1e6, particles / 1e6,
                          difference(elements, exact), difference(particles, exact)});
  };
  add("bore", tube.exact_bore, tube.element_bore, tube.particle_bore);
  add("outside", tube.exact_outside, tube.element_outside, tube.particle_outside);
  table.notes = {
      "Closed form after Lame. The particles are those of the closed-form check of the same tube."};
  return table;
}

std::vector<report::Table> tables_of(const FiniteElementComparison& comparison) {
  std::vector<report::Table> tables;
  for (const StaticComparison& each : comparison.cases) tables.push_back(case_table(each));
  if (comparison.tube) tables.push_back(tube_table(*comparison.tube));
  if (!comparison.cases.empty()) tables.push_back(run_table(comparison));
  return tables;
}

std::vector<std::string> missed_by(const FiniteElementComparison& comparison) {
  std::vector<std::string> missed;
  for (const StaticComparison& each : comparison.cases)
    for (std::string& sentence : verify::missed_targets(each)) missed.push_back(std::move(sentence));
  return missed;
}

std::string targets_text() {
  const verify::StressTargets targets;
  return fmt::format(
      "Targets on every mesh: {:.3g} % of pressure and von Mises stress up to r = {:.4g} cm, {:.3g} % "
      "beyond, {:.3g} % where the charge can slide on the wall; "
      "alternation of the charge's pressure {:.3g} %.",
      100.0 * targets.inner, 100.0 * targets.inner_radius, 100.0 * targets.outer,
      100.0 * verify::sliding_outer_target, 100.0 * targets.alternation);
}

/// Everything in one table, for programs.
report::Table whole_table(const FiniteElementComparison& comparison) {
  report::Table table;
  const auto exact_number = [](std::string name, std::string unit) {
    return report::Column{.name = std::move(name),
                          .unit = std::move(unit),
                          .decimals = 9,
                          .notation = report::Notation::significant};
  };
  table.columns = {report::text_column("case"),     report::text_column("computed by"),
                   exact_number("cell", "mm"),      report::text_column("point"),
                   exact_number("r", "cm"),         exact_number("pressure", "MPa"),
                   exact_number("von Mises", "MPa")};
  for (const StaticComparison& each : comparison.cases) {
    const auto add = [&](const std::string& by, report::Cell cell, const std::vector<StressMeasures>& means) {
      for (std::size_t k = 0; k < means.size(); ++k)
        table.rows.push_back({each.compared.name, by, cell, each.compared.stations[k].name,
                              100.0 * each.compared.stations[k].r, means[k].pressure / 1e6,
                              means[k].von_mises / 1e6});
    };
    add("closed form", {}, each.compared.exact);
    add("coarser finite elements", {}, each.coarse.means);
    add("finite elements", {}, each.fine.means);
    for (const ParticleMeans& mesh : each.meshes) add("particles", 1e3 * mesh.cell_size, mesh.means);
  }
  return table;
}

std::string page_of(const FiniteElementComparison& comparison, const std::string& command) {
  std::string page = fmt::format(
      "# {}\n\nMade by `{}` with CalculiX {}. Times are of the machine that ran it.\n\n"
      "The bodies rest in the frame that accelerates with them, under a pressure on the base that "
      "rises over 1 ms (4 ms with friction, where motion leaves its mark) and then stays; what moves is "
      "damped. Stresses are averaged over 5 mm x 5 mm at "
      "the bottom with the weight r dr dx: the mean of the particles' or integration points' pressure "
      "and von Mises stress. The elements (axisymmetric, quadratic, reduced integration) are of large "
      "strain, neo-Hookean where they do not yield; each has the secant bulk modulus of its equation "
      "of state at its own pressure. Where faces can slide, CalculiX's face-to-face penalty contact with "
      "Coulomb friction holds them, with the whole load in one increment: all grows in proportion, and so "
      "do slip and its limit.\n\n{}\n\n",
      stress_title, command, comparison.version, targets_text());
  const std::vector<std::string> missed = missed_by(comparison);
  page += missed.empty() ? "All are met.\n" : fmt::format("{} are missed:\n\n", missed.size());
  for (const std::string& sentence : missed) page += "- " + sentence + "\n";
  for (const report::Table& table : tables_of(comparison)) page += "\n" + report::to_markdown(table);
  return page;
}

std::string stress_text(const FiniteElementComparison& comparison, const std::string& command) {
  std::string text;
  for (const report::Table& table : tables_of(comparison)) text += report::to_text(table) + "\n";
  text += targets_text() + "\n";
  const std::vector<std::string> missed = missed_by(comparison);
  if (missed.empty()) text += "All are met.\n";
  for (const std::string& sentence : missed) text += "missed: " + sentence + "\n";
  return text + fmt::format("\nmade by: {} with CalculiX {}\n", command, comparison.version);
}

nlohmann::ordered_json stress_json(const FiniteElementComparison& comparison, const std::string& command) {
  nlohmann::ordered_json object{{"command", command}, {"calculix", comparison.version}};
  object["tables"] = nlohmann::ordered_json::array();
  for (const report::Table& table : tables_of(comparison)) object["tables"].push_back(report::to_json(table));
  object["missed_targets"] = missed_by(comparison);
  return object;
}

store::Result<report::WrittenFiles> write_stresses(const FiniteElementComparison& comparison,
                                                   const std::string& command,
                                                   const std::filesystem::path& folder) {
  report::WrittenFiles written;
  if (auto error = write_texts(folder,
                               {{"stresses.csv", report::to_csv(whole_table(comparison))},
                                {"summary.md", page_of(comparison, command)}},
                               written))
    return *error;
  return written;
}

/// What was asked for.
struct Wanted {
  std::vector<verify::StaticCase> cases;
  bool tube = false;
};

Wanted wanted_by(const std::string& filter) {
  Wanted wanted;
  for (verify::StaticCase& each : verify::static_cases())
    if (has_in_its_name(each.name, filter)) wanted.cases.push_back(std::move(each));
  wanted.tube = has_in_its_name(tube_name, filter);
  return wanted;
}

/// Why nothing can be begun.
std::optional<std::string> obstacle(const VerifyArguments& arguments, const Wanted& wanted) {
  if (wanted.cases.empty() && !wanted.tube) {
    std::string names;
    for (const verify::StaticCase& each : verify::static_cases()) names += "\"" + each.name + "\", ";
    return fmt::format("--filter: found \"{}\", which no case has in its name; cases: {}\"{}\"",
                       arguments.filter, names, tube_name);
  }
  if (!arguments.output) return std::nullopt;
  return obstacle_to_report(*arguments.output, stress_files);
}

store::MaybeError compare(const Wanted& wanted, Progress& progress, FiniteElementComparison& comparison) {
  verify::ComparisonOptions options;
  options.stop = &stop_requested();
  options.progress = [&](const std::string& what) { progress.show("computing: " + what); };
  for (const verify::StaticCase& each : wanted.cases) {
    auto result = verify::compare_static_stresses(each, options);
    if (!result) return result.error();
    comparison.cases.push_back(std::move(*result));
  }
  if (!wanted.tube) return std::nullopt;
  const auto tube = verify::compare_tube(options);
  if (!tube) return tube.error();
  comparison.tube = *tube;
  return std::nullopt;
}

ExitCode present(const FiniteElementComparison& comparison, const VerifyArguments& arguments,
                 Console& console) {
  const std::string command = verify_command("--finite-elements", arguments);
  console.print_text(stress_text(comparison, command));
  console.print_json(stress_json(comparison, command));
  if (arguments.output) {
    const auto written = write_stresses(comparison, command, *arguments.output);
    if (const ExitCode code = present_report(written, *arguments.output, console); code != ExitCode::done)
      return code;
  }
  return missed_by(comparison).empty() ? ExitCode::done : ExitCode::cases_failed;
}

}  // namespace

ExitCode compare_with_finite_elements(const VerifyArguments& arguments, Console& console) {
  FiniteElementComparison comparison;
  const auto version = verify::finite_element_version();
  if (!version) {
    return console.refuse(version.error().kind == store::Error::Kind::missing
                              ? "--finite-elements: found no program ccx (CalculiX; Debian: calculix-ccx); "
                                "allowed: where it is installed"
                              : "--finite-elements: " + version.error().message);
  }
  comparison.version = *version;
  const Wanted wanted = wanted_by(arguments.filter);
  if (const auto reason = obstacle(arguments, wanted)) return console.refuse(*reason);
  // Everything below looks at the wish to stop often enough to be waited for, and ends what it called.
  Progress progress(progress_style(console.quiet()));
  const store::MaybeError error = compare(wanted, progress, comparison);
  progress.clear();
  if (stop_requested()) {
    console.error("interrupted; no stress was printed, and there is nothing to keep");
    return ExitCode::interrupted;
  }
  if (error) return console.fail("--finite-elements: " + error->message);
  return present(comparison, arguments, console);
}

}  // namespace launchsafe::app
