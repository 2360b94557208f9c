// Pictures of fields over the section of a case.
#include "drawn_cases.hpp"

namespace launchsafe::report {
namespace {

TEST(CasePictures, OfFieldsAreNamedByFieldAndTheTimesThatWereAskedFor) {
  const RunScene run(cased_charge());
  const auto names = files(pictures(run.drawn(), "fields"));
  EXPECT_EQ(names, (std::vector<std::string>{"field_temperature_0ms.svg", "field_temperature_0.02ms.svg",
                                             "field_temperature_0.04ms.svg", "field_pressure_0.02ms.svg",
                                             "field_pressure_0.04ms.svg", "field_von_mises_0.02ms.svg",
                                             "field_von_mises_0.04ms.svg"}))
      << "nothing presses at first";
  const auto one = files(pictures(run.drawn({2e-5}), "fields"));
  EXPECT_EQ(one, (std::vector<std::string>{"field_temperature_0.02ms.svg", "field_pressure_0.02ms.svg",
                                           "field_von_mises_0.02ms.svg"}))
      << "cracks do not grow";
}

TEST(CasePictures, OfTheTemperatureShowTheSkinOfTheLargestGapThatDoesNotBurn) {
  RunScene run(cased_charge());
  const auto drawn = [&] { return std::get<CellPlot>(pictures(run.drawn({4e-5}), "fields").front().plot); };
  const auto particles = static_cast<std::size_t>(scene::particle_count(run.scene));
  const CellPlot of_largest = drawn();
  ASSERT_EQ(of_largest.scales.size(), 1U) << "one scale for all";
  const auto& skin = run.result.gaps[2].skin;
  const std::size_t rings = of_largest.cells.size() - particles;
  EXPECT_EQ(rings, run.result.mechanics.trace.stations.size());
  const auto hottest =
      std::max_element(skin.temperature.end() - static_cast<std::ptrdiff_t>(rings), skin.temperature.end());
  EXPECT_NEAR(of_largest.scales[0].maximum, *hottest, 1e-6);
  const auto coldest =
      std::min_element(skin.temperature.end() - static_cast<std::ptrdiff_t>(rings), skin.temperature.end());
  EXPECT_NEAR(of_largest.scales[0].minimum, *coldest, 1e-6) << "the bulk, which is colder, is grey";
  EXPECT_TRUE(std::isnan(of_largest.cells.front().value));
  EXPECT_NEAR(2.0 * of_largest.cells.back().half_x, 1e3 * run.scene.surface.skin_thickness, 1e-9);
  EXPECT_TRUE(of_largest.enlargement && of_largest.enlargement->alone) << "all else is grey";
  EXPECT_NE(of_largest.title.find("Gap 0.04 cm at 0.04 ms"), std::string::npos) << of_largest.title;
  run.result.gaps[2].skin.ignition = {3e-5, 0, surface::IgnitionCause::trigger, 0.1};
  EXPECT_NE(drawn().title.find("Gap 0.01 cm"), std::string::npos);
  run.result.gaps.clear();
  EXPECT_EQ(files(pictures(run.drawn({4e-5}), "fields")).front(), "field_pressure_0.04ms.svg")
      << "the bulk alone does not warm by 1 %";
}

// Most of the section is within the colours; by hand, one cell of the charge presses as no other.
TEST(CasePictures, OfAFieldMarkWhatIsFarFromAllElse) {
  RunScene run(cased_charge(0.2));
  auto& snapshots = run.result.mechanics.snapshots;
  snapshots.back().pressure[0] = 1e12;
  const auto drawn = pictures(run.drawn({4e-5}), "fields");
  const auto& plot = std::get<CellPlot>(drawn[1].plot);
  EXPECT_LT(plot.scales[0].maximum, 1e4) << "MPa";
  const std::string commands = to_gnuplot(plot);
  EXPECT_GE(block_of(commands, "whole_above").size(), 2U) << "on both sides of the axis";
  EXPECT_NE(commands.find("; orange: above the colours"), std::string::npos);
  EXPECT_EQ(plot.ringed, 0U);
  EXPECT_EQ(plot.ring_label, "1e+06 MPa");
  EXPECT_TRUE(plot.title.ends_with(", up to 1e+06 MPa")) << plot.title;
}

// By hand, three cells burn.
TEST(CasePictures, OfAFieldThatIsMostlyZeroHaveTheColoursOfWhatIsNot) {
  RunScene run(cased_charge(0.2));
  run::Snapshot burning = run.result.mechanics.snapshots.back();
  burning.burnt_share.assign(burning.x.size(), 0.0);
  burning.burnt_share[0] = 0.1;
  burning.burnt_share[1] = burning.burnt_share[2] = 0.5;
  run.result.gaps[2].combustion.emplace().snapshots = {burning};
  for (const CasePicture& picture : pictures(run.drawn({4e-5}), "fields")) {
    if (!picture.file.starts_with("field_burnt_share")) continue;
    const auto& plot = std::get<CellPlot>(picture.plot);
    EXPECT_EQ(plot.scales[0].minimum, 0.0);
    EXPECT_EQ(plot.scales[0].maximum, 0.5);
    EXPECT_TRUE(block_of(to_gnuplot(plot), "whole_above").empty());
    EXPECT_TRUE(plot.title.ends_with(": up to 0.5, nothing beyond r 2.5 mm")) << plot.title;
    EXPECT_EQ(std::ranges::count_if(plot.cells, [](const FieldCell& cell) { return cell.value > 0.0; }), 3);
    ASSERT_TRUE(plot.enlargement);
    EXPECT_NEAR(plot.enlargement->x_begin, -7.5, 0.1) << "mm, as far from three cells as they are long";
    EXPECT_NEAR(plot.enlargement->x_end, 15.0, 0.1);
    EXPECT_NEAR(plot.enlargement->r_end, 1.2 * 2.5, 1e-5)
        << "mm, kept in single precision: they lie next to the axis";
    return;
  }
  FAIL() << "no picture of the burnt share";
}

// The number of particles is that of the scene's grid.
TEST(CasePictures, OfFieldsShowEveryCellOnBothSidesOfTheAxis) {
  const RunScene run(cased_charge());
  const auto particles = static_cast<std::size_t>(scene::particle_count(run.scene));
  ASSERT_EQ(particles, 4U * 8 + 2 * 8 + 6 * 4) << "cells of 2.5 mm";
  for (const CasePicture& picture : pictures(run.drawn(), "fields")) {
    if (picture.file.starts_with("field_temperature")) continue;  // has the skin's cells too
    const std::string commands = to_gnuplot(std::get<CellPlot>(picture.plot));
    std::size_t cells = 0, below_axis = 0;
    for (const char* name : {"whole_cells0", "whole_cells1", "whole_grey"})
      for (const std::string& line : block_of(commands, name)) {
        double x = 0, r = 0;
        std::istringstream(line) >> x >> r;
        ++cells;
        below_axis += r < 0.0 ? 1 : 0;
      }
    EXPECT_EQ(cells, 2 * particles) << picture.file;
    EXPECT_EQ(below_axis, particles) << picture.file;
  }
}

TEST(CasePictures, OfFieldsHaveOneOutlineForEveryBodyWhichAtRestIsItsRectangle) {
  const RunScene run(cased_charge());
  const auto plot = std::get<CellPlot>(pictures(run.drawn({0.0}), "fields").front().plot);
  ASSERT_EQ(plot.outlines.size(), run.scene.bodies.size());
  for (std::size_t i = 0; i < plot.outlines.size(); ++i) {
    const scene::Body& body = run.scene.bodies[i];
    const std::vector<Place>& path = plot.outlines[i].path;
    const auto by_x = [](const Place& a, const Place& b) { return a.x < b.x; };
    const auto by_r = [](const Place& a, const Place& b) { return a.r < b.r; };
    const auto [left, right] = std::minmax_element(path.begin(), path.end(), by_x);
    const auto [low, high] = std::minmax_element(path.begin(), path.end(), by_r);
    EXPECT_NEAR(left->x, 1e3 * body.x_begin, 1e-9) << body.name;
    EXPECT_NEAR(right->x, 1e3 * body.x_end, 1e-9) << body.name;
    EXPECT_NEAR(low->r, 1e3 * body.r_begin, 1e-9) << body.name;
    EXPECT_NEAR(high->r, 1e3 * body.r_end, 1e-9) << body.name;
    EXPECT_EQ(plot.outlines[i].open_at_axis, body.r_begin == 0.0) << body.name;
  }
  const std::string commands = to_gnuplot(plot);
  EXPECT_EQ(count_of(commands, "$whole_outline"), 3 * run.scene.bodies.size())
      << "data, plot and mirror image";
  const auto charge = block_of(commands, "whole_outline0"), wall = block_of(commands, "whole_outline1");
  EXPECT_NE(charge.front(), charge.back()) << "from the axis to the axis";
  EXPECT_EQ(wall.front(), wall.back());
}

// By hand, all presses a thousand times as hard at 0.02 ms: late in a launch stresses are released.
TEST(CasePictures, OfAFieldHaveTheColoursOfTheirOwnInstant) {
  RunScene run(cased_charge());
  for (double& pressure : run.result.mechanics.snapshots[1].pressure) pressure *= 1e3;
  std::vector<double> values;
  const run::Snapshot& last = run.result.mechanics.snapshots.back();
  for (std::size_t i = 0; i < last.x.size(); ++i)
    if (last.body[i] == 0) values.push_back(1e-6 * last.pressure[i]);
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  ASSERT_GT(*highest, *lowest);
  for (const auto& drawn : {run.drawn(), run.drawn({4e-5})})
    for (const CasePicture& picture : pictures(drawn, "fields")) {
      if (picture.file != "field_pressure_0.04ms.svg") continue;
      const auto& plot = std::get<CellPlot>(picture.plot);
      ASSERT_EQ(plot.scales.size(), 2U);
      EXPECT_EQ(plot.scales[0].label, "charge: pressure [MPa]");
      EXPECT_EQ(plot.scales[1].label, "shell: pressure [MPa]");
      EXPECT_DOUBLE_EQ(plot.scales[0].minimum, *lowest) << "of less than 100 all count";
      EXPECT_DOUBLE_EQ(plot.scales[0].maximum, *highest);
    }
}

TEST(CasePictures, OfFieldsNameTheAxisOfSymmetryOnce) {
  const RunScene run(cased_charge(0.2));
  const auto plot = std::get<CellPlot>(pictures(run.drawn({4e-5}), "fields").at(1).plot);
  ASSERT_TRUE(plot.enlargement) << "below the whole, whose lower edge is the axis";
  const std::string commands = to_gnuplot(plot);
  EXPECT_EQ(count_of(commands, "set label 3 'axis' "), 1U);
  EXPECT_EQ(count_of(commands, "set arrow 1 "), 1U);
}

TEST(CasePictures, OfEventsAndOfWhatBurnsSayItInColoursOfTheirOwn) {
  RunScene run(cased_charge());
  auto& snapshots = run.result.mechanics.snapshots;
  ASSERT_EQ(snapshots.size(), 3U);
  run::Snapshot of_peak = snapshots[1];
  of_peak.time = 3e-5;
  of_peak.events = {scene::Event::peak_pressure, scene::Event::largest_slip};
  snapshots.insert(snapshots.begin() + 2, of_peak);
  run::Snapshot burning = snapshots[3];
  burning.events = {scene::Event::ignition};
  burning.burnt_share.assign(burning.x.size(), 0.5);
  burning.burnt_share[0] = 0.4;
  for (double& pressure : burning.pressure) pressure = 2e9;
  burning.pressure[0] = 1.9e9;
  run.result.gaps[2].combustion.emplace().snapshots = {burning};
  const auto drawn = pictures(run.drawn(), "fields");
  const auto names = files(drawn);
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const char* name : {"field_pressure_0.02ms.svg", "field_pressure_peak-pressure_largest-slip.svg",
                           "field_pressure_0.04ms.svg", "field_pressure_0.04cm_0.04ms_ignition.svg",
                           "field_burnt_share_0.04cm_0.04ms_ignition.svg"})
    EXPECT_TRUE(has(name)) << name;
  EXPECT_FALSE(has("field_burnt_share_0.04ms.svg")) << "nothing burns in the launch";
  for (const CasePicture& picture : drawn) {
    const auto& plot = std::get<CellPlot>(picture.plot);
    if (!picture.file.starts_with("field_pressure_")) continue;
    EXPECT_EQ(plot.scales[0].maximum == 2000.0, picture.gap.has_value()) << picture.file;
    if (!picture.gap) {
      EXPECT_NE(plot.title.find(", without burning"), std::string::npos) << plot.title;
      EXPECT_NE(plot.subtitle.find("; the same for every gap; ring: highest in the charge, x "),
                std::string::npos)
          << plot.subtitle;
      continue;
    }
    EXPECT_EQ(
        plot.title,
        "Pressure at 0.04 ms, ignition, gap 0.04 cm burning rises along the axis from 1900 MPa at the nose "
        "to 2000 MPa at the bottom");
  }
}

// By hand, from 1 MPa to 8 MPa along the charge.
TEST(CasePictures, OfAFieldThatRisesAlongTheAxisSayIt) {
  RunScene run(cased_charge());
  auto& pressure = run.result.mechanics.snapshots.back().pressure;
  for (std::size_t i = 0; i < 32; ++i) pressure[i] = 1e6 * static_cast<double>(i % 8 + 1);
  const auto title = [&] {
    return std::get<CellPlot>(pictures(run.drawn({4e-5}), "fields").at(1).plot).title;
  };
  EXPECT_EQ(title(),
            "Pressure at 0.04 ms rises along the axis from 1 MPa at the nose to 8 MPa at the bottom");
  pressure[4] = 1e6;
  EXPECT_EQ(title(), "Pressure at 0.04 ms: mostly 1 MPa to 8 MPa, up to 8 MPa");
}

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  EXPECT_NE(at, std::string::npos) << words;
  return std::stod(text.substr(at + words.size()));
}

/// Pixels per mm along x and r of the panel whose commands begin at `text`.
std::pair<double, double> scales_of_panel(const std::string& text, double width, double height) {
  const double left = number_after(text, "lmargin at screen "),
               right = number_after(text, "rmargin at screen ");
  const double top = number_after(text, "tmargin at screen "),
               bottom = number_after(text, "bmargin at screen ");
  const auto span = [&](const std::string& words) {
    const double begin = number_after(text, words);
    return number_after(text.substr(text.find(words) + words.size()), ":") - begin;
  };
  return {(right - left) * width / span("xrange ["), (top - bottom) * height / span("yrange [")};
}

TEST(CasePictures, OfFieldsAreToScaleAndEnlargeTheBottomOfASlenderShell) {
  for (const double length : {0.02, 0.2}) {
    const RunScene run(cased_charge(length));
    const auto plot = std::get<CellPlot>(pictures(run.drawn({4e-5}), "fields").at(1).plot);
    EXPECT_EQ(plot.enlargement.has_value(), length > 0.1);
    const std::string commands = to_gnuplot(plot);
    std::smatch size;
    ASSERT_TRUE(std::regex_search(commands, size, std::regex(R"(svg size (\d+),(\d+))")));
    const double width = std::stod(size[1]), height = std::stod(size[2]);
    const auto whole = scales_of_panel(commands, width, height);
    EXPECT_NEAR(whole.first / whole.second, 1.0, 1e-9);
    if (!plot.enlargement) continue;
    EXPECT_LT(plot.enlargement->x_begin, 200.0) << "mm, the bottom";
    EXPECT_GT(plot.enlargement->x_end, 200.0);
    const auto part = scales_of_panel(commands.substr(commands.find("$whole_outline2 using")), width, height);
    EXPECT_NEAR(part.first / part.second, 1.0, 1e-9);
    EXPECT_GT(part.first, 1.5 * whole.first);
  }
}

}  // namespace
}  // namespace launchsafe::report
